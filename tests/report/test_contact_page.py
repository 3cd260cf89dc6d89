"""Checks tooth contact on a report's page: python3 test_contact_page.py CASES PROGRAM SOURCES

CASES holds the JSON from make_report_cases, SOURCES gearpod's sources.
"""

import json
import pathlib
import sys
import unittest

CASES, SOURCES = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[3])
sys.path.insert(0, str(SOURCES / "analysis" / "report"))
sys.path.insert(0, str(pathlib.Path(__file__).parent))

try:
    import build_page
    import words
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-matplotlib)")
    sys.exit(77)
from page_html import PageHtml  # noqa: E402


def page_of(contact):
    data = json.loads((CASES / "usual.json").read_text())
    data["contact_loss"] = contact
    return PageHtml(build_page.page_html(data)).text()


class ContactOfTheTeeth(unittest.TestCase):
    def test_every_mesh_has_its_share_of_time_out_of_contact(self):
        text = page_of([{"mesh": "sun-planet", "mean": 0.125, "lower": 0.0625, "median": 0.11,
                         "upper": 0.25, "gearboxes": 1234},
                        {"mesh": "ring-planet", "mean": 0.0, "lower": 0.0, "median": 0.0,
                         "upper": 0.0, "gearboxes": 1234}])
        self.assertIn("Contact of the teeth", text)
        table = text[text.index("Share of time out of contact"):][:600]
        for part in ("sun-planet", words.percent(0.125), words.percent(0.0625),
                     words.percent(0.11), words.percent(0.25), words.count(1234), "ring-planet",
                     words.percent(0.0)):
            self.assertIn(" ".join(part.split()), table)

    def test_teeth_that_cannot_separate_have_no_share(self):
        self.assertNotIn("out of contact", page_of(None))
        data = json.loads((CASES / "usual.json").read_text())
        data.pop("contact_loss", None)
        self.assertNotIn("out of contact", PageHtml(build_page.page_html(data)).text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
