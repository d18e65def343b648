"""Shared parts of the module's tests: scenes, and calls of the command line."""

import os
import pathlib
import subprocess
import tempfile
import unittest

SCENE = {
    "kind": "lines",
    "sampleRateHz": 1000,
    "durationSeconds": 30,
    "seed": 3,
    "lines": [
        {
            "snrDb": 9,
            "referenceSeconds": 0.5,
            "startSeconds": 8,
            "durationSeconds": 15,
            "frequencyHz": 210,
            "driftHzPerSecond": 0.2,
        }
    ],
}


class InFolder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def command_line(self, *arguments):
        """Runs faintline-cli; returns its standard output."""
        program = os.environ["FAINTLINE_CLI"]
        done = subprocess.run([program, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def refusal(self, call, *arguments, **keywords):
        """The faintline.Error a call raises."""
        import faintline as fl

        with self.assertRaises(fl.Error) as caught:
            call(*arguments, **keywords)
        self.assertEqual(caught.exception.what, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        return caught.exception
