"""Checks the page of a sweep as HTML: python3 test_sweep_page.py CASES PROGRAM SOURCES"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCES = (pathlib.Path(argument) for argument in sys.argv[2:4])
sys.path.insert(0, str(SOURCES / "analysis" / "report"))
sys.path.insert(0, str(pathlib.Path(__file__).parent))

try:
    import build_page
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-matplotlib)")
    sys.exit(77)
import made_sweeps  # noqa: E402
from page_html import PageHtml  # noqa: E402

MADE = made_sweeps.all_of()


def parsed(name):
    return PageHtml(build_page.page_html(MADE[name]))


class MadeUp(unittest.TestCase):
    def test_pages_are_whole(self):
        for name in MADE:
            with self.subTest(name):
                page = parsed(name)
                self.assertEqual(page.problems, [])
                self.assertEqual(len(page.ids), len(set(page.ids)), "an id stands twice")
                for link in page.links:
                    self.assertTrue(link == "data:," or link[1:] in page.ids, link)
                self.assertNotIn("script", {tag for tag, _ in page.elements})
                self.assertNotRegex(page.text(), r"\b(nan|None|inf)\b")

    def test_one_chart_per_value_of_the_second_key(self):
        charts = {"sweep_one": 3, "sweep_two": 9, "sweep_words": 3, "sweep_three": 12,
                  "sweep_single": 3, "sweep_nothing": 1, "sweep_unknown": 1, "sweep_silent": 0,
                  "lives_sweep_one": 4, "lives_sweep_two": 12, "lives_sweep_blind": 0}
        for name, expected in charts.items():
            self.assertEqual(parsed(name).count("svg"), expected, name)
        self.assertIn("integrator = newmark", parsed("sweep_two").text())

    def test_too_few_healthy_samples_come_first_and_hide_no_fault(self):
        text = parsed("sweep_unknown").text()
        self.assertEqual(text.count("Too few healthy gearboxes"), 1)
        self.assertIn("no threshold in 5 of 5 studies", text)
        self.assertNotIn("none in", text)
        self.assertLess(text.index("Too few healthy"), text.index("no threshold in"))

    def test_every_result_is_in_the_table(self):
        html = build_page.page_html(MADE["sweep_two"])
        table = html[html.index("<tbody>"):html.index("</tbody>")]
        rows = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in table.split("<tr>")[1:]]
        self.assertEqual(len(rows), 9)
        for row, point in zip(rows, MADE["sweep_two"]["points"]):
            self.assertEqual(row[:2], [v.strip('"') for v in point["values"].values()])
            for cell, at in zip(row[2:5], point["smallest_fault"]):
                if at["size"] is None:
                    self.assertEqual(cell, "none")
                else:
                    self.assertEqual(cell.endswith("*"), not at["from_curve"])
                    self.assertAlmostEqual(float(cell.split("\u00a0")[0]), at["size"], delta=0.006)

    def test_the_sentence_names_best_and_worst(self):
        found = [(at["size"], p["values"]["sensor.noise_m_s2"])
                 for p in MADE["sweep_one"]["points"] for at in p["smallest_fault"]
                 if at["noise_level"] == 1 and at["size"] is not None]
        shown_text = parsed("sweep_one").text().replace("\u00a0", " ")
        self.assertIn(f"{min(found)[0]:.3g} mm by", shown_text)
        self.assertIn(f"at noise_m_s2 = {min(found)[1]}; largest {max(found)[0]:.3g} mm", shown_text)
        self.assertIn("none in any of 5 studies", parsed("sweep_nothing").text())
        self.assertIn("computes no feature", parsed("sweep_silent").text())

    def test_lives_are_named_with_their_monitor(self):
        shown_text = parsed("lives_sweep_one").text().replace("\u00a0", " ")
        self.assertIn("change_window_ratio by single finds 100 % of the cracks before the tooth breaks "
                      "at interval_h = 1, 80 % at interval_h = 100", shown_text)
        self.assertIn("at least 480 h before at interval_h = 100, 600 h at interval_h = 1", shown_text)
        html = build_page.page_html(MADE["lives_sweep_two"])
        table = html[html.index("<tbody>"):html.index("</tbody>")]
        rows = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in table.split("<tr>")[1:]]
        self.assertEqual(len(rows), 9)
        for row, point in zip(rows, MADE["lives_sweep_two"]["points"]):
            self.assertEqual(row[:2], list(point["values"].values()))
            self.assertTrue(row[3].startswith(f"{point['monitored'][0]['found']}/30"), row[3])
        self.assertIn("does a detector find more cracks than chance", parsed("lives_sweep_blind").text())

    def test_text_is_never_markup(self):
        self.assertNotIn("<b>", build_page.page_html(MADE["sweep_one"]))
        self.assertNotIn("<b>", build_page.page_html(MADE["lives_sweep_one"]))
        self.assertIn("uniform, 300, 500", parsed("sweep_words").text())


class Program(unittest.TestCase):
    def test_page_and_json_agree(self):
        with tempfile.TemporaryDirectory() as folder:
            html = os.path.join(folder, "s.html")
            command = [PROGRAM, "sweep", SOURCES / "studies" / "published" / "park-fig-13.toml", "--quiet",
                       "--vary", "operation.torque_N_m=[90e3,180e3]", "--out",
                       os.path.join(folder, "s"), "--html"]
            made = subprocess.run([*command, html, "--json", "-"], capture_output=True, text=True,
                                  check=True)
            self.assertEqual(pathlib.Path(html).read_text(),
                             build_page.page_html(json.loads(made.stdout)))
            self.assertIn("Sweep: TE features against fault size", pathlib.Path(html).read_text())
            refused = subprocess.run([*command, "/nonexistent/s.html"], capture_output=True,
                                     text=True, check=False)
            self.assertEqual(refused.returncode, 2)
            self.assertIn("/nonexistent/s.html", refused.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
