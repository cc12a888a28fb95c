#!/usr/bin/env python3
"""The program as people run it: arguments, texts, exit codes, files.

Needs the built program in the environment variable WINDFALL_BINARY. Tests of classes whose name ends in "Runs" solve a
(tiny) drying problem; the others only need the recipe and the command line.
"""
import base64
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import unittest

from command_line import BINARY, CommandLine

PRESETS = {
    "dry": ["banana", "bean", "emblic", "fig", "jujube", "jujube-plump", "mandarin", "pepper", "plum", "plum-round",
            "potato", "raisin", "raisin-soaked", "raisin-sun", "sphere", "wolfberry"],
    "snap": ["ailanthus", "chinese-juniper", "cypress", "fig15", "fig16", "fig17", "fig18", "fig19", "fig2",
             "goldenrain", "green-branch", "log-end", "log-end-pine", "storm"],
}

# A fruit that dries in seconds: coarse mesh, skin thick enough for it, little shrinkage.
TINY_SETTINGS = ["mesh.n=8", "fruit.skin_thickness=0.15", "drying.shrinkage=0.1", "output.frames=3"]
TINY = ["sphere"] + [part for setting in TINY_SETTINGS for part in ("--set", setting)]


# Two white pixels by two.
WHITE_PNG = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAADklEQVR42mP4DwYMEAoAU7oL9YXEbhEAAAAASUVORK5CYII=")
BLACK_PNG = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAC0lEQVR4nGNgQAYAAA4AAamRc7EAAAAASUVORK5CYII=")


class Texts(CommandLine):
    COMMANDS = ["dry", "snap", "show", "export", "measure", "presets", "schema", "doctor"]

    def test_version(self):
        self.assertRegex(self.succeed("--version"), r"^windfall \d+\.\d+\.\d+")

    def test_help_of_every_command_has_examples(self):
        text = self.succeed("--help")
        for command in self.COMMANDS:
            self.assertIn(f"  {command} ", text)
            with self.subTest(command=command):
                help_text = self.succeed(command, "--help")
                self.assertIn("Example", help_text)
                self.assertIn(f"windfall {command}", help_text)

    def test_help_of_a_process_refers_to_its_schema(self):
        for command, process in (("dry", "drying"), ("snap", "fracture")):
            self.assertIn(f"windfall schema {process}", self.succeed(command, "--help"))
            self.assertEqual(self.succeed(command, "--help-parameters"), self.succeed("schema", process))
            self.assertIn(self.succeed("schema", process), self.succeed("schema"))

    def test_wrong_arguments(self):
        for arguments in ([], ["dry"], ["bake"], ["dry", "sphere", "--colour", "red"], ["dry", "sphere", "plum"],
                          ["dry", "sphere", "--progress", "loud"], ["dry", "sphere", "--threads", "-1"],
                          ["dry", "sphere", "--threads", "many"], ["dry", "sphere", "--seed", "x"],
                          ["dry", "sphere", "--resume", "--force"], ["export", "x.take"], ["presets", "--resolved"]):
            with self.subTest(arguments=arguments):
                self.fail_with(2, *arguments)

    def test_schema_is_json_and_complete(self):
        processes = json.loads(self.succeed("schema", "--json"))["processes"]
        self.assertEqual(list(processes), ["decay", "drying", "fracture"])
        for name, process in processes.items():
            keys = [parameter["key"] for parameter in process["parameters"]]
            self.assertEqual(len(keys), len(set(keys)))
            text = self.succeed("schema", name)
            for parameter in process["parameters"]:
                self.assertLessEqual({"key", "group", "type", "unit", "range", "minimum", "maximum", "default",
                                      "choices", "doc", "needs_run"}, parameter.keys())
                self.assertTrue(parameter["doc"], parameter["key"])
                self.assertIn(f"  {parameter['key']} = ", text)
            self.assertIn("seed", keys)
        for key in ("fruit.r4", "material.gamma", "mesh.n", "look.dry_colour"):
            self.assertIn(key, [parameter["key"] for parameter in processes["drying"]["parameters"]])
        for key in ("branch.rings", "break.tilt_deg", "bundles.radial", "cracks.large_count", "colours.wood"):
            self.assertIn(key, [parameter["key"] for parameter in processes["fracture"]["parameters"]])

    def test_every_default_of_the_schema_is_accepted(self):
        processes = json.loads(self.succeed("schema", "--json"))["processes"]
        for preset, process in (("sphere", processes["drying"]), ("fig2", processes["fracture"])):
            recipe = []
            for parameter in process["parameters"]:
                recipe += ["--set", f"{parameter['key']}={json.dumps(parameter['default'])}"]
            self.succeed(process["command"], preset, "--dry-run", *recipe)

    def test_presets(self):
        text = self.succeed("presets")
        for command, names in PRESETS.items():
            self.assertIn(f"windfall {command} NAME", text)
            for name in names:
                self.assertRegex(text, rf"(?m)^{name}\s+\S")
                with self.subTest(preset=name):
                    self.write(self.succeed("presets", name), f"copy-of-{name}.toml")
                    self.succeed(command, f"copy-of-{name}.toml", "--dry-run")
                    # The resolved recipe is the same recipe.
                    resolved = self.succeed("presets", name, "--resolved")
                    self.assertIn("[output]", resolved)
                    self.write(resolved, "resolved.toml")
                    self.assertEqual(self.succeed(command, "resolved.toml", "--dry-run"),
                                     self.succeed(command, name, "--dry-run"))

    def test_presets_of_a_wrong_name(self):
        self.assertIn("did you mean raisin?", self.fail_with(2, "presets", "rasin"))

    def test_recipes_of_the_documentation(self):
        page = pathlib.Path(__file__).resolve().parents[2] / "docs" / "recipes.md"
        recipes = re.findall(r"(?ms)^```toml\n(.*?)^```", page.read_text())
        self.assertEqual(len(recipes), 4)
        for recipe in recipes:
            branch = 'process = "fracture"' in recipe or 'preset = "cypress"' in recipe
            self.succeed("snap" if branch else "dry", self.write(recipe), "--dry-run")

    def test_parameter_reference_is_up_to_date(self):
        script = pathlib.Path(__file__).resolve().parents[2] / "tools" / "make-parameter-reference"
        result = subprocess.run([script, "--check", BINARY], capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_doctor(self):
        text = self.succeed("doctor")
        for line in ("windfall", "processor", "kernels", "threads", "memory", "disk", "Eigen", "Embree", "ffmpeg"):
            self.assertRegex(text, rf"(?m)^{line}\s+\S")

    def test_dry_run_prints_the_plan_and_writes_nothing(self):
        text = self.succeed("dry", "jujube", "--dry-run", "--seed", 7)
        for part in ("mesh", "unknowns", "wave length", "jujube-seed7.take"):
            self.assertIn(part, text)
        self.assertEqual(self.listing(), [])

    def test_dry_run_warns_of_too_few_elements(self):
        result = self.run_windfall("dry", "sphere", "--dry-run", "--set", "mesh.n=8")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"windfall: warning: .*mesh\.n")


class WrongInput(CommandLine):
    def complaint(self, recipe, *settings):
        arguments = [part for setting in settings for part in ("--set", setting)]
        return self.fail_with(2, "dry", recipe, *arguments)

    def test_values_out_of_range(self):
        for key, value in (("fruit.r4", -1), ("fruit.r4", 0), ("fruit.stone_r1", 0), ("fruit.skin_thickness", 0),
                           ("fruit.skin_thickness", -0.01), ("material.gamma", 0), ("material.gamma", -10),
                           ("drying.shrinkage", 1), ("drying.shrinkage", 1.5), ("fruit.r3", "nan"),
                           ("material.gamma", "inf"), ("drying.shrinkage", "nan")):
            table, name = key.split(".")
            with self.subTest(key=key, value=value):
                self.assertIn(f"--set {key}={value}: {key} must be", self.complaint("sphere", f"{key}={value}"))
                recipe = self.write(f"# a fruit\n[{table}]\n  {name} = {value}\n")
                self.assertIn(f"fruit.toml:3:3: {key} must be", self.complaint(recipe))

    def test_stone_that_pierces_the_skin(self):
        recipe = self.write("[fruit]\nr4 = 0.5\nr8 = 0.5\nstone_r2 = 0.6\n")
        text = self.complaint(recipe)
        self.assertIn("fruit.toml:4:1: ", text)
        self.assertIn("stone", text)
        self.assertIn("stone", self.complaint("sphere", "fruit.stone_r1=1.2"))

    def test_shape_that_folds(self):
        self.complaint("sphere", "fruit.r3=8", "fruit.r4=0.05")

    def test_unknown_and_misspelt_keys(self):
        recipe = self.write("[fruit]\nskin_thicknes = 0.03\n")
        self.assertIn("fruit.toml:2:1: fruit.skin_thicknes is not a parameter; did you mean fruit.skin_thickness?",
                      self.complaint(recipe))
        self.assertIn("did you mean [material]?", self.complaint(self.write("[materail]\ngamma = 3\n")))
        self.assertIn("windfall schema", self.complaint("sphere", "nonsense=1"))
        self.assertIn("did you mean mesh.n?", self.complaint("sphere", "mesh.m=8"))

    def test_wrong_types(self):
        self.assertIn("fruit.toml:2:1: fruit.r4 must be a number, not \"wide\"",
                      self.complaint(self.write("[fruit]\nr4 = 'wide'\n")))
        self.assertIn("must be an integer", self.complaint("sphere", "mesh.n=8.5"))
        self.assertIn("must be one of noise, modes, none", self.complaint("sphere", "imperfection.kind=waves"))

    def test_all_mistakes_at_once(self):
        text = self.complaint(self.write("titel = 'x'\n[fruit]\nr4 = -1\nr5 = 'a'\n"), "seed=-1")
        for part in ("fruit.toml:1:1:", "fruit.toml:3:1:", "fruit.toml:4:1:", "--set seed=-1:"):
            self.assertIn(part, text)

    def test_broken_toml(self):
        self.assertRegex(self.complaint(self.write("[fruit]\nr4 == 1\n")), r"fruit\.toml:2:\d+: ")
        self.assertRegex(self.complaint(self.write("[fruit]\nr4 = 1\nr4 = 2\n")), r"fruit\.toml:3:\d+: ")
        self.assertRegex(self.complaint(self.write(b"title = '\xff'\n")), r"fruit\.toml:1:\d+: ")

    def test_files_that_cannot_be_read(self):
        self.assertIn("none.toml: No such file", self.complaint("none.toml"))
        self.assertIn("is a folder", self.complaint("./"))
        # Opens, but reading fails, also for root.
        self.assertIn("cannot read the recipe /proc/self/mem", self.complaint("/proc/self/mem"))
        if os.geteuid() != 0:
            name = self.write("seed = 1\n")
            os.chmod(self.folder / name, 0)
            self.assertIn("Permission denied", self.complaint(name))

    def test_huge_file(self):
        self.assertIn("is bigger than 1 MiB", self.complaint(self.write("#" * (2 << 20))))

    def test_unknown_preset(self):
        self.assertIn("there is no preset \"jujub\"; did you mean jujube", self.complaint("jujub"))

    def test_folder_that_cannot_be_written(self):
        self.write("", "file")
        for folder in ("file/x.take", "/proc/x.take"):
            with self.subTest(folder=folder):
                self.assertIn(folder, self.fail_with(2, "dry", *TINY, "-o", folder))

    def test_folder_that_holds_something_else(self):
        (self.folder / "letters").mkdir()
        self.write("dear", "letters/letter.txt")
        for option in ((), ("--force",)):
            self.assertIn("not a take", self.fail_with(2, "dry", *TINY, "-o", "letters", *option))

    def test_resume_without_a_take(self):
        self.assertIn("x.take", self.fail_with(2, "dry", *TINY, "-o", "x.take", "--resume"))

    def test_take_that_is_none(self):
        for command in (["show"], ["measure"], ["export", "--to", "obj"]):
            with self.subTest(command=command):
                self.assertIn("x.take", self.fail_with(2, *command, "x.take"))

    def test_errors_as_json(self):
        result = self.run_windfall("dry", "sphere", "--set", "fruit.r4=-1", "--progress", "json")
        self.assertEqual(result.returncode, 2)
        event = json.loads(result.stdout)
        self.assertEqual((event["event"], event["exit_code"]), ("error", 2))
        self.assertIn("fruit.r4 must be", event["message"])
        self.assertIn("fruit.r4 must be", result.stderr)


class TinyRuns(CommandLine):
    def dry(self, *arguments, **options):
        return self.succeed("dry", *TINY, "--no-pictures", *arguments, **options)

    def status(self, take):
        return json.loads((self.folder / take / "take.json").read_text())["status"]

    def test_leaves_a_take_with_its_recipe(self):
        self.assertIn("sphere-seed5.take", self.dry("--seed", 5))
        self.assertEqual(self.status("sphere-seed5.take"), "complete")
        self.assertEqual(len([name for name in self.frames("sphere-seed5.take") if name.startswith("frames")]), 3)
        self.assertEqual(self.succeed("dry", "sphere-seed5.take/recipe.toml", "--dry-run"),
                         self.succeed("dry", *TINY, "--seed", 5, "--dry-run"))

    def test_drying_by_the_hour(self):
        # The paint is a file beside the recipe.
        (self.folder / "paint.png").write_bytes(WHITE_PNG)
        (self.folder / "sun.toml").write_text(
            'preset = "raisin-sun"\n[mesh]\nn = 8\n[fruit]\nskin_thickness = 0.15\n'
            '[moisture]\nhours = 30\nmap = "paint.png"\n[output]\nhours = [10.0, 20.0]\n')
        self.succeed("dry", "sun.toml", "--no-pictures", "-o", "whole.take")
        frames = json.loads(self.succeed("measure", "whole.take", "--json"))["frames"]
        self.assertEqual([frame["hours"] for frame in frames], [0, 10, 20, 30])
        start = frames[0]["water_left_g"] + frames[0]["solids_g"]
        for before, after in zip(frames, frames[1:]):
            self.assertGreater(after["water_lost_g"], before["water_lost_g"])
            self.assertGreater(after["shrinkage"], before["shrinkage"])
            self.assertLess(after["moisture_min"], after["moisture_max"])
            self.assertAlmostEqual((after["water_lost_g"] + after["water_left_g"] + after["solids_g"]) / start, 1,
                                   delta=1e-9)
        self.assertIn("water lost", self.succeed("measure", "whole.take"))
        self.succeed("dry", "sun.toml", "--no-pictures", "-o", "one.take", "--threads", 1)
        self.assertEqual(self.frames("one.take"), self.frames("whole.take"))
        self.succeed("show", "whole.take", "--kind", "frame", "--colour", "moisture", "--size", 64, "--samples", 1)
        self.assertIn("moisture.map", self.fail_with(2, "dry", "sun.toml", "--set", "moisture.map=gone.png"))
        self.assertIn("climate.humidity", self.fail_with(2, "dry", "sun.toml", "--set", "climate.humidity=1.4"))
        # Over the texture coordinates of an artist's mesh it is painted too.
        (self.folder / "black.png").write_bytes(BLACK_PNG)
        bean = ["dry", "bean", "--set", "mesh.n=8", "--set", "fruit.skin_thickness=0.1", "--set", "moisture.hours=9",
                "--set", "moisture.start_hour=8", "--no-pictures"]
        lost = {}
        for paint in ["paint", "black"]:
            self.succeed(*bean, "--set", f"moisture.map={self.folder / paint}.png", "-o", f"{paint}.take")
            frames = json.loads(self.succeed("measure", f"{paint}.take", "--json"))["frames"]
            lost[paint] = frames[-1]["water_lost_g"]
        self.assertGreater(lost["paint"], 1e-6)
        self.assertEqual(lost["black"], 0)
        # A mesh that is not unwrapped cannot be painted on.
        lines = (pathlib.Path(__file__).parents[2] / "presets" / "meshes" / "bean.obj").read_text().splitlines()
        (self.folder / "bare.obj").write_text("\n".join(
            re.sub(r"/\d+", "", line) for line in lines if not line.startswith("vt")))
        bare = [*bean, "--set", "fruit.mesh=bare.obj"]
        self.succeed(*bare, "--dry-run")
        paint = ["--set", f"moisture.map={self.folder / 'black.png'}"]
        self.assertIn("fruit.uvs", self.fail_with(2, *bare, *paint, "--dry-run"))
        self.succeed(*bare, *paint, "--set", "fruit.uvs=atlas", "--dry-run")

    def test_existing_take(self):
        self.dry("-o", "x.take")
        before = self.frames("x.take")
        text = self.fail_with(2, "dry", *TINY, "-o", "x.take")
        self.assertIn("--resume", text)
        self.assertIn("--force", text)
        self.assertEqual(self.frames("x.take"), before)
        self.dry("-o", "x.take", "--force", "--seed", 2)
        self.assertNotEqual(self.frames("x.take"), before)

    def test_resume_of_a_complete_take_changes_nothing(self):
        self.dry("-o", "x.take")
        before = self.frames("x.take")
        self.dry("-o", "x.take", "--resume")
        self.assertEqual(self.frames("x.take"), before)
        self.assertEqual(self.status("x.take"), "complete")

    def test_resume_with_another_recipe(self):
        self.dry("-o", "x.take")
        self.assertIn("material.gamma", self.fail_with(2, "dry", *TINY, "-o", "x.take", "--resume", "--set",
                                                       "material.gamma=11"))

    def test_one_and_two_threads_give_the_same_bits(self):
        self.dry("--set", "mesh.n=16", "--threads", 1, "-o", "one.take")
        self.dry("--set", "mesh.n=16", "--threads", 2, "-o", "two.take")
        self.assertEqual(self.frames("one.take"), self.frames("two.take"))

    def test_another_seed_gives_another_fruit(self):
        self.dry("--seed", 1, "-o", "one.take")
        self.dry("--seed", 2, "-o", "two.take")
        self.assertNotEqual(self.frames("one.take"), self.frames("two.take"))

    def test_json_lines(self):
        output = self.succeed("dry", *TINY, "--no-pictures", "--progress", "json", "-o", "x.take")
        events = [json.loads(line) for line in output.splitlines()]
        kinds = [event["event"] for event in events]
        self.assertLessEqual(set(kinds), {"warning", "progress", "frame", "done"})
        self.assertEqual([event["index"] for event in events if event["event"] == "frame"], [0, 1, 2])
        self.assertEqual(kinds[-1], "done")
        self.assertEqual(events[-1]["take"], "x.take")
        progress = [event for event in events if event["event"] == "progress"]
        self.assertGreater(len(progress), 2)
        for event in progress:
            self.assertLessEqual({"stage", "done", "total", "seconds_left", "detail"}, event.keys())
            self.assertLessEqual(event["done"], event["total"] * (1 + 1e-12))

    def test_plain_lines_and_silent_stdout(self):
        result = self.run_windfall("dry", *TINY, "--no-pictures", "--progress", "plain", "-o", "x.take")
        self.assertEqual(result.stdout, "take: x.take\n")
        self.assertIn("100 %", result.stderr)
        self.assertNotIn("\r", result.stderr)

    def test_full_disk(self):
        def limit_files():
            # Writes beyond the limit fail as on a full disk (EFBIG in place of ENOSPC) while the signal is ignored.
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (10000, 10000))

        text = self.fail_with(1, "dry", *TINY, "--no-pictures", "-o", "x.take", preexec_fn=limit_files)
        self.assertIn("x.take", text)
        self.assert_whole("x.take")

    def test_full_file_system(self):
        script = ("mkdir disk && mount -t tmpfs -o size=48k tmpfs disk && "
                  '"$@"; code=$?; cp -r disk left; exit $code')
        namespace = ["unshare", "--user", "--map-root-user", "--mount"]
        if subprocess.run([*namespace, "sh", "-c", "mount -t tmpfs tmpfs /mnt"], capture_output=True).returncode != 0:
            self.skipTest("this machine lets nobody mount a small file system")
        result = subprocess.run([*namespace, "sh", "-c", script, "sh", BINARY, "dry", *TINY, "--no-pictures", "-o",
                                 "disk/x.take"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("No space left", result.stderr)
        self.assert_whole("left/x.take")

    def assert_whole(self, take):
        """No file of the take is half-written: nothing temporary is left and what has a name can be read."""
        names = [path.name for path in (self.folder / take).rglob("*")]
        self.assertTrue((self.folder / take / "take.json").exists() or not names, names)
        self.assertEqual([name for name in names if "tmp" in name or "temp" in name], [])
        if (self.folder / take / "take.json").exists():
            json.loads((self.folder / take / "take.json").read_text())

    def test_measure(self):
        self.dry("-o", "x.take")
        measures = json.loads(self.succeed("measure", "x.take", "--json"))
        self.assertEqual(len(measures["frames"]), 3)
        for key in ("shrinkage", "time", "flesh_volume_ratio", "total_volume_ratio", "depth_rms_over_te",
                    "wavelength_over_te", "valleys", "ridge_meridian_alignment", "depth_rms_by_latitude"):
            self.assertIn(key, measures["frames"][-1])
        for key in ("onset_shrinkage", "unknowns", "elapsed_s", "peak_memory_bytes", "newton_steps",
                    "linear_iterations"):
            self.assertIn(key, measures)
        self.assertAlmostEqual(measures["frames"][-1]["shrinkage"], 0.1)
        self.assertAlmostEqual(measures["frames"][-1]["flesh_volume_ratio"], 0.9 ** 3, delta=0.04)
        text = self.succeed("measure", "x.take")
        self.assertEqual(len(re.findall(r"(?m)^ +\d+ ", text)), 3)
        self.assertIn("unknowns", text)

    def test_export(self):
        self.dry("-o", "x.take")
        self.succeed("export", "x.take", "--to", "obj,ply,glb")
        suffixes = sorted(path.suffix for path in (self.folder / "x.take/export").iterdir())
        self.assertEqual(suffixes, [".glb"] + 3 * [".obj"] + 3 * [".ply"])
        self.succeed("export", "x.take", "--to", "obj", "--frame", 2, "-o", "last.obj")
        self.assertIn("\nv ", "\n" + (self.folder / "last.obj").read_text())
        self.fail_with(2, "export", "x.take", "--to", "obj", "--frame", 2, "-o", "last.obj")
        self.fail_with(2, "export", "x.take", "--to", "obj", "--frame", 3, "-o", "none.obj")
        self.fail_with(2, "export", "x.take", "--to", "fbx")
        self.fail_with(2, "export", "x.take", "--to", "obj,ply", "-o", "both.obj")
        self.fail_with(2, "export", "x.take", "--to", "obj", "--scale", 0, "-o", "flat.obj")
        self.succeed("export", "x.take", "--to", "inp", "-o", "fruit.inp")
        deck = (self.folder / "fruit.inp").read_text()
        self.assertIn("*ELEMENT, TYPE=C3D8, ELSET=SKIN\n", deck)
        self.assertTrue(deck.endswith("*END STEP\n"))
        self.fail_with(2, "export", "x.take", "--to", "inp", "-o", "fruit.inp")
        self.fail_with(2, "export", "x.take", "--to", "inp", "-o", "fruit.obj")

    def test_show(self):
        self.dry("-o", "x.take")
        small = ["--size", 48, "--samples", 1]
        self.succeed("show", "x.take", *small)
        sheet = self.folder / "x.take/pictures/contact-sheet.png"
        self.assertEqual(sheet.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.fail_with(2, "show", "x.take", *small)
        self.succeed("show", "x.take", *small, "--force", "--set", "look.gloss=0.1")
        self.succeed("show", "x.take", *small, "--kind", "frame", "--frame", 1, "--colour", "curvature", "-o", "one")
        self.assertEqual(len(list((self.folder / "one").glob("*.png"))), 1)
        self.fail_with(2, "show", "x.take", *small, "--kind", "hologram")
        self.assertIn("look.*", self.fail_with(2, "show", "x.take", *small, "--set", "material.gamma=3", "-o", "two"))


class InterruptedRuns(CommandLine):
    """Ctrl-C and what comes after."""

    # Enough steps that a signal after the second frame comes long before the end.
    LONG = ["sphere", "--set", "mesh.n=8", "--set", "fruit.skin_thickness=0.15", "--set", "drying.shrinkage=0.2",
            "--set", "solver.max_step=0.001", "--set", "output.frames=41", "--no-pictures"]

    def test_resumed_run_equals_uninterrupted_one(self):
        self.succeed("dry", *self.LONG, "-o", "whole.take")
        for stop_at in (0, 2, 17):
            with self.subTest(stop_at=stop_at):
                take = f"stopped-{stop_at}.take"
                code, _, errors = self.interrupt(["dry", *self.LONG, "-o", take],
                                                 lambda event: event["event"] == "frame" and event["index"] == stop_at)
                self.assertEqual(code, 130, errors)
                self.assertEqual(json.loads((self.folder / take / "take.json").read_text())["status"], "cancelled")
                self.assertLess(len(self.frames(take)), len(self.frames("whole.take")))
                command = re.search(r"`windfall (.*)`", errors)
                self.assertIsNotNone(command, errors)
                self.succeed(*command.group(1).split(), "--no-pictures")  # just what the message says
                self.assertEqual(self.frames(take), self.frames("whole.take"))

    def test_killed_run_can_be_resumed(self):
        self.succeed("dry", *self.LONG, "-o", "whole.take")
        code, _, errors = self.interrupt(["dry", *self.LONG, "-o", "killed.take"],
                                         lambda event: event["event"] == "frame" and event["index"] == 5,
                                         signal.SIGKILL)
        self.assertEqual(code, -signal.SIGKILL, errors)
        self.succeed("dry", *self.LONG, "-o", "killed.take", "--resume")
        self.assertEqual(self.frames("killed.take"), self.frames("whole.take"))

    def test_interrupted_while_drawing(self):
        code, seconds, errors = self.interrupt(["dry", *TINY, "-o", "x.take"],
                                               lambda event: event.get("stage") == "pictures")
        self.assertEqual(code, 130, errors)
        self.assertLess(seconds, 2)
        self.assertIn("windfall show x.take", errors)
        self.assertEqual(json.loads((self.folder / "x.take/take.json").read_text())["status"], "complete")

    def test_ends_within_two_seconds(self):
        for which in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(signal=which):
                # The base case at its full size.
                code, seconds, errors = self.interrupt(
                    ["dry", "sphere", "-o", f"{which.name}.take"],
                    lambda event: event["event"] == "progress" and event["done"] > 0, which)
                self.assertEqual(code, 130, errors)
                self.assertLess(seconds, 2)
                self.assertIn("--resume", errors)


if __name__ == "__main__":
    unittest.main()
