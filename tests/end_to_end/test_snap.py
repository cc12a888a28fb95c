#!/usr/bin/env python3
"""`windfall snap` as people run it: broken branches, cracked logs, and branches of a tree of their own."""
import json
import math
import re
import unittest

from command_line import CommandLine

# A branch that breaks in an instant.
TINY_SETTINGS = ["branch.rings=10", "branch.sectors=24", "branch.layers=6", "branch.length=2", "branch.piece_length=2"]
TINY = ["fig2"] + [part for setting in TINY_SETTINGS for part in ("--set", setting)]


def tube(radius=0.1, height=4.0, around=20, along=60):
    """A closed upright cylinder as OBJ."""
    lines = ["o trunk"]
    for row in range(along + 1):
        for k in range(around):
            angle = 2 * math.pi * k / around
            lines.append(f"v {radius * math.cos(angle):.9g} {height * row / along:.9g} {-radius * math.sin(angle):.9g}")
    for row in range(along):
        for k in range(around):
            a, b = row * around + k + 1, row * around + (k + 1) % around + 1
            lines.append(f"f {a} {b} {b + around} {a + around}")
    lines.append("f " + " ".join(str(k + 1) for k in reversed(range(around))))
    lines.append("f " + " ".join(str(along * around + k + 1) for k in range(around)))
    return "\n".join(lines) + "\n"


def vertices(obj):
    return [tuple(map(float, line.split()[1:4])) for line in obj.splitlines() if line.startswith("v ")]


class WrongInput(CommandLine):
    def complaint(self, recipe, *settings):
        return self.fail_with(2, "snap", recipe, *[part for setting in settings for part in ("--set", setting)])

    def test_values_out_of_range(self):
        for key, value in (("branch.diameter_m", 0), ("branch.diameter_m", 6), ("branch.rings", 2),
                           ("branch.rings", 401), ("branch.sectors", 9), ("branch.sectors", 1001),
                           ("break.tilt_deg", 90), ("break.tilt_deg", -1), ("tissue.pith", 1.1),
                           ("roughness.sapwood", 5.1), ("roughness.sapwood_frequency", 0.5), ("high.height", -1),
                           ("low.height", 1), ("high.angle_deg", 361), ("ductile.length", 41),
                           ("ductile.probability", 2), ("branch.taper", "nan"), ("break.gap", "inf"),
                           ("roughness.phloem", "nan"), ("cracks.large_width", 0)):
            table, name = key.split(".")
            with self.subTest(key=key, value=value):
                self.assertIn(f"--set {key}={value}: {key} must be", self.complaint("fig2", f"{key}={value}"))
                recipe = self.write(f"process = 'fracture'\n[{table}]\n  {name} = {value}\n", "branch.toml")
                self.assertIn(f"branch.toml:3:3: {key} must be", self.complaint(recipe))

    def test_unknown_keys_and_types(self):
        self.assertIn("did you mean branch.rings?", self.complaint("fig2", "branch.ring=20"))
        self.assertIn("must be an integer", self.complaint("fig2", "branch.rings=20.5"))
        self.assertIn("must be one of broken, cut", self.complaint("fig2", "break.end=sawn"))
        self.assertIn("every entry", self.complaint("ailanthus", "bundles.radial=[0.5, nan, 0.1]"))
        self.assertIn("three numbers", self.complaint("fig2", "colours.bark=[0.1, 0.2]"))

    def test_what_no_single_range_says(self):
        recipe = self.write("process = 'fracture'\n[tissue]\npith = 0.4\nheartwood = 0.7\n", "branch.toml")
        self.assertRegex(self.complaint(recipe), r"branch\.toml:3:1: tissue\.pith, .* lower one")
        self.assertIn("one entry a level", self.complaint("ailanthus", "bundles.slope=[1]"))
        self.assertIn("lower break.tilt_deg", self.complaint("fig2", "break.tilt_deg=89.9"))
        self.assertIn("branch.taper to at most", self.complaint("fig2", "branch.taper=0.2", "branch.piece_length=90"))
        self.assertIn("branch.bend_deg", self.complaint("fig2", "branch.bend_deg=180", "branch.length=1"))
        self.assertIn("break.end", self.complaint("log-end", "output.motion=breaking"))
        # What only the made surface shows is found before a take is begun, too.
        self.assertIn("for a break that is", self.complaint("fig2", "break.mean_height=4", "branch.bend_deg=100",
                                                            "branch.length=3", "branch.piece_length=3"))

    def test_recipe_of_another_process(self):
        self.assertIn("is run with `windfall dry plum`", self.complaint("plum"))
        self.assertIn("is run with `windfall snap fig2`", self.fail_with(2, "dry", "fig2"))
        recipe = self.write("[branch]\nrings = 12\n", "branch.toml")
        self.assertIn('write process = "fracture"', self.complaint(recipe))
        self.assertIn('of the process "drying"', self.complaint("fig2", "fruit.r4=1"))
        self.assertIn("process can only stand in a recipe file", self.complaint("fig2", "process=drying"))

    def test_height_law_outside_its_woods_is_a_warning(self):
        result = self.run_windfall("snap", "fig2", "--dry-run", "--set", "break.height_from=species", "--set",
                                   "species.density_g_cm3=0.72", "--set", "species.bending_strength_mpa=105")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stderr, r"windfall: warning: .*break\.mean_height")


class Runs(CommandLine):
    def snap(self, *arguments):
        return self.succeed("snap", *TINY, "--no-pictures", *arguments)

    def test_dry_run_prints_the_plan_and_writes_nothing(self):
        text = self.succeed("snap", "ailanthus", "--dry-run", "--seed", 7)
        for part in ("96 rings x 320 sectors", "vertices", "mean 0.7448 radii", "frames       1",
                     "ailanthus-seed7.take"):
            self.assertIn(part, text)
        self.assertEqual(self.listing(), [])

    def test_leaves_a_take_with_its_recipe(self):
        self.assertIn("fig2-seed5.take", self.snap("--seed", 5))
        take = json.loads((self.folder / "fig2-seed5.take/take.json").read_text())
        self.assertEqual((take["process"], take["status"], take["seed"]), ("fracture", "complete", 5))
        self.assertEqual(take["unit_length_m"], 0.015)
        self.assertEqual(sorted(path.stem for path in (self.folder / "fig2-seed5.take/meshes").iterdir()),
                         ["piece", "stub"])
        self.succeed("snap", "fig2-seed5.take/recipe.toml", "--no-pictures", "-o", "again.take")
        self.assertEqual(self.frames("again.take"), self.frames("fig2-seed5.take"))

    def test_existing_take(self):
        self.snap("-o", "x.take")
        before = self.frames("x.take")
        text = self.fail_with(2, "snap", *TINY, "--no-pictures", "-o", "x.take")
        self.assertIn("--resume", text)
        self.assertIn("--force", text)
        self.snap("-o", "x.take", "--resume")  # complete: nothing to do
        self.assertEqual(self.frames("x.take"), before)
        self.assertIn("seed", self.fail_with(2, "snap", *TINY, "--no-pictures", "-o", "x.take", "--resume",
                                             "--seed", 2))
        self.snap("-o", "x.take", "--force", "--seed", 2)
        self.assertNotEqual(self.frames("x.take"), before)

    def test_threads_do_not_change_the_bits(self):
        self.snap("--threads", 1, "-o", "one.take")
        self.snap("--threads", 2, "-o", "two.take")
        self.assertEqual(self.frames("one.take"), self.frames("two.take"))

    def test_breaking_is_a_take_of_frames(self):
        output = self.succeed("snap", "storm", *TINY[1:], "--set", "output.frames=4", "--set", "output.seconds=0.2",
                              "--no-pictures", "--progress", "json", "-o", "x.take")
        events = [json.loads(line) for line in output.splitlines()]
        self.assertEqual([event["index"] for event in events if event["event"] == "frame"], [0, 1, 2, 3])
        self.assertEqual(len(json.loads(self.succeed("measure", "x.take", "--json"))["frames"]), 4)

    def test_interrupted_breaking_goes_on_to_the_same_bits(self):
        long = ["snap", "storm", *TINY[1:], "--set", "output.frames=40", "--no-pictures"]
        self.succeed(*long, "-o", "whole.take")
        code, seconds, errors = self.interrupt([*long, "-o", "x.take"],
                                               lambda event: event["event"] == "frame" and event["index"] == 3)
        self.assertEqual(code, 130, errors)
        self.assertLess(seconds, 2)
        command = re.search(r"`windfall (.*)`", errors)
        self.assertIsNotNone(command, errors)
        self.assertLess(len(self.frames("x.take")), len(self.frames("whole.take")))
        self.succeed(*command.group(1).split(), "--no-pictures")  # just what the message says
        self.assertEqual(self.frames("x.take"), self.frames("whole.take"))

    def test_measure(self):
        self.snap("-o", "x.take")
        measures = json.loads(self.succeed("measure", "x.take", "--json"))
        for key in ("mean_height", "lowest", "highest", "stub_thorns", "piece_thorns", "law_height", "area",
                    "area_sapwood", "area_over_section", "fractal_dimension", "cracks_opened", "strands"):
            self.assertIn(key, measures)
        self.assertIn("stub_volume", measures["frames"][0])
        self.assertGreaterEqual(measures["fractal_dimension"], 1.97)
        self.assertIn("fractal_dimension", self.succeed("measure", "x.take"))

    def test_show_and_export(self):
        self.snap("-o", "x.take")
        self.succeed("show", "x.take", "--kind", "frame", "--view", "break", "--size", 32, "--samples", 1, "-o", "one")
        self.assertEqual(len(list((self.folder / "one").glob("*.png"))), 1)
        self.fail_with(2, "show", "x.take", "--view", "inside", "-o", "two")
        self.succeed("export", "x.take", "--to", "glb", "-o", "x.glb")
        self.assertEqual((self.folder / "x.glb").read_bytes()[:4], b"glTF")
        self.assertIn("fracture", self.fail_with(2, "export", "x.take", "--to", "inp", "-o", "x.inp"))


class Trees(CommandLine):
    """A branch of an artist's mesh."""
    SMALL = ["--recipe", "fig2", "--set", "branch.rings=8", "--set", "branch.sectors=20"]

    def setUp(self):
        super().setUp()
        self.write(tube(), "trunk.obj")

    def test_breaks_a_tree(self):
        text = self.succeed("snap", "trunk.obj", "--at", "0.1,2,0", *self.SMALL)
        self.assertIn("trunk-snapped.obj", text)
        after = (self.folder / "trunk-snapped.obj").read_text()
        before, broken = vertices(tube()), vertices(after)
        self.assertEqual(broken[:20 * 20], before[:20 * 20])  # the lower third is what it was
        self.assertGreater(len(broken), len(before))
        self.assertIn("is there already", self.fail_with(2, "snap", "trunk.obj", "--at", "0.1,2,0", *self.SMALL))
        self.succeed("snap", "trunk.obj", "--at", "0.1,2,0", *self.SMALL, "--force", "--seed", 3)
        self.assertTrue((self.folder / "trunk-snapped.obj").read_text() != after)

    def test_dry_run_tells_what_is_there(self):
        before = self.listing()
        text = self.succeed("snap", "trunk.obj", "--at", "0.1,2,0", *self.SMALL, "--dry-run")
        self.assertRegex(text, r"branch +at .* 0\.1\d* thick, along")
        self.assertEqual(self.listing(), before)

    def test_wrong_input(self):
        def complaint(*arguments):
            return self.fail_with(2, "snap", *arguments)

        self.assertIn("--at x,y,z", complaint("trunk.obj"))
        for point in ("1,2", "1,2,3,4", "1,2,x", "nan,1,2", "", "1, 2, 3"):
            with self.subTest(point=point):
                self.assertIn("--at", complaint("trunk.obj", "--at", point))
        complaint("trunk.obj", "--at", "3,2,0", *self.SMALL)  # off the tree
        complaint("trunk.obj", "--at", "0.1,0.02,0", *self.SMALL)  # no room below
        self.assertIn("none.glb", complaint("none.glb", "--at", "0,0,0"))
        self.assertIn("needs a tree", complaint("fig2", "--at", "0,0,0"))
        self.assertIn("--resume", complaint("trunk.obj", "--at", "0.1,2,0", "--resume"))
        self.assertIn(".obj", complaint("trunk.obj", "--at", "0.1,2,0", "-o", "out.glb"))
        self.assertIn("--unit-m", complaint("trunk.obj", "--at", "0.1,2,0", "--unit-m", 0))
        self.assertIn("drying", complaint("trunk.obj", "--at", "0.1,2,0", "--recipe", "plum"))
        self.assertIn("sawn log", complaint("trunk.obj", "--at", "0.1,2,0", "--recipe", "log-end"))
        self.write("v 0 0 0\nf 1 2 3\n", "broken.obj")
        self.assertIn("broken.obj", complaint("broken.obj", "--at", "0,0,0"))
        self.write(tube().rsplit("\nf ", 1)[0] + "\n", "open.obj")  # without its upper lid
        self.fail_with(2, "snap", "open.obj", "--at", "0.1,3.9,0", *self.SMALL)


if __name__ == "__main__":
    unittest.main()
