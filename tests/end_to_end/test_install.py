"""cmake --install: the installed program runs by itself and reads the presets that were installed with it."""

import os
import pathlib
import subprocess
import tempfile
import unittest


def output_of(*command):
    result = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    return result.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.prefix = pathlib.Path(scratch.name) / "prefix"
        output_of("cmake", "--install", os.environ["WINDFALL_BUILD"], "--prefix", str(cls.prefix))
        cls.program = str(cls.prefix / "bin" / "windfall")

    def test_papers_go_along(self):
        papers = self.prefix / "share" / "doc" / "windfall"
        self.assertIn("Apache License", (papers / "LICENSE").read_text())
        self.assertTrue((papers / "README.md").stat().st_size > 0)

    def test_version_is_that_of_the_build(self):
        version = output_of(self.program, "--version")
        self.assertRegex(version, r"^windfall \d+\.\d+\.\d+(\+[0-9a-f]{7,}(-dirty)?)?\n$")
        self.assertEqual(version, output_of(os.environ["WINDFALL_BINARY"], "--version"))

    def test_installed_presets_are_read(self):
        presets = self.prefix / "share" / "windfall" / "presets"
        (presets / "jujube.toml").rename(presets / "only-in-this-prefix.toml")
        listed = output_of(self.program, "presets")
        self.assertIn("only-in-this-prefix", listed)
        self.assertNotRegex(listed, r"(?m)^\s*jujube\s")


if __name__ == "__main__":
    unittest.main()
