"""A scratch folder per test, and ways to run the program in it. The program stands in WINDFALL_BINARY."""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

BINARY = os.path.abspath(os.environ.get("WINDFALL_BINARY", "windfall"))


def digests(take):
    """Digest of every file that a run computes: two takes are the same to the last bit when these are equal."""
    return {str(path.relative_to(take)): hashlib.sha256(path.read_bytes()).hexdigest()
            for part in ("meshes", "frames") for path in sorted((take / part).iterdir())}


class CommandLine(unittest.TestCase):
    """A scratch folder per test, and ways to run the program in it."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="windfall-cli-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def run_windfall(self, *arguments, timeout=300, **options):
        return subprocess.run([BINARY, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=timeout, stdin=subprocess.DEVNULL, **options)

    def succeed(self, *arguments, **options):
        result = self.run_windfall(*arguments, **options)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stderr}")
        return result.stdout

    def fail_with(self, code, *arguments, **options):
        """Runs what must fail; returns stderr. Whatever was in the folder before must be all that is there after."""
        before = self.listing()
        result = self.run_windfall(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stdout}{result.stderr}")
        self.assertIn("windfall: error: ", result.stderr)
        if code == 2:
            self.assertEqual(self.listing(), before, "wrong input left something behind")
        return result.stderr

    def listing(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def frames(self, take):
        return digests(self.folder / take)

    def write(self, text, name="fruit.toml"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return name

    def interrupt(self, arguments, wanted, which=signal.SIGINT):
        """Starts a run, sends the signal once `wanted(event)`; returns exit code, seconds from the signal, stderr."""
        process = subprocess.Popen([BINARY, *arguments, "--progress", "json"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            for line in process.stdout:
                if wanted(json.loads(line)):
                    break
            else:
                self.fail("the run ended before it could be interrupted: " + process.stderr.read())
            process.send_signal(which)
            start = time.monotonic()
            _, errors = process.communicate(timeout=60)
            return process.returncode, time.monotonic() - start, errors
        finally:
            process.kill()
            process.wait()
