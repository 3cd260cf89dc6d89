"""Compares published figures with this program's numbers: python3 test_published.py PROGRAM SOURCES

PROGRAM is gearpod, SOURCES its sources. Exits with 77 without h5py or matplotlib.
"""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
sys.path.insert(0, str(SOURCES / "analysis" / "python"))
os.environ["GEARPOD_PROGRAM"] = str(PROGRAM)

try:
    import h5py  # noqa: F401
    import matplotlib
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-h5py python3-matplotlib)")
    sys.exit(77)
matplotlib.use("agg")
from gearpod import published  # noqa: E402

# Largest accepted relative difference from a published number, where there is a difference;
# docs/validation/published.md explains each.
OFF = {"liang-fig-5-8": 0.18, "tian-fig-4-4": 0.17, "tian-fig-4-5": 0.25, "park-fig-11": 0.06}


class Published(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        done = subprocess.run(
            [sys.executable, "-m", "gearpod.published", "--out", cls.folder.name],
            capture_output=True, text=True, check=False,
            env={**os.environ, "PYTHONPATH": str(SOURCES / "analysis" / "python")})
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
        cls.output = done.stdout
        with open(pathlib.Path(cls.folder.name, "published.csv"), encoding="utf-8") as file:
            cls.rows = list(csv.DictReader(file))

    def test_one_command_plots_all(self):
        for figure in published.figures():
            with self.subTest(figure["name"]):
                self.assertTrue((SOURCES / "studies" / "published" / figure["study"]).is_file())
                for kind in ("svg", "png"):
                    file = pathlib.Path(self.folder.name, f"{figure['name']}.{kind}")
                    self.assertGreater(file.stat().st_size, 5000)
                self.assertIn(figure["name"], self.output)

    def test_numbers_match_within_stated_differences(self):
        compared = 0
        for row in self.rows:
            if row["published"]:
                off = abs(float(row["ours"]) - float(row["published"]))
                allowed = OFF.get(row["figure"], 0.005) * abs(float(row["published"]))
                self.assertLessEqual(off, allowed + 1e-12, row)
                compared += 1
        self.assertGreaterEqual(compared, 13)

    def test_trends_match_the_published_ones(self):
        checked = 0
        for figure in published.figures():
            for panel in figure.get("panels", []):
                if "rises" not in panel or "lines" in figure:
                    continue
                values = [float(row["ours"]) for row in self.rows
                          if row["figure"] == figure["name"]
                          and row["what"].startswith(panel["feature"] + " ")]
                self.assertEqual(len(values), 4)
                self.assertEqual(values, sorted(values, reverse=not panel["rises"]), panel)
                checked += 1
        self.assertEqual(checked, 4)
        for name in ("liang-fig-3-12", "liang-fig-3-14", "liang-fig-3-16", "yang-fig-15"):
            losses = [float(row["ours"]) for row in self.rows
                      if row["figure"] == name and row["what"].startswith("largest loss")]
            self.assertGreaterEqual(len(losses), 4)
            self.assertEqual(losses, sorted(losses), name)

    def test_unknown_figures_are_reported(self):
        self.assertEqual(published.main(["none-such"]), 2)
        self.assertEqual(published.main(["--list"]), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
