"""Checks tooth contact on a report's page: python3 test_contact_page.py CASES PROGRAM SOURCES"""

import sys
import unittest

from report_case import case

import build_page
from page_html import PageHtml


def page_of(blocks):
    data = case("usual")
    data["findings"].append({"key": "contact", "title": "Contact of the teeth", "blocks": blocks})
    return PageHtml(build_page.page_html(data)).text()


class ContactOfTheTeeth(unittest.TestCase):
    def test_every_mesh_has_its_share_of_time_out_of_contact(self):
        text = page_of([{"key": "contact.how", "text": "Share of its engagement"},
                        {"key": "contact_loss", "title": "Share of time out of contact",
                         "columns": ["mesh", "mean"], "rows": [["sun-planet", "12.5 %"],
                                                               ["ring-planet", "0 %"]]}])
        self.assertIn("Contact of the teeth", text)
        table = text[text.index("Share of time out of contact"):][:600]
        for part in ("sun-planet", "12.5 %", "ring-planet", "0 %"):
            self.assertIn(part, table)

    def test_teeth_that_cannot_separate_have_no_share(self):
        self.assertNotIn("out of contact", page_of([]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
