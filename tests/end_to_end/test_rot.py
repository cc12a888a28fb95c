#!/usr/bin/env python3
"""`windfall rot` as people run it: fruit that rots, its maps, its measures."""
import hashlib
import json
import math
import re
import struct
import unittest
import zlib

from command_line import CommandLine

# An orange that rots in an instant.
TINY_SETTINGS = ["body.skin_cells=10", "body.flesh_cells=4", "output.texels=64", "output.frames=4",
                 "output.hours_per_frame=12"]
TINY = ["orange"] + [part for setting in TINY_SETTINGS for part in ("--set", setting)]


def maps(take):
    return {str(path.relative_to(take)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted((take / "maps").rglob("*.png"))}


def png(size, bright):
    """A square grey picture whose pixels (x, y) for which `bright` says so are white."""
    rows = b"".join(b"\0" + bytes(255 if bright(x, y) else 0 for x in range(size)) for y in range(size))
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 0, 0, 0, 0)), (b"IDAT", zlib.compress(rows)),
              (b"IEND", b"")]
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks)


def potato(cells=8, leave_out=0, uvs=True, shift=0.0):
    """A lumpy closed body as OBJ: the six sides of a cube, each a chart of its own, seams doubled."""
    lines, faces = ["o potato"], []
    for side in range(6):
        axis, sign = side // 2, 1 if side % 2 else -1
        first = side * (cells + 1) ** 2 + 1
        for j in range(cells + 1):
            for i in range(cells + 1):
                a, b = 2 * i / cells - 1, 2 * j / cells - 1
                point = [0.0, 0.0, 0.0]
                point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = sign, sign * a, b
                length = math.sqrt(sum(x * x for x in point))
                x, y, z = (c / length for c in point)
                lump = 1 + 0.15 * math.sin(3 * x + 1) * math.cos(2 * y) + 0.1 * z
                lines.append(f"v {1.3 * lump * x:.9g} {lump * y:.9g} {0.9 * lump * z:.9g}")
                if uvs:
                    lines.append(f"vt {(side % 3 + 0.05 + 0.9 * i / cells) / 3 + shift:.9g} "
                                 f"{(side // 3 + 0.05 + 0.9 * j / cells) / 2:.9g}")
        for j in range(cells):
            for i in range(cells):
                a = first + j * (cells + 1) + i
                faces.append((a, a + 1, a + cells + 2, a + cells + 1))
    for face in faces[leave_out:]:
        lines.append("f " + " ".join(f"{v}/{v}" if uvs else str(v) for v in face))
    return "\n".join(lines) + "\n"


class WrongInput(CommandLine):
    def complaint(self, recipe, *settings, extra=()):
        return self.fail_with(2, "rot", recipe, *[part for setting in settings for part in ("--set", setting)], *extra)

    def test_values_out_of_range(self):
        for key, value in (("fruit.mass_kg", 0), ("fruit.firmness", 0), ("fruit.thickness", 101),
                           ("climate.humidity", 1.4), ("climate.temperature_c", 80), ("growth.propagation", 10),
                           ("output.texels", 32), ("output.texels", 5000), ("body.softening", 0),
                           ("output.hours_per_frame", "nan"), ("water.rot_leak", 0.5), ("pile.count", 0)):
            with self.subTest(key=key, value=value):
                self.assertIn(f"--set {key}={value}: {key} must be", self.complaint("orange", f"{key}={value}"))

    def test_what_no_single_range_says(self):
        self.assertIn("fruit.water_kg", self.complaint("orange", "fruit.water_kg=0.2"))
        self.assertIn("even", self.complaint("orange", "output.texels=65"))
        self.assertIn("did you mean", self.complaint("orange", "growth.groth=3"))
        self.assertIn("penicillium-digitatum", self.complaint("orange", "growth.fungi=penicilium-digitatum"))
        self.assertIn("climate.hours", self.complaint("orange", "climate.name=table"))
        self.assertIn("nothing begins to rot",
                      self.complaint("orange", "start.random=0", "start.contacts=false"))
        self.assertIn("is run with `windfall rot orange`", self.fail_with(2, "dry", "orange"))

    def test_wounds_off_the_fruit_and_bad_masks(self):
        self.assertIn("away from the fruit", self.complaint("orange", extra=("--wound", "0.5,0.5,0.5")))
        self.assertIn("three numbers", self.complaint("orange", extra=("--wound", "0.5,0.5")))
        self.assertIn("none.png", self.complaint("orange", "start.mask=none.png"))
        self.write(b"no picture", "bad.png")
        self.assertIn("bad.png", self.complaint("orange", "start.mask=bad.png"))


    def test_meshes_that_are_no_fruit(self):
        recipe = self.write("preset = 'orange'\n[fruit]\nkind = 'mesh'\nmesh = 'potato.obj'\n")
        self.assertIn("potato.obj", self.complaint(recipe))
        self.write(potato(leave_out=1), "potato.obj")
        self.assertIn("hole", self.complaint(recipe))
        self.write(potato(uvs=False), "potato.obj")
        self.assertIn('fruit.uvs = "atlas"', self.complaint(recipe))
        self.write(potato(shift=1.0), "potato.obj")
        self.assertIn('fruit.uvs = "atlas"', self.complaint(recipe))
        self.assertIn("fruit.mesh", self.complaint("orange", "fruit.kind=mesh"))


class Runs(CommandLine):
    def rot(self, *arguments):
        return self.succeed("rot", *TINY, "--no-pictures", *arguments)

    def test_dry_run_prints_the_plan_and_writes_nothing(self):
        text = self.succeed("rot", "orange", "--dry-run")
        for part in ("140 g", "10088 vertices", "512 x 512", "501", "orange-seed1.take"):
            self.assertIn(part, text)
        self.assertEqual(self.listing(), [])

    def test_leaves_a_take_with_maps_and_measures(self):
        self.rot("--seed", 5)
        take = self.folder / "orange-seed5.take"
        self.assertEqual(json.loads((take / "take.json").read_text())["process"], "decay")
        self.assertEqual(len(maps(take)), 4 * 4)
        frames = json.loads(self.succeed("measure", take, "--json"))["frames"]
        self.assertEqual(len(frames), 4)
        self.assertGreater(frames[3]["water_lost_g"], 1)
        self.assertGreater(frames[3]["rot_cm2"], frames[0]["rot_cm2"])
        self.assertLess(max(abs(frame["ledger_error"]) for frame in frames), 1e-9)
        self.assertLess(max(abs(frame["conservation_error"]) for frame in frames), 1e-6)
        self.succeed("rot", take / "recipe.toml", "--no-pictures", "-o", "again.take")
        self.assertEqual(self.frames("again.take"), self.frames(take))
        self.assertEqual(maps(self.folder / "again.take"), maps(take))

    def test_pictures_and_exports(self):
        self.rot("-o", "x.take")
        self.succeed("show", "x.take", "--size", 64, "--samples", 2, "-o", "pictures")
        self.assertTrue((self.folder / "pictures/contact-sheet.png").exists())
        self.succeed("export", "x.take", "--to", "maps", "--frame", 3, "-o", "maps")
        names = {path.name for path in (self.folder / "maps").rglob("*.png")}
        self.assertTrue(any("base_color" in str(path) for path in (self.folder / "maps").rglob("*.png")), names)
        self.succeed("export", "x.take", "--to", "obj", "--frame", 3, "-o", "meshes")
        self.assertTrue(list((self.folder / "meshes").glob("*.obj")))

    def test_threads_do_not_change_the_bits(self):
        self.rot("--threads", 1, "-o", "one.take")
        self.rot("--threads", 2, "-o", "two.take")
        self.assertEqual(self.frames("one.take"), self.frames("two.take"))
        self.assertEqual(maps(self.folder / "one.take"), maps(self.folder / "two.take"))

    def test_interrupted_run_goes_on_to_the_same_bits(self):
        long = ["rot", *TINY, "--set", "output.frames=60", "--set", "output.hours_per_frame=2", "--no-pictures"]
        self.succeed(*long, "-o", "whole.take")
        code, seconds, errors = self.interrupt([*long, "-o", "x.take"],
                                               lambda event: event["event"] == "frame" and event["index"] == 3)
        self.assertEqual(code, 130, errors)
        self.assertLess(seconds, 2)
        command = re.search(r"`windfall (.*)`", errors)
        self.assertIsNotNone(command, errors)
        self.succeed(*command.group(1).split(), "--no-pictures")
        self.assertEqual(self.frames("x.take"), self.frames("whole.take"))
        self.assertEqual(maps(self.folder / "x.take"), maps(self.folder / "whole.take"))

    def test_wound_and_mask_say_where_rot_begins(self):
        only = ["--set", "start.random=0", "--set", "start.contacts=false", "--set", "output.frames=2"]
        self.rot(*only, "--wound", "0,0.064,0", "-o", "x.take")
        self.write(png(64, lambda x, y: 5 < x < 12 and 5 < y < 12), "mask.png")
        self.rot(*only, "--set", "start.mask=mask.png", "-o", "y.take")
        for take in ("x.take", "y.take"):
            frames = json.loads(self.succeed("measure", take, "--json"))["frames"]
            self.assertGreater(frames[0]["rot_cm2"], 0)

    def test_mesh_keeps_its_vertices(self):
        self.write(potato(), "potato.obj")
        recipe = self.write("preset = 'orange'\n[fruit]\nkind = 'mesh'\nmesh = 'potato.obj'\nfirmness = 90\n")
        settings = [part for setting in TINY_SETTINGS for part in ("--set", setting)]
        self.succeed("rot", recipe, *settings, "--set", "body.skin_cells=16", "--no-pictures", "-o", "x.take")
        self.succeed("export", "x.take", "--to", "obj", "--frame", 0, "-o", "meshes")
        text = next((self.folder / "meshes").glob("*.obj")).read_text()
        skin = text[text.index("o skin"):].split("\no ")[0].splitlines()
        given = [line for line in potato().splitlines() if line.startswith("v ")]
        moved = [tuple(map(float, line.split()[1:4])) for line in skin if line.startswith("v ")]
        self.assertEqual(len(moved), len(given))
        # The same shape, smaller and standing on the table: ratios of distances stay.
        def distance(points, a, b):
            return math.dist(points[a], points[b])
        fresh = [tuple(map(float, line.split()[1:4])) for line in given]
        scale = distance(moved, 0, 40) / distance(fresh, 0, 40)
        for a, b in ((3, 200), (100, 300), (17, 450)):
            self.assertAlmostEqual(distance(moved, a, b) / distance(fresh, a, b) / scale, 1, delta=0.03)
        self.succeed("rot", recipe, *settings, "--set", "fruit.uvs=atlas", "--set", "output.frames=2",
                     "--no-pictures", "-o", "y.take")

    def test_pile_has_a_mesh_a_fruit_and_a_bowl(self):
        settings = [part for setting in [*TINY_SETTINGS, "pile.count=3", "output.frames=2"] for part in ("--set", setting)]
        self.succeed("rot", "pile-of-oranges", *settings, "--no-pictures", "-o", "x.take")
        meshes = {path.stem for path in (self.folder / "x.take/meshes").iterdir()}
        self.assertTrue({"skin_0", "skin_1", "skin_2", "bowl"} <= meshes, meshes)


if __name__ == "__main__":
    unittest.main()
