"""Checks the evidence pack: python3 test_evidence_document.py CASES PROGRAM SOURCES"""

import csv
import hashlib
import json
import pathlib
import re
import sys
import tempfile
import unittest
import warnings

from report_case import SOURCES, case, gearpod

import summary_sheet
from evidence import evidence, evidence_document
from words import typeset

DPI = 72
SUBJECTS = ["scope", "definition", "threshold", "false_alarms", "detection", "limits", "data",
            "software"]


def case_with_evidence(name):
    return evidence.with_evidence(case(name))


def areas_of(page):
    """Texts and charts of a page with their areas in points."""
    page.set_dpi(DPI)
    page.canvas.draw()
    renderer = page.canvas.get_renderer()
    return ([(text.get_text(), text.get_window_extent(renderer)) for text in page.texts
             if text.get_text().strip()]
            + [("chart", axes.get_tightbbox(renderer)) for axes in page.axes])


def tables(sections):
    return {block["key"]: block for section in sections for block in section["blocks"]
            if "rows" in block}


class Document(unittest.TestCase):
    def test_everything_is_on_the_pages_without_overlap(self):
        for name in ("usual", "no_fault", "no_features"):
            data = case_with_evidence(name)
            with self.subTest(name), warnings.catch_warnings():
                warnings.filterwarnings("ignore", message="Glyph")
                _, document = evidence_document.document_of(data)
                words = ""
                for page in document.pages:
                    placed = areas_of(page)
                    words += " " + " ".join(text for text, _ in placed)
                    for text, area in placed:
                        self.assertTrue(area.x0 > 20 and area.x1 < DPI * summary_sheet.WIDTH - 20
                                        and area.y0 > 20 and area.y1 < DPI * summary_sheet.HEIGHT - 20,
                                        (text, area))
                    for k, (text, area) in enumerate(placed):
                        for other, second in placed[k + 1:]:
                            over = (min(area.x1, second.x1) - max(area.x0, second.x0),
                                    min(area.y1, second.y1) - max(area.y0, second.y0))
                            self.assertFalse(min(over) > 1.5, (text, other, over))
                for section in data["evidence"]["sections"]:
                    self.assertIn(section["title"], words)
                    for block in section["blocks"]:
                        cells = [block["text"]] if "text" in block else [
                            cell for row in block["rows"] for cell in row]
                        for cell in cells:
                            for word in typeset(cell).split(" "):
                                self.assertIn(word[:8], words)

    def test_the_pdf_has_all_pages_and_is_reproducible(self):
        data = case_with_evidence("usual")
        _, document = evidence_document.document_of(data)
        first = evidence_document.pdf(data)
        self.assertTrue(first.startswith(b"%PDF-"))
        self.assertEqual(len(re.findall(rb"/Type /Page\b", first)), len(document.pages))
        self.assertGreater(len(document.pages), 2)
        self.assertEqual(first, evidence_document.pdf(data))


class Pack(unittest.TestCase):
    """Packs as the program writes them."""

    def check_pack(self, folder, names):
        """Checks files and hashes of a pack; returns its report."""
        found = {path.name for path in folder.iterdir()}
        self.assertTrue({"evidence.pdf", "report.json", "SHA256SUMS", *names} <= found, found)
        lines = (folder / "SHA256SUMS").read_text().splitlines()[1:]
        self.assertEqual({line[66:] for line in lines}, found - {"SHA256SUMS"})
        for line in lines:
            self.assertEqual(hashlib.sha256((folder / line[66:]).read_bytes()).hexdigest(), line[:64])
        self.assertTrue((folder / "evidence.pdf").read_bytes().startswith(b"%PDF-"))
        report = json.loads((folder / "report.json").read_text())
        keys = [section["key"] for section in report["evidence"]["sections"]]
        self.assertEqual([key for key in keys if key != "further"],
                         [key for key in SUBJECTS if key in keys])
        return report

    def test_a_run(self):
        with tempfile.TemporaryDirectory() as place:
            place = pathlib.Path(place)
            results, folder = place / "r.h5", place / "new" / "pack"
            gearpod("run", SOURCES / "studies" / "published" / "park-fig-13.toml", "--quiet", "--out",
                    results)
            made = gearpod("report", results, "--evidence", folder)
            self.assertEqual(made.returncode, 0, made.stderr)
            self.assertIn(f"evidence: {folder}", made.stdout)
            report = self.check_pack(folder, {"study.toml", "features.csv", "provenance.csv"})
            kept = tables(report["evidence"]["sections"])
            self.assertEqual(kept["evidence.file"]["rows"],
                             [[str(results), hashlib.sha256(results.read_bytes()).hexdigest()]])
            software = dict(kept["evidence.software"]["rows"])
            for name in ("code_version", "git_hash", "compiler", "seed"):
                self.assertEqual(software[name.replace("_", " ")], report["provenance"][name])
            with open(folder / "features.csv", encoding="utf-8") as file:
                defined = {row["feature"]: row["definition"] for row in csv.DictReader(file)}
            self.assertEqual({row[0]: row[4] for row in kept["evidence.indicators"]["rows"]}, defined)
            # The study of the pack is one that the program reads, and gives the same study.
            shown = gearpod("describe", folder / "study.toml")
            self.assertEqual(shown.returncode, 0, shown.stderr)
            self.assertEqual((folder / "study.toml").read_text().split("\n", 1)[1],
                             report["provenance"]["study"])
            # The files of the pack are replaced, but no other kind of file and no input.
            self.assertEqual(gearpod("report", results, "--evidence", folder).returncode, 0)
            for name in ("evidence.pdf", "study.toml", "SHA256SUMS"):
                (folder / name).write_text("years of work\n")
                refused = gearpod("report", results, "--evidence", folder)
                self.assertEqual(refused.returncode, 2)
                self.assertIn(name, refused.stderr)
                self.assertIn("--force", refused.stderr)
                self.assertEqual((folder / name).read_text(), "years of work\n")
                forced = gearpod("report", results, "--evidence", folder, "--force")
                self.assertEqual(forced.returncode, 0, forced.stderr)
            refused = gearpod("report", results, "--evidence", results)
            self.assertEqual(refused.returncode, 2)
            (folder / "report.json").unlink()
            (folder / "report.json").symlink_to(results)
            refused = gearpod("report", results, "--evidence", folder, "--force")
            self.assertEqual(refused.returncode, 2)
            self.assertIn("would overwrite the results file", refused.stderr)

    def test_a_table_of_inspections(self):
        with tempfile.TemporaryDirectory() as place:
            place = pathlib.Path(place)
            table, folder = place / "t.csv", place / "pack"
            hits = [(size / 4, int(size * 7 % 16 < size)) for size in range(1, 41)]
            table.write_text("size,hit\n" + "".join(f"{size},{hit}\n" for size, hit in hits)
                             + "0,0\n" * 30)
            made = gearpod("pod", table, "--evidence", folder)
            self.assertEqual(made.returncode, 0, made.stderr)
            report = self.check_pack(folder, {"inspections.csv"})
            kept = tables(report["evidence"]["sections"])
            self.assertEqual(kept["evidence.file"]["rows"],
                             [[str(table), hashlib.sha256(table.read_bytes()).hexdigest()]])
            with open(folder / "inspections.csv", encoding="utf-8") as file:
                rows = [(float(row["size"]), float(row["value"])) for row in csv.DictReader(file)]
            self.assertEqual(sorted(rows), sorted([(s, float(h)) for s, h in hits] + [(0.0, 0.0)] * 30))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
