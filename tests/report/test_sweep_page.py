"""Checks the page of a sweep as HTML: python3 test_sweep_page.py CASES PROGRAM SOURCES"""

import json
import os
import pathlib
import re
import sys
import tempfile
import unittest

from report_case import SOURCES, gearpod

import build_page
import made_sweeps
from page_html import PageHtml

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

    def test_the_page_shows_the_findings_in_their_order(self):
        for name, data in MADE.items():
            text = parsed(name).text().replace("\u00a0", " ")
            places = [text.index(part) for part in (
                "Smallest fault found <b> at noise × 1.", "No point differs.", "All points", "Varied: ")]
            self.assertEqual(places, sorted(places), name)
            html = build_page.page_html(data)
            table = html[html.index("<tbody>"):html.index("</tbody>")]
            rows = [re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row) for row in table.split("<tr>")[1:]]
            self.assertEqual(len(rows), len(data["points"]), name)
        text = parsed("sweep_unknown").text()
        self.assertEqual(text.count("Too few healthy gearboxes"), 1)
        self.assertLess(text.index("Smallest fault"), text.index("Too few healthy"))

    def test_open_bounds_are_arrows(self):
        # The last shown feature of these sweeps has no upper bound; the others have both.
        def arrows(data):
            return build_page.page_html(data).count("stroke-width: 1.6")
        closed = made_sweeps.sweep(made_sweeps.VARIED["sweep_one"])
        for at in closed["points"]:
            for feature in at["features"]:
                if feature["a90"] is not None:
                    feature["a90_bound"] = 1.07 * feature["a90"]
        open_ended = sum(f["a90"] is not None and f["a90_bound"] is None and f["noise_level"] == 1
                         for at in MADE["sweep_one"]["points"] for f in at["features"])
        self.assertGreater(open_ended, 0)
        self.assertGreaterEqual(arrows(MADE["sweep_one"]) - arrows(closed), open_ended)

    def test_text_is_never_markup(self):
        self.assertNotIn("<b>", build_page.page_html(MADE["sweep_one"]))
        self.assertNotIn("<b>", build_page.page_html(MADE["lives_sweep_one"]))
        self.assertIn("uniform, low=300, high=500", build_page.page_html(MADE["sweep_words"]))


class Program(unittest.TestCase):
    def test_page_and_json_agree(self):
        with tempfile.TemporaryDirectory() as folder:
            html = os.path.join(folder, "s.html")
            command = ["sweep", SOURCES / "studies" / "published" / "park-fig-13.toml", "--quiet",
                       "--vary", "operation.torque_N_m=[90e3,180e3]", "--out",
                       os.path.join(folder, "s"), "--html"]
            made = gearpod(*command, html, "--json", "-")
            self.assertEqual(made.returncode, 0, made.stderr)
            self.assertEqual(pathlib.Path(html).read_text(),
                             build_page.page_html(json.loads(made.stdout)))
            self.assertIn("Sweep: TE features against fault size", pathlib.Path(html).read_text())
            refused = gearpod(*command, "/nonexistent/s.html")
            self.assertEqual(refused.returncode, 2)
            self.assertIn("/nonexistent/s.html", refused.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
