"""Checks the summary of a report on one sheet: python3 test_summary_sheet.py CASES PROGRAM SOURCES"""

import json
import os
import pathlib
import re
import sys
import tempfile
import unittest
import warnings

from report_case import CASES, SOURCES, gearpod

import headline
import summary_sheet
from matplotlib.text import Text
from report import Report

DPI = 72


def reports():
    for file in sorted(CASES.glob("*.json")):
        data = json.loads(file.read_text())
        if "kind" not in data:
            yield file.stem, Report(data)


def text_areas(figure):
    """All visible texts with their boxes in points."""
    figure.set_dpi(DPI)
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    found = []
    for text in figure.findobj(Text):
        if text.get_text().strip() and text.get_visible():
            found.append((text.get_text(), text.get_window_extent(renderer)))
    return found


class Sheets(unittest.TestCase):
    def test_everything_is_on_the_sheet_without_overlap(self):
        seen = 0
        for name, report in reports():
            with self.subTest(name), warnings.catch_warnings():
                warnings.filterwarnings("ignore", message="Glyph")
                figure = summary_sheet.sheet_of(report).figure
                placed = text_areas(figure)
                width, height = DPI * summary_sheet.WIDTH, DPI * summary_sheet.HEIGHT
                for text, area in placed:
                    self.assertTrue(area.x0 > 20 and area.x1 < width - 20 and area.y0 > 20
                                    and area.y1 < height - 20, (text, area))
                for k, (text, area) in enumerate(placed):
                    for other, other_area in placed[k + 1:]:
                        over = (min(area.x1, other_area.x1) - max(area.x0, other_area.x0),
                                min(area.y1, other_area.y1) - max(area.y0, other_area.y0))
                        self.assertFalse(min(over) > 1.5, (text, other, over))
                words = " ".join(text for text, _ in placed)
                for text in [report.text("headline"), *headline.conditions(report), *headline.limits(report)]:
                    for word in text.split(" "):
                        self.assertIn(word[:12], words)
                seen += 1
        self.assertGreater(seen, 15)

    def test_the_pdf_has_one_page_and_is_reproducible(self):
        shown = {name: report for name, report in reports() if name in ("usual", "no_features")}
        self.assertEqual(len(shown), 2)
        for name, report in shown.items():
            first = summary_sheet.pdf(report)
            self.assertTrue(first.startswith(b"%PDF-"), name)
            self.assertEqual(len(re.findall(rb"/Type /Page\b", first)), 1, name)
            self.assertEqual(first, summary_sheet.pdf(report), name)


class Program(unittest.TestCase):
    def test_report_writes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            results, sheet = os.path.join(folder, "r.h5"), os.path.join(folder, "r.pdf")
            gearpod("run", SOURCES / "studies" / "published" / "park-fig-13.toml", "--quiet", "--out", results)
            made = gearpod("report", results, "--pdf", sheet)
            self.assertEqual(made.returncode, 0, made.stderr)
            self.assertIn(f"sheet: {sheet}", made.stdout)
            self.assertTrue(pathlib.Path(sheet).read_bytes().startswith(b"%PDF-"))
            over = gearpod("report", results, "--pdf", results)
            self.assertEqual(over.returncode, 2)
            self.assertIn("is also the results file", over.stderr)
            self.assertEqual(gearpod("report", results).returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
