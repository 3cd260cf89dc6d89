"""Document of an evidence pack as PDF: the sections of the JSON's "evidence" on A4 pages, with their
figures and the study's text."""

import functools
import io
import warnings

import charts  # noqa: F401  (its colours and styles)
import detection_figures
import monitoring_figures
from charts import INK, MUTED, PAPER, RULE
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from pages.inspection_page import Inspection, draw_curve
from report import Findings, Report
from summary_sheet import HEIGHT, MARGIN, WIDTH, Sheet
from words import typeset

ROOM = WIDTH - 2 * MARGIN
TEXT, CELL, CODE = 9, 7, 6.5  # points
GAP = 0.12  # inches between columns
LEAST_COLUMN = 0.45
CODE_COLUMNS = 125
FIGURE = 2.6  # inches


@functools.lru_cache(maxsize=None)
def _word_width(word, size, weight):
    renderer = _word_width.renderer
    font = FontProperties(size=size, weight=weight)
    return renderer.get_text_width_height_descent(word, font, False)[0] / _word_width.dpi


_MEASURED = Figure()
_word_width.renderer = FigureCanvasAgg(_MEASURED).get_renderer()
_word_width.dpi = _MEASURED.dpi


class Page(Sheet):
    """A sheet whose words are measured once each: a document has many."""

    def __init__(self):
        super().__init__(1.0)

    def width(self, text, size, weight):
        words = text.split(" ")
        space = _word_width("n n", size, weight) - 2 * _word_width("n", size, weight)
        return sum(_word_width(word, size, weight) for word in words if word) + space * (len(words) - 1)


class Document:
    """Places blocks from the top down and begins a page where the last one is full."""

    def __init__(self):
        self.pages = [Page()]

    @property
    def page(self):
        return self.pages[-1]

    def require(self, height):
        """Begins a page unless the height (inches) is left on this one."""
        if self.page.y + height > HEIGHT - MARGIN and self.page.y > MARGIN:
            self.pages.append(Page())

    def text(self, text, size=TEXT, weight="normal", colour=INK, keep=0.0):
        """Adds a paragraph. `keep`: height below it that stays on the same page."""
        step = 1.32 * size / 72
        lines = self.page.lines(text, size, weight, ROOM)
        self.require(min(3, len(lines)) * step + keep)
        for line in lines:
            self.require(step)
            self.page.place(line, MARGIN, self.page.y, size, weight, colour)
            self.page.y += step
        self.page.y += 0.35 * step

    def heading(self, text):
        self.page.y += 0.12 if self.page.y > MARGIN else 0.0
        self.text(text, 12, "bold", keep=0.9)

    def code(self, text):
        step = 1.25 * CODE / 72
        for line in text.splitlines():
            for start in range(0, max(1, len(line)), CODE_COLUMNS):
                self.require(step)
                self.page.figure.text(MARGIN / WIDTH, 1 - self.page.y / HEIGHT,
                                      line[start:start + CODE_COLUMNS], fontsize=CODE, color=INK,
                                      family="DejaVu Sans Mono", va="top", ha="left",
                                      parse_math=False)
                self.page.y += step

    def figure(self, draw):
        """Adds axes for `draw` over the whole width."""
        self.require(FIGURE + 0.7)
        self.page.y += 0.25
        draw(self.page.axes(0.09, 0.98, FIGURE))
        self.page.y += FIGURE + 0.5

    def table(self, title, columns, rows, labels):
        """Adds a table. Cells are wrapped; what is still too wide continues in further blocks, each
        with the first `labels` columns."""
        if title:
            self.text(title, 8, "bold", keep=0.75)
        for numbers, widths in _blocks(self.page, columns, rows, labels):
            self._block([columns[c] for c in numbers],
                        [[row[c] for c in numbers] for row in rows], widths)
        self.page.y += 0.06

    def _row(self, cells, widths, colour, weight):
        step = 1.25 * CELL / 72
        lines = [self.page.lines(cell, CELL, weight, width) for cell, width in zip(cells, widths)]
        height = step * max(map(len, lines)) + 0.05
        return lines, height, step, colour, weight

    def _place(self, row, widths):
        lines, height, step, colour, weight = row
        x = MARGIN
        for cell, width in zip(lines, widths):
            for k, line in enumerate(cell):
                self.page.place(line, x, self.page.y + k * step, CELL, weight, colour)
            x += width + GAP
        self.page.y += height
        self.page.figure.add_artist(Line2D(
            [MARGIN / WIDTH, 1 - MARGIN / WIDTH], [1 - (self.page.y - 0.025) / HEIGHT] * 2,
            color=RULE, linewidth=0.5))

    def _block(self, columns, rows, widths):
        head = self._row(columns, widths, MUTED, "bold")
        self.require(head[1] + 0.4)
        self._place(head, widths)
        for cells in rows:
            row = self._row(cells, widths, INK, "normal")
            if self.page.y + row[1] > HEIGHT - MARGIN:
                self.pages.append(Page())
                self._place(head, widths)
            self._place(row, widths)
        self.page.y += 0.06


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


def _figures(document, data, report):
    """Figures of the detection evidence."""
    if data.get("kind") == "inspection":
        if not report.pod["refusal"]:
            document.figure(lambda axes: draw_curve(axes, report))
        return
    if not isinstance(report, Report):
        return
    if report.assessable and "smallest_fault" in report.findings:
        document.figure(lambda axes: detection_figures.of_feature(
            axes, report, detection_figures.best(report)))
    for draw in monitoring_figures.drawings(report):
        document.figure(draw)


def document_of(data):
    """The document with its pages numbered."""
    kind = data.get("kind")
    report = Inspection(data) if kind == "inspection" else Findings(data) if kind else Report(data)
    title = report.title() if hasattr(report, "title") else data["title"]
    document = Document()
    with warnings.catch_warnings():
        # Glyphs missing in the font are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph")
        document.text("Evidence pack", 10, colour=MUTED)
        document.text(title, 17, "bold")
        for section in data["evidence"]["sections"]:
            document.heading(section["title"])
            for block in section["blocks"]:
                if "text" in block:
                    document.text(typeset(block["text"]))
                else:
                    document.table(typeset(block["title"]), list(map(typeset, block["columns"])),
                                   [list(map(typeset, row)) for row in block["rows"]],
                                   block["labels"])
            if section["key"] == "detection":
                _figures(document, data, report)
            if section["key"] == "software" and data["evidence"]["study"]:
                document.text("study.toml", 8, "bold", keep=0.3)
                document.code(data["evidence"]["study"])
        for number, page in enumerate(document.pages):
            page.place(f"{title} – evidence pack, page {number + 1} of {len(document.pages)}", MARGIN,
                       HEIGHT - 0.45, 7, colour=MUTED)
    return title, document


def pdf(data):
    buffer = io.BytesIO()
    # Embed fonts, so that text stays text.
    with rc_context({"pdf.fonttype": 42}), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")
        title, document = document_of(data)
        with PdfPages(buffer, metadata={"Title": f"{title} – evidence pack", "Creator": "gearpod",
                                        "CreationDate": None}) as file:
            for page in document.pages:
                file.savefig(page.figure, facecolor=PAPER)
    return buffer.getvalue()
