"""Document of an evidence pack as PDF: the sections of the JSON's "evidence" on A4 pages, with their
figures and the study's text."""

import detection_figures
import monitoring_figures
from charts import INK, MUTED
from pages.inspection_page import Inspection, draw_curve
from report import Findings, Report
from summary_sheet import HEIGHT, MARGIN, ROOM, Sheet, pdf_of
from words import typeset

TEXT, CELL, CODE = 9, 7, 6.5  # points
GAP = 0.12  # inches between columns
LEAST_COLUMN = 0.45
CODE_COLUMNS = 125
FIGURE = 2.6  # inches


class Document(Sheet):
    """Places blocks from the top down and begins a page where the last one is full."""

    space_after = 0.35

    def __init__(self):
        self.pages = []
        super().__init__()

    def begin_page(self):
        super().begin_page()
        self.pages.append(self.figure)

    def require(self, height):
        """Begins a page unless the height is left on this one."""
        if self.y + height > HEIGHT - MARGIN and self.y > MARGIN:
            self.begin_page()

    def heading(self, text):
        self.y += 0.12 if self.y > MARGIN else 0.0
        self.text(text, 12, "bold", keep=0.9)

    def code(self, text):
        step = 1.25 * CODE / 72
        for line in text.splitlines():
            for start in range(0, max(1, len(line)), CODE_COLUMNS):
                self.require(step)
                self.place(line[start:start + CODE_COLUMNS], MARGIN, self.y, CODE,
                                family="DejaVu Sans Mono")
                self.y += step

    def chart(self, draw):
        """Adds axes for `draw` over the whole width."""
        self.require(FIGURE + 0.7)
        self.y += 0.25
        draw(self.axes(0.09, 0.98, FIGURE))
        self.y += FIGURE + 0.5

    def table(self, title, columns, rows, labels):
        """Adds a table. Cells are wrapped; what is still too wide continues in further blocks, each
        with the first `labels` columns."""
        if title:
            self.text(title, 8, "bold", keep=0.75)
        for numbers, widths in _blocks(self, columns, rows, labels):
            self._block([columns[c] for c in numbers],
                        [[row[c] for c in numbers] for row in rows], widths)
        self.y += 0.06

    def _block(self, columns, rows, widths):
        step = 1.25 * CELL / 72

        def place(cells, colour=INK, weight="normal", left=0.0):
            """Adds a row; begins a page with the head unless it and `left` inches fit on this one."""
            lines = [self.lines(cell, CELL, weight, width) for cell, width in zip(cells, widths)]
            height = step * max(map(len, lines)) + 0.05
            if left:
                self.require(height + left)
            elif self.y + height > HEIGHT - MARGIN:
                self.begin_page()
                place(columns, MUTED, "bold")
            x = MARGIN
            for cell, width in zip(lines, widths):
                for k, line in enumerate(cell):
                    self.place(line, x, self.y + k * step, CELL, weight, colour)
                x += width + GAP
            self.y += height
            self.rule(self.y - 0.025, 0.5)

        place(columns, MUTED, "bold", left=0.4)
        for cells in rows:
            place(cells)
        self.y += 0.06


def _blocks(page, columns, rows, labels):
    """Numbers and widths of the columns of each block of a table."""
    def widest(c, measure):
        return max([measure(columns[c], "bold")] + [measure(row[c], "normal") for row in rows])

    def whole(text, weight):
        return page.width(text, CELL, weight) + 0.02

    def longest_word(text, weight):
        return max(whole(word, weight) for word in text.split(" "))

    natural = [widest(c, whole) for c in range(len(columns))]
    # A cell is wrapped into about two lines, unless the column would take much of the page.
    least = [min(natural[c], max(LEAST_COLUMN, min(0.4 * ROOM, max(widest(c, longest_word),
                                                                  0.55 * natural[c]))))
             for c in range(len(columns))]
    first = list(range(min(labels, len(columns))))
    rest = [c for c in range(len(columns)) if c not in first]
    while True:
        block, used = list(first), sum(least[c] + GAP for c in first)
        while rest and (len(block) == len(first) or used + least[rest[0]] <= ROOM):
            used += least[rest[0]] + GAP
            block.append(rest.pop(0))
        extra = sum(natural[c] - least[c] for c in block)
        room = max(0.0, ROOM - sum(least[c] + GAP for c in block) + GAP)
        share = min(1.0, room / extra) if extra > 0 else 0.0
        yield block, [least[c] + share * (natural[c] - least[c]) for c in block]
        if not rest:
            return


def _figures(document, report):
    """Figures of the detection evidence."""
    if isinstance(report, Inspection) and not report.pod["refusal"]:
        document.chart(lambda axes: draw_curve(axes, report))
    if not isinstance(report, Report):
        return
    if report.assessable and "smallest_fault" in report.findings:
        document.chart(lambda axes: detection_figures.of_feature(
            axes, report, detection_figures.best(report)))
    for draw in monitoring_figures.drawings(report):
        document.chart(draw)


def document_of(data):
    """Title, and the document with its pages numbered."""
    kind = data.get("kind")
    report = Inspection(data) if kind == "inspection" else Findings(data) if kind else Report(data)
    title = report.title() if hasattr(report, "title") else data["title"]
    document = Document()
    document.text("Evidence pack", 10, colour=MUTED)
    document.text(title, 17, "bold")
    for section in data["evidence"]["sections"]:
        document.heading(section["title"])
        for block in section["blocks"]:
            if "text" in block:
                document.text(typeset(block["text"]), TEXT)
            else:
                document.table(typeset(block["title"]), list(map(typeset, block["columns"])),
                               [list(map(typeset, row)) for row in block["rows"]], block["labels"])
        if section["key"] == "detection":
            _figures(document, report)
        if section["key"] == "software" and data["evidence"]["study"]:
            document.text("study.toml", 8, "bold", keep=0.3)
            document.code(data["evidence"]["study"])
    for number, document.figure in enumerate(document.pages, 1):
        document.place(f"{title} – evidence pack, page {number} of {len(document.pages)}", MARGIN,
                       HEIGHT - 0.45, 7, colour=MUTED)
    return title, document


def pdf(data):
    title, document = document_of(data)
    return pdf_of(document.pages, f"{title} – evidence pack")
