"""Runs the notebook's cells in order: python3 test_notebook.py PROGRAM SOURCES

Uses a copy of the studies' folder and a kernel of a fresh virtual environment with the package
installed without the network. Without python3-venv it uses the system's kernel with the package's
folder in its path. Exits with 77 without nbclient, a kernel, pandas, matplotlib or h5py (Debian:
python3-nbclient, python3-ipykernel, python3-pandas, python3-matplotlib, python3-h5py).
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])

try:
    import h5py  # noqa: F401
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import nbclient
    import nbformat
    import pandas  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

NOTEBOOK = SOURCES / "studies" / "first-steps.ipynb"
PACKAGE = SOURCES / "analysis" / "python"


def fresh_kernel(place):
    """Name of a kernel in a new environment. The package is built from a copy, because pip
    writes into its folder."""
    made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", place / "venv"],
                          capture_output=True, check=False)
    if made.returncode != 0:
        os.environ["PYTHONPATH"] = str(PACKAGE)
        return "python3"
    os.environ.pop("PYTHONPATH", None)
    shutil.copytree(PACKAGE, place / "package")
    python = place / "venv" / "bin" / "python"
    os.environ["GEARPOD_BUILD"] = str(PROGRAM.parent)
    for arguments in (["pip", "install", "--no-index", "--no-build-isolation", "--no-deps", "--quiet",
                       place / "package"],
                      ["ipykernel", "install", "--prefix", place / "venv", "--name", "fresh"]):
        subprocess.run([python, "-m", *arguments], check=True, capture_output=True)
    os.environ["JUPYTER_PATH"] = str(place / "venv" / "share" / "jupyter")
    return "fresh"


class Notebook(unittest.TestCase):
    def test_every_cell_runs_and_shows_its_output(self):
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        nbformat.validate(notebook)
        for cell in notebook.cells:
            self.assertFalse(cell.get("outputs"), "outputs are not kept in the sources")
        os.environ["GEARPOD_PROGRAM"] = str(PROGRAM)
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as place:
            for study in (SOURCES / "studies").glob("*.toml"):
                shutil.copy(study, folder)
            kernel = fresh_kernel(pathlib.Path(place))
            nbclient.NotebookClient(notebook, timeout=600, kernel_name=kernel,
                                    resources={"metadata": {"path": folder}}).execute()
        figures, texts = 0, []
        for cell in notebook.cells:
            for output in cell.get("outputs", []):
                figures += "image/png" in output.get("data", {})
                texts.append(output.get("data", {}).get("text/plain", ""))
        self.assertEqual(figures, 4)
        cell_output = "\n".join(texts)
        self.assertIn("gearpod results", cell_output)
        self.assertIn("'window_ratio')", cell_output)  # smallest fault and its feature


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
