"""The benchmark scripts: what they read out of CalculiX, what they draw, how they go on, and each of them once on a
tiny case."""

import collections
import importlib.machinery
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import types
import unittest

from command_line import BINARY, CommandLine

BENCH = pathlib.Path(__file__).resolve().parents[2] / "bench"
sys.path.insert(0, str(BENCH))


def script(name):
    """A script without the ending .py, as a module."""
    loader = importlib.machinery.SourceFileLoader(f"bench_{name}", str(BENCH / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


calculix, recipes = script("calculix"), script("recipes")

import measuring  # noqa: E402  (after the path to it)

DECK = """*STATIC
3.333333e-02,1.,1.e-6,2.500000e-01
*CONTROLS, PARAMETERS=FIELD
1.e-6,1.e-6
*TEMPERATURE
ALL,1.
"""

STA = """SUMMARY OF JOB INFORMATION
  STEP      INC     ATT  ITRS     TOT TIME     STEP TIME      INC TIME
     1         15     1     3  0.500000E+00  0.500000E+00  0.333333E-01
     1         16     1     7  0.533333E+00  0.533333E+00  0.333333E-01
     1         17     1U    6  0.533333E+00  0.533333E+00  0.333333E-01
     1         17     2U    4  0.533333E+00  0.533333E+00  0.833333E-02
     1         17     3    10  0.535417E+00  0.535417E+00  0.208333E-02
     1         18     1U    5  0.535417E+00  0.535417E+00  0.208333E-02
"""

CVG = """SUMMARY OF C0NVERGENCE INFORMATION
  STEP   INC  ATT   ITER     CONT.   RESID.        CORR.      RESID.      CORR.
                              EL.    FORCE         DISP       FLUX        TEMP.
                              (#)     (%)           (%)        (%)         (%)
     1     1     1     1        0  0.1438E+04  0.1000E+03  0.0000E+00  0.0000E+00
     1     1     1     2        0  0.2273E+01  0.1611E+01  0.0000E+00  0.0000E+00
     1    17     2     1        0  0.5839E+04       NaN    0.0000E+00  0.0000E+00
"""

LOG = """ number of equations
 9264
 number of nonzero lower triangular matrix elements
 337710

 Using up to 1 cpu(s) for the stress calculation.

 Factoring the system of equations using the symmetric spooles solver
 Using up to 2 cpu(s) for spooles.

 *ERROR: increment size smaller than minimum
 best solution and residuals are in the frd file
"""


class CalculixOutput(unittest.TestCase):
    def test_deck_keeps_all_but_the_tolerances(self):
        self.assertEqual(calculix.bench_deck(DECK), DECK.replace("*CONTROLS, PARAMETERS=FIELD\n1.e-6,1.e-6\n", ""))
        with self.assertRaises(ValueError):
            calculix.bench_deck("*STATIC\n1.,1.\n")

    def test_increment(self):
        first, smallest, largest = calculix.increment_of(DECK)
        self.assertAlmostEqual(first, 1 / 30, places=6)
        self.assertEqual((smallest, largest), (1e-6, 0.25))

    def test_attempts_given_up_are_no_progress(self):
        self.assertEqual(calculix.progress_of(STA), {"steps": 3, "failures": 3, "reached": 0.535417})
        self.assertEqual(calculix.progress_of(""), {"steps": 0, "failures": 0, "reached": 0.0})

    def test_iterations(self):
        self.assertEqual(calculix.iterations_of(CVG), 3)
        self.assertEqual(calculix.iterations_of(""), 0)

    def test_log(self):
        self.assertEqual(calculix.told_by(LOG), {
            "unknowns": 9264, "processors": 2, "solver": "symmetric spooles",
            "error": "increment size smaller than minimum"})
        self.assertEqual(set(calculix.told_by("").values()), {None})

    def test_table_compares_with_the_run_above(self):
        def result(program, iterating, iterations, ended):
            return {"program": program, "columns": 386, "threads": 1, "unknowns": 9264, "shrinkage": 0.3, "steps": 1,
                    "failures": 0, "iterations": iterations, "iterating": iterating, "wall": 50.0, "processor": 1.0,
                    "memory": 2e7, "ended": ended}
        lines = calculix.table([result("Windfall", 2.0, 100, "done"), result("CalculiX", 40.0, 50, "it stalled"),
                                result("Windfall", 1.0, 100, "done"), result("CalculiX", 40.0, 0, "stopped")]).splitlines()
        cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
        self.assertEqual({len(line) for line in cells}, {len(calculix.HEAD)})
        self.assertEqual([line[11:] for line in cells[2:]],
                         [["0.02", "1.0", "done"], ["0.8", "40.0", "it stalled"], ["0.01", "1.0", "done"],
                          ["-", "-", "stopped"]])


class RandomRecipes(unittest.TestCase):
    def test_shapes_stones_skins_and_stiffnesses_are_in_the_papers_ranges(self):
        families = collections.Counter()
        for index in range(1, 201):
            settings, drawn = recipes.draw(index)
            skin, gamma = settings["fruit.skin_thickness"], settings["material.gamma"]
            r4, r8 = settings.get("fruit.r4", 1.0), settings.get("fruit.r8", 1.0)
            long, wide = settings["fruit.stone_r1"], settings["fruit.stone_r2"]
            self.assertTrue(0.02 <= skin <= 0.04, drawn)
            self.assertTrue(10 <= gamma <= 50, drawn)
            if long == wide:
                self.assertTrue(0.3 <= long <= 0.6, drawn)
            else:
                self.assertTrue(0.4 <= long <= 0.7 and wide == 0.4, drawn)
            for radius in (r4, r8):  # the stone's half axis there is radius * wide / r4
                self.assertTrue(radius == 1 or 0.6 <= radius <= 0.9, drawn)
                self.assertGreaterEqual(radius * (1 - wide / r4), 0.2 - 1e-9, drawn)
            families[r4 == 1 and r8 == 1, r4 == r8, long == wide] += 1
        self.assertEqual(families, {(True, True, True): 50, (True, True, False): 50, (False, True, True): 50,
                                    (False, False, True): 50})

    def test_ranges_are_used(self):
        drawn = [recipes.draw(index)[0] for index in range(1, 201)]
        for key, low, high in (("fruit.skin_thickness", 0.02, 0.04), ("material.gamma", 10, 50)):
            values = [settings[key] for settings in drawn]
            self.assertLess(min(values), low + 0.1 * (high - low))
            self.assertGreater(max(values), high - 0.1 * (high - low))
        self.assertLess(min(recipes.draw(i, thinnest=0.01)[0]["fruit.skin_thickness"] for i in range(1, 50)), 0.015)

    def test_same_seed_same_recipes_whatever_their_number(self):
        few, many = (recipes.cases([], count, 1, 0.02, False) for count in (3, 20))
        self.assertEqual(few, many[:3])
        self.assertNotEqual(recipes.draw(1), recipes.draw(1, seed=2))

    def test_outline_of_an_ellipsoid(self):
        self.assertAlmostEqual(recipes.on_ellipse(0.62, 0), 0.62)
        self.assertAlmostEqual(recipes.on_ellipse(0.62, 90), 1)
        self.assertAlmostEqual(recipes.on_ellipse(0.9, -60), 0.9719, places=4)  # presets/jujube-plump.toml

    def test_by_the_hour_as_they_are(self):
        def preset(hours):
            return {"moisture": {"hours": hours}, "fruit": {"skin_thickness": 0.04}, "material": {"gamma": 10}}
        given, by_the_hour = recipes.cases([("plum", preset(0)), ("raisin-sun", preset(176))], 0, 1, 0.02, False)
        self.assertEqual(given["settings"], {"drying.shrinkage": 0.3})
        self.assertEqual(by_the_hour["settings"], {})
        self.assertEqual(by_the_hour["hours_wanted"], 176)

    def test_presets_of_drying_only(self):
        listing = ("drying (`windfall dry NAME`: dry)\n\nplum-round  Plum, round\n            A plum.\n"
                   "raisin      Raisin\n\nfracture (`windfall snap NAME`: break)\n\nfig2  Figure\n")
        self.assertEqual(recipes.drying_presets(listing), ["plum-round", "raisin"])
        self.assertEqual(recipes.drying_presets(""), [])


class Outcome(unittest.TestCase):
    CASE = {"hours_wanted": None}
    SUMMARY = {"history": {"shrinkage": [0.1, 0.3, 0.2], "depth_rms_over_te": [0.2, 1.5, 1.1]}, "unknowns": 9264,
               "newton_steps": 7, "failures": 1, "onset_shrinkage": 0.09}

    def test_depth_is_that_of_the_largest_shrinkage(self):
        result = recipes.outcome(self.CASE, self.SUMMARY, 0, False, "")
        self.assertEqual((result["reached"], result["ended"], result["shrinkage"], result["depth"]),
                         (True, "done", 0.3, 1.5))

    def test_short_of_the_aim(self):
        summary = {"history": {"shrinkage": [0.1], "depth_rms_over_te": [0.2]}}
        for code, limited, message, ended in ((1, False, "equilibrium was lost", "equilibrium was lost"),
                                              (130, True, "cancelled", "stopped at the limit"),
                                              (-9, False, "", "ended with code -9")):
            result = recipes.outcome(self.CASE, summary, code, limited, message)
            self.assertEqual((result["reached"], result["ended"], result["shrinkage"]), (False, ended, 0.1))

    def test_nothing_was_written(self):
        result = recipes.outcome(self.CASE, {}, 1, False, "no mesh")
        self.assertEqual((result["reached"], result["shrinkage"], result["depth"], result["unknowns"]),
                         (False, 0.0, None, None))


class Records(CommandLine):
    def test_only_the_same_case_of_the_same_program_counts(self):
        arguments = types.SimpleNamespace(digest="abc", threads=2, limit_s=10.0)
        case = {"name": "plum", "recipe": "plum", "settings": {"drying.shrinkage": 0.3}}
        path = self.folder / "made" / "records.jsonl"
        self.assertEqual(recipes.read_records(path), [])
        wanted = recipes.identity(case, arguments)
        recipes.append_record(path, wanted | {"seconds": 1.0})
        recipes.append_record(path, wanted | {"seconds": 2.0})
        with path.open("a") as file:
            file.write('{"name": "cut o')
        recipes.append_record(path, {"name": "fig"})
        records = recipes.read_records(path)
        self.assertEqual(len(records), 3)
        self.assertEqual(recipes.find_record(records, wanted)["seconds"], 2.0)
        for change in ({"digest": "abd"}, {"threads": 1}, {"limit_s": 20.0}):
            other = types.SimpleNamespace(**{**vars(arguments), **change})
            self.assertIsNone(recipes.find_record(records, recipes.identity(case, other)))
        self.assertIsNone(recipes.find_record(records, {**wanted, "settings": {"drying.shrinkage": 0.2}}))
        recipes.forget(path, {"plum"})
        self.assertEqual(recipes.read_records(path), [{"name": "fig"}])


class TimedRuns(CommandLine):
    def test_a_run_is_stopped_at_the_limit(self):
        code, text, result = measuring.run(["bash", "-c", "echo begun; exec sleep 60"], self.folder, limit_s=0.5)
        self.assertEqual((code, text, result["limited"]), (-15, "begun\n", True))
        self.assertLess(result["wall"], 30)

    def test_a_run_that_ends_is_not(self):
        code, text, result = measuring.run(["bash", "-c", "echo $GREETING >&2; exit 3"], self.folder,
                                           {"GREETING": "hello"}, limit_s=60)
        self.assertEqual((code, text, result["limited"]), (3, "hello\n", False))
        self.assertGreater(result["memory"], 0)

    def test_error(self):
        self.assertEqual(measuring.error_of("drying: 10 %\nwindfall: error: lost. Try more\n"), "lost. Try more")


class Scripts(CommandLine):
    def bench(self, name, *arguments):
        result = subprocess.run([BENCH / name, "--program", BINARY, *map(str, arguments)], cwd=self.folder,
                                capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_drying(self):
        page = self.bench("drying", "--set", "mesh.n=8", "--set", "drying.shrinkage=0.02").stdout
        self.assertRegex(page, r"(?m)^\| unknowns \| 9,264 \| 9,264 \|$")
        self.assertIn("are the same to the last bit", page)

    def test_recipes_go_on_where_they_were(self):
        names = ["sphere", "random-01"]
        arguments = ["--quick", "--thinnest", 0.04, "--threads", 1, "--records", self.folder / "records.jsonl",
                     "--output", self.folder / "page.md"]
        first = self.bench("recipes", "--only", names[0], *arguments)
        self.assertIn("1 of 1 reached their end", first.stdout)
        both = self.bench("recipes", "--only", *names, *arguments)
        self.assertEqual(re.findall(r"(\S+) (was done|\.\.\.)", both.stderr),
                         [("sphere", "was done"), ("random-01", "...")])
        self.assertEqual((self.folder / "page.md").read_text(), both.stdout.removesuffix("\n"))
        for name in names:
            self.assertRegex(both.stdout, rf"(?m)^\| {name} \|.* 9,264 \| 0\.3000 \|.*\| done \|$")
        lines = (self.folder / "records.jsonl").read_text().splitlines()
        self.assertEqual([json.loads(line)["name"] for line in lines], names)

    def test_recipes_of_every_drying_preset(self):
        listed = self.bench("recipes", "--list").stdout
        presets = re.findall(r"(?m)^([\w-]+): windfall dry \1(?: |$)", listed)
        self.assertLessEqual({"sphere", "jujube", "raisin-sun", "potato", "wolfberry"}, set(presets))
        self.assertEqual(len(re.findall(r"(?m)^random-\d\d: windfall dry sphere ", listed)), 20)

    @unittest.skipUnless(shutil.which("ccx"), "ccx (Debian: calculix-ccx) is not installed")
    def test_calculix(self):
        page = self.bench("calculix", "--n", 8, "--threads", 1, "--set", "drying.shrinkage=0.02").stdout
        for program in ("Windfall", "CalculiX"):
            self.assertRegex(page, rf"(?m)^\| 386 \| 1 \| {program} \| 9,264 \| 0\.0200 \| \d+ \| 0 \|.*\| done \|$")


if __name__ == "__main__":
    unittest.main()
