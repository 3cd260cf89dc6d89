"""Checks the league of indicators: test_league.py PROGRAM SOURCES

Its statistics equal those of the program's report, and the script writes page and picture from a tiny
league. Exits with 77 without h5py, scipy or matplotlib.
"""

import importlib.util
import os
import pathlib
import re
import sys
import tempfile
import unittest

PROGRAM, SOURCES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
for module in ("h5py", "scipy", "matplotlib"):
    if not importlib.util.find_spec(module):
        print(f"skipped: no {module} (Debian: python3-{module})")
        sys.exit(77)
os.environ["GEARPOD_PROGRAM"] = str(PROGRAM)
sys.path[:0] = [str(SOURCES / "docs" / "tools"), str(SOURCES / "analysis" / "python")]
import gearpod  # noqa: E402
import indicator_league as league  # noqa: E402
import league_statistics as statistics  # noqa: E402
import numpy as np  # noqa: E402


class League(unittest.TestCase):
    def test_statistics_equal_the_report(self):
        with tempfile.TemporaryDirectory() as folder:
            results = gearpod.run(SOURCES / "studies" / "planet-crack-ideal.toml", instances=60, progress=False,
                                  set={"ensemble.threshold_instances": 60, "sensor.noise_levels": [1]},
                                  out=pathlib.Path(folder, "r.h5"))
            report = results.report()
            healthy, graded = (league.oriented(results, group)[:, :, 0] for group in ("threshold", "graded"))
            has_fault = results.size[results.rows("graded")] > 0
            areas = statistics.delong(np.concatenate([healthy, graded[~has_fault]]), graded[has_fault])
            low, high = areas.intervals()
            place = {name: i for i, name in enumerate(results.features)}
            for feature in report["reliability"]["features"]:
                i = place[feature["name"]]
                own = feature["levels"][0]["auc"]
                self.assertAlmostEqual(areas.area[i], own["auc"], 9)
                if 0 < own["auc"] < 1:
                    self.assertAlmostEqual(low[i], own["lower"], 6)
                    self.assertAlmostEqual(high[i], own["upper"], 6)
            for feature in report["detection"]["features"]:
                i = place[feature["name"]]
                rank = statistics.threshold_rank(60, 0.05)
                side = 1 if results.alarms[feature["name"]] == "high" else -1
                self.assertEqual(side * np.sort(healthy[:, i])[rank - 1], feature["levels"][0]["threshold"])
            # Pairs of the ranking, with Holm's correction, at the 5 % level.
            ranks = report["reliability"]["levels"][0]["ranking"]["ranks"]
            alike = areas.indistinguishable_from_best()
            first = ranks[0]
            self.assertEqual(areas.area[place[first["name"]]], areas.area.max())
            for rank in ranks[1:]:
                self.assertEqual(alike[place[rank["name"]]], rank["p_values"][0] >= 0.05, rank["name"])

    def test_holm_and_the_rates_of_a_threshold(self):
        np.testing.assert_allclose(statistics.holm(np.array([0.01, 0.04, 0.03])), [0.03, 0.06, 0.06])
        self.assertEqual(statistics.threshold_rank(999, 0.001), 999)
        self.assertIsNone(statistics.threshold_rank(998, 0.001))
        # The largest of n values: 1 - share^n (closed form).
        low, high = statistics.rate_interval(999, 999)
        self.assertAlmostEqual(low, 1 - 0.975 ** (1 / 999), 12)
        self.assertAlmostEqual(high, 1 - 0.025 ** (1 / 999), 12)

    def test_a_tiny_league_has_page_and_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            study = re.sub(r"use = \[.*?\]", 'use = ["fm4", "window_ratio", "te_fm0", "own_fm4", "change_window_ratio"]',
                           league.STUDY.read_text(encoding="utf-8"), flags=re.S)
            (folder / "league.toml").write_text(study, encoding="utf-8")
            league.STUDY, league.FAULTS = folder / "league.toml", league.FAULTS[:2]
            page, picture = folder / "page.md", folder / "picture.svg"
            page.write_text(f"before\n{league.BEGIN}\nobsolete\n{league.END}\nafter\n", encoding="utf-8")
            words = [str(PROGRAM), str(folder / "out"), "--healthy", "20", "--faulty", "6", "--page", str(page), "--picture",
                     str(picture)]
            league.main(words)
            text = page.read_text(encoding="utf-8")
            self.assertTrue(text.startswith("before\n") and text.endswith("after\n"))
            self.assertNotIn("obsolete", text)
            for expected in ("crack of a sun tooth", "`change_window_ratio`", "| 0.05 | value 20 of 20 |",
                             "| 0.001 | none | at least 999 healthy", "20 healthy gearboxes, 6 with each fault", "A second seed"):
                self.assertIn(expected, text)
            drawn = picture.read_text(encoding="utf-8")
            # The same results give the same page and picture.
            league.main(words)
            again = page.read_text(encoding="utf-8")
            self.assertEqual(*(re.sub(r"took \d+", "", one) for one in (text, again)))
            self.assertEqual(drawn, picture.read_text(encoding="utf-8"))
            with self.assertRaises(SystemExit):
                league.main([*words, "--healthy", "18"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
