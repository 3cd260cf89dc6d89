"""Checks performance.py without measuring: the page is what the stored results give, and changed ratios are
found."""
import contextlib
import io
import json
import unittest

import performance
from measuring import number, ratio, ratio_text


class Performance(unittest.TestCase):
    def setUp(self):
        self.text = performance.STORE.read_text(encoding="utf-8")
        self.store = json.loads(self.text)

    def test_page_is_rendered_from_the_stored_results(self):
        page = performance.PAGE.read_text(encoding="utf-8")
        self.assertEqual(performance.rendered(self.store, page), page)
        self.assertEqual(performance.json_lines(self.store) + "\n", self.text)

    def test_all_parts_are_stored_with_their_command_and_machine(self):
        self.assertEqual(list(self.store["parts"]), list(performance.PARTS))
        for name, part in self.store["parts"].items():
            self.assertIn(part["machine"], self.store["machines"], name)
            self.assertIn(part["command"], [performance.words_of(name, quick) for quick in (False, True)])
            for table in part["tables"]:
                self.assertEqual({len(row) for row in table["rows"]}, {len(table["columns"])}, name)

    def test_studies_of_commands_exist(self):
        for name in performance.PARTS:
            for quick in (False, True):
                for word in performance.words_of(name, quick).split():
                    if word.endswith((".toml", ".py")):
                        self.assertTrue((performance.SOURCES / word).is_file(), word)

    def test_ratio_is_median_and_range(self):
        self.assertEqual(ratio([3.0, 1.0, 2.0]), {"median": 2.0, "low": 1.0, "high": 3.0, "rounds": 3})
        self.assertEqual(ratio_text(ratio([3.0, 1.0, 2.0])), "2.00 (1.00 to 3.00)")
        self.assertEqual(ratio_text(ratio([2.0])), "2.00")
        self.assertEqual([number(x) for x in (1234567.0, 12, 1234, 12.34, 0.5, 123.4)],
                         ["1,230,000", "12", "1,234", "12.3", "0.500", "123"])

    def test_change_exceeds_the_spread(self):
        stored = ratio([1.0, 1.02, 0.99])
        self.assertFalse(performance.differs(ratio([1.07, 1.08, 1.04]), stored, 0.05))
        self.assertTrue(performance.differs(ratio([1.2, 1.21, 1.19]), stored, 0.05))
        self.assertTrue(performance.differs(ratio([0.8, 0.81, 0.82]), stored, 0.05))
        self.assertFalse(performance.differs(ratio([1.2, 1.21, 1.0]), stored, 0.05))  # ranges overlap
        self.assertFalse(performance.differs(ratio([1.15]), stored, 0.05))            # one round: twice the margin
        self.assertTrue(performance.differs(ratio([1.3]), stored, 0.05))

    def test_compare_counts_changed_ratios(self):
        part = self.store["parts"]["scaling"]
        slower = part | {"ratios": {name: {key: value if key == "rounds" else 0.5 * value for key, value in one.items()}
                                    for name, one in part["ratios"].items()}}
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            self.assertEqual(performance.compare("scaling", part, part), 0)
            self.assertEqual(performance.compare("scaling", slower, part), len(part["ratios"]))
        self.assertIn("CHANGED", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
