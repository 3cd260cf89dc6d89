"""Checks tables and evidence of every report case: python3 test_evidence.py CASES PROGRAM SOURCES"""

import csv
import functools
import io
import json
import pathlib
import sys
import unittest

CASES, _, SOURCES = (pathlib.Path(argument) for argument in sys.argv[1:4])
sys.path.insert(0, str(SOURCES / "analysis" / "report"))

import tables  # noqa: E402
from evidence import evidence  # noqa: E402

ORDER = ["scope", "definition", "threshold", "false_alarms", "detection", "limits", "data",
         "software", "further"]
SUBJECTS = {"evidence.indicators": "definition", "thresholds.0": "threshold", "facts": "threshold",
            "headline": "detection", "curves.0": "detection", "rates.0": "detection",
            "smallest_fault": "detection", "evidence.scope": "scope", "ranking.0": "further"}


@functools.lru_cache
def cases():
    """Name, JSON and evidence sections of each case."""
    found = []
    for path in sorted(CASES.glob("*.json")):
        data = json.loads(path.read_text(), parse_float=tables.Number)
        data.setdefault("evidence", {"file": "results.h5", "report_by": "gearpod"})
        found.append((path.stem, data, evidence.sections(data)))
    return found


def blocks(sections):
    return [(section["key"], block) for section in sections for block in section["blocks"]]


def text_of(sections, key):
    return "".join(block["text"] for _, block in blocks(sections) if block["key"] == key)


class Evidence(unittest.TestCase):
    def test_each_finding_is_there_once_under_the_subjects_in_order(self):
        for name, data, sections in cases():
            with self.subTest(name):
                found = [block for _, block in blocks(sections)]
                texts = [block.get("text") for block in found]
                for _, block in blocks(data["findings"]):
                    self.assertEqual(texts.count(block["text"]) if "text" in block
                                     else found.count(block), 1, block["key"])
                keys = [section["key"] for section in sections]
                self.assertEqual(keys, [key for key in ORDER if key in keys])
                self.assertTrue(all(section["title"] for section in sections))

    def test_findings_stand_under_the_subject_that_they_are_evidence_for(self):
        sections = {name: sections for name, _, sections in cases()}["usual"]
        found = {block["key"]: subject for subject, block in blocks(sections)}
        self.assertEqual({key: found[key] for key in SUBJECTS}, SUBJECTS)

    def test_evidence_that_the_results_do_not_provide_is_named_and_only_that(self):
        sections = {name: sections for name, _, sections in cases()}
        curve = "a POD curve with a90 and its bound"
        usual = text_of(sections["usual"], "evidence.absent.detection")
        self.assertNotIn(curve, usual)
        self.assertIn("sustained alarms", usual)
        self.assertEqual(text_of(sections["usual"], "evidence.absent.threshold"), "")
        self.assertIn(curve, text_of(sections["no_fault"], "evidence.absent.detection"))
        # Recordings without any finding: everything is absent.
        nothing = evidence.sections({"provenance": {"kind": "recordings"}, "features": [],
                                     "findings": [],
                                     "evidence": {"file": "none", "report_by": "gearpod"}})
        for subject in ("threshold", "false_alarms", "detection", "data"):
            self.assertTrue(text_of(nothing, f"evidence.absent.{subject}")
                            .startswith("Not provided by this study: "), subject)
        self.assertIn("hashes", text_of(nothing, "evidence.absent.data"))

    def test_healthy_alarms_are_counted_by_part_of_the_sample(self):
        # Clopper-Pearson bounds of 0 of 40: 0 and 1 - 0.025^(1/40) = 0.0881.
        healthy = {"size_high": 0.0, "tested": 40, "detected": 0,
                   "exact": [0.0, 1.0 - 0.025 ** (1 / 40)]}
        faulty = {"size_high": 1e-3, "tested": 40, "detected": 40, "exact": [0.9, 1.0]}
        levels = [{"noise_level": 1.0, "threshold_sample": 262, "threshold_alarms": 1, "sizes": sizes}
                  for sizes in ([healthy, faulty], [faulty])]
        rows = evidence.healthy_alarms({"confidence": 0.95,
                                        "features": [{"name": "fm4", "levels": levels}]},
                                       "gearboxes")["rows"]
        self.assertEqual(rows, [["fm4", "x 1", "1 of 262", "1 in 263", "0 of 40", "[0.00, 0.09]"],
                                ["fm4", "x 1", "1 of 262", "1 in 263", "-", "-"]])


class Tables(unittest.TestCase):
    def test_every_table_is_rectangular_and_none_is_empty(self):
        for name, data, _ in cases():
            files = tables.files(data)
            self.assertGreaterEqual(len(files), 2, name)
            for table, text in files.items():
                with self.subTest(f"{name} {table}"):
                    rows = list(csv.reader(io.StringIO(text)))
                    self.assertGreater(len(rows), 1)
                    self.assertEqual({len(row) for row in rows}, {len(rows[0])})
                    self.assertNotIn("nan", text)

    def test_they_hold_the_numbers_of_the_report_with_sizes_in_the_unit_of_their_names(self):
        data = {name: data for name, data, _ in cases()}["usual"]
        files = {name: list(csv.DictReader(io.StringIO(text)))
                 for name, text in tables.files(data).items()}
        self.assertGreater(len(files), 8)
        feature = data["detection"]["features"][0]
        cell, row = feature["levels"][0]["sizes"][2], files["detection.csv"][2]
        self.assertEqual(row["feature"], feature["name"])
        self.assertIn("size_low_m", row)
        self.assertEqual(row["size_high_m"], str(cell["size_high"]))
        self.assertEqual(float(row["pd"]), cell["pd"])
        for row, level in zip(files["smallest_fault.csv"], data["reliability"]["levels"]):
            self.assertEqual(row["feature"], (level["smallest_fault"] or {}).get("feature", ""))

    def test_text_that_a_spreadsheet_would_compute_is_marked(self):
        self.assertEqual(tables.csv_text([["=1+1", "-0.5", "-x", None, True, 'a,"b"']]),
                         "'=1+1,-0.5,'-x,,true,\"a,\"\"b\"\"\"\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
