"""The report's JSON (gearpod report --json): its numbers for the figures, and its findings in their
final words."""

import blocks
from words import Sizes, typeset


class Findings:
    """Statements and tables of a report by their keys."""

    def __init__(self, data):
        self.data = data
        self.findings = {block["key"]: block for section in data["findings"]
                         for block in section["blocks"]}

    def text(self, key):
        """Text of a statement; empty if the report does not make it."""
        return typeset(self.findings[key]["text"]) if key in self.findings else ""

    def texts(self, start):
        """Texts of all statements whose keys begin so."""
        return [typeset(block["text"]) for key, block in self.findings.items()
                if key.startswith(start) and "text" in block]

    def heading(self, key):
        """Title of a table."""
        return typeset(self.findings[key]["title"])

    def rows(self, key):
        """Column names and cells of a table."""
        given = self.findings[key]
        return ([typeset(name) for name in given["columns"]],
                [[typeset(cell) for cell in row] for row in given["rows"]])

    def table(self, key):
        """HTML of a table; empty if the report does not have it."""
        if key not in self.findings:
            return ""
        return blocks.table(self.heading(key), *self.rows(key))

    def tables(self, start):
        """HTML of all tables whose keys begin so."""
        return "".join(self.table(key) for key, block in self.findings.items()
                       if key.startswith(start) and "rows" in block)

    def notes(self, start):
        """HTML of all statements whose keys begin so."""
        return "".join(blocks.note(text) for text in self.texts(start))


class Report(Findings):
    def __init__(self, data):
        super().__init__(data)
        self.sizes = Sizes(data["detection"]["size"])
        self.levels = data["noise"]["levels"]
        self.reference = data["noise"]["reference"]
        self.detection = data["detection"]["features"]
        self.reliability = data["reliability"]
        self.smallest = data["smallest_fault"]
        self.confidence = data["detection"]["confidence"]
        self.names = [feature["name"] for feature in data["features"]]
        # Statements on detection are made only where it can be assessed.
        self.assessable = f"headline.{self.reference}" in self.findings
        self.curves = self.reliability and self.assessable

    def title(self):
        return self.data.get("title") or "Detection study"

    def reliable(self, feature, level):
        """Entry of a feature at a noise level in the reliability part, by number."""
        return self.reliability["features"][feature]["levels"][level]

    def cells(self, feature, level):
        return self.detection[feature]["levels"][level]["sizes"]

    def feature_number(self, name):
        return self.names.index(name)

    def unit(self, name):
        return self.data["features"][self.feature_number(name)]["unit"]

    def order(self, level):
        """Numbers of the features in order of rank, those without a rank last."""
        if not self.reliability:
            return list(range(len(self.names)))
        ranks = [rank["name"] for rank in self.reliability["levels"][level]["ranking"]["ranks"]]
        ranked = [self.feature_number(name) for name in ranks]
        return ranked + [f for f in range(len(self.names)) if f not in ranked]
