"""Every notebook of the examples runs from its first cell to its last."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys

from support import InFolder

NEEDED = ("nbconvert", "ipykernel", "matplotlib")
EXAMPLES = pathlib.Path(__file__).parents[2] / "examples"


class Notebooks(InFolder):
    def test_they_run(self):
        shutil.copytree(EXAMPLES, self.folder / "examples")
        notebooks = sorted((self.folder / "examples").rglob("*.ipynb"))
        self.assertGreater(len(notebooks), 0)
        out = pathlib.Path(os.environ.get("FAINTLINE_NOTEBOOKS", self.folder / "out"))
        for notebook in notebooks:
            done = subprocess.run(
                [sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output-dir", out, notebook],
                capture_output=True,
                text=True,
                env=os.environ | {"JUPYTER_CONFIG_DIR": str(self.folder), "HOME": str(self.folder)},
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            for picture in notebook.parent.glob("*.png"):
                shutil.copy(picture, out)


if __name__ == "__main__":
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        print("skipped: not installed:", ", ".join(missing), "(Debian: jupyter-nbconvert python3-ipykernel python3-matplotlib)")
        sys.exit(77)
    import unittest

    unittest.main()
