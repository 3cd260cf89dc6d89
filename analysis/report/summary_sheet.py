"""Summary of a report on one A4 sheet as PDF: the answer, its dependence on noise, and what limits
it."""

import functools
import io

import detection_figures
import headline
from charts import INK, MUTED, PAPER, RULE, SERIES
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

WIDTH, HEIGHT, MARGIN = 8.27, 11.69, 0.7  # inches
ROOM = WIDTH - 2 * MARGIN
LEAST_FIGURE, MOST_FIGURE = 1.9, 3.8
MOST_LEVELS = 8
SCALES = (1.0, 0.94, 0.88, 0.82, 0.76, 0.7, 0.64, 0.58, 0.52)


_MEASURED = Figure()
_RENDERER = FigureCanvasAgg(_MEASURED).get_renderer()


@functools.cache
def _word_width(word, size, weight):
    font = FontProperties(size=size, weight=weight)
    return _RENDERER.get_text_width_height_descent(word, font, False)[0] / _MEASURED.dpi


def pdf_of(figures, title, subject=None):
    """Bytes of a PDF. Fonts are embedded, so that text stays text."""
    buffer = io.BytesIO()
    given = {"Title": title, "Subject": subject, "Creator": "gearpod", "CreationDate": None}
    with rc_context({"pdf.fonttype": 42}), PdfPages(buffer, metadata=given) as file:
        for figure in figures:
            file.savefig(figure, facecolor=PAPER)
    return buffer.getvalue()


class Sheet:
    """Places texts from the top down, wrapped by their measured width. `y` is the top of the next
    line, in inches from the top of the sheet."""

    space_after = 0.25  # of a paragraph, in lines

    def __init__(self, scale=1.0):
        self.scale = scale
        self.begin_page()

    def begin_page(self):
        self.figure = Figure(figsize=(WIDTH, HEIGHT), facecolor=PAPER)
        FigureCanvasAgg(self.figure)
        self.y = MARGIN

    def require(self, height):
        """Called before something of this height (inches) is placed."""

    def width(self, text, size, weight):
        """Width in inches, from words that are measured once each: a document has many."""
        words = text.split(" ")
        space = _word_width("n n", size, weight) - 2 * _word_width("n", size, weight)
        return sum(_word_width(word, size, weight) for word in words if word) + space * (len(words) - 1)

    def lines(self, text, size, weight, room):
        """Breaks a text into lines. A word wider than the room is split."""
        out, line = [], ""
        for word in text.split(" "):
            while self.width(word, size, weight) > room:
                cut = next(n for n in range(len(word), 0, -1)
                           if n == 1 or self.width(word[:n], size, weight) <= room)
                out += [line] if line else []
                out.append(word[:cut])
                line, word = "", word[cut:]
            longer = f"{line} {word}" if line else word
            if line and self.width(longer, size, weight) > room:
                out.append(line)
                longer = word
            line = longer
        return out + [line]

    def place(self, text, x, y, size, weight="normal", colour=INK, **options):
        self.figure.text(x / WIDTH, 1 - y / HEIGHT, text, fontsize=size, fontweight=weight,
                         color=colour, va="top", ha="left", parse_math=False, **options)

    def rule(self, y, width):
        """Draws a horizontal line between the margins."""
        self.figure.add_artist(Line2D([MARGIN / WIDTH, 1 - MARGIN / WIDTH], [1 - y / HEIGHT] * 2,
                                      color=RULE, linewidth=width))

    def text(self, text, size, weight="normal", colour=INK, indent=0.0, mark="", bar=None, keep=0.0):
        """Adds a paragraph. `mark` is a bullet to its left; `bar` is the colour of a vertical line
        to its left; `keep` is the height below it that stays on the same page."""
        size *= self.scale
        step, top = 1.32 * size / 72, self.y
        lines = self.lines(text, size, weight, ROOM - indent)
        self.require(min(3, len(lines)) * step + keep)
        if mark:
            self.place(mark, MARGIN, self.y, size, weight, colour)
        for line in lines:
            self.require(step)
            self.place(line, MARGIN + indent, self.y, size, weight, colour)
            self.y += step
        if bar:
            self.figure.add_artist(Rectangle((MARGIN / WIDTH, 1 - self.y / HEIGHT), 0.045 / WIDTH,
                                             (self.y - top) / HEIGHT, facecolor=bar, linewidth=0))
        self.y += self.space_after * step

    def gap(self, inches):
        self.y += inches * self.scale

    def table(self, head, rows, bold):
        """Adds a table; `bold` is the number of the row shown in bold. Columns have the width they
        need; the font shrinks if the table is too wide."""
        size = 9 * self.scale

        def widths():
            return [max(self.width(row[c], size, "bold") for row in [head, *rows]) + 0.16
                    for c in range(len(head))]

        while sum(widths()) > ROOM and size > 4:
            size *= 0.95
        extra = min(0.25, (ROOM - sum(widths())) / len(head))
        for number_, row in enumerate([head, *rows]):
            x = MARGIN
            for cell, width in zip(row, widths()):
                self.place(cell, x, self.y, size, "bold" if number_ == bold + 1 else "normal",
                           MUTED if number_ == 0 else INK)
                x += width + max(0.0, extra)
            self.y += 1.5 * size / 72
            self.rule(self.y - 0.02, 0.6)
            self.y += 0.02

    def axes(self, left, right, height):
        """Adds axes; `left` and `right` are shares of the width between the margins."""
        return self.figure.add_axes(((MARGIN + left * ROOM) / WIDTH, 1 - (self.y + height) / HEIGHT,
                                     (right - left) * ROOM / WIDTH, height / HEIGHT))


def _chosen(report):
    """Noise levels in the table: all, or the reference level and others spaced evenly."""
    count = len(report.levels)
    if count <= MOST_LEVELS:
        return list(range(count))
    evenly = {round(k * (count - 1) / (MOST_LEVELS - 2)) for k in range(MOST_LEVELS - 1)}
    return sorted(evenly | {report.reference})


def _table(sheet, report):
    chosen = _chosen(report)
    head, rows = report.rows("smallest_fault")
    sheet.text(report.findings["smallest_fault"]["title"] + ", by noise", 9, colour=MUTED)
    sheet.table(head, [rows[n] for n in chosen], chosen.index(report.reference))
    for text in report.texts("note."):
        sheet.gap(0.04)
        sheet.text(text, 7.5, colour=MUTED)


def _figure(sheet, report, height):
    sheet.y += 0.25  # titles and labels are outside the axes
    detection_figures.of_feature(sheet.axes(0.075, 0.85, height - 0.75), report,
                                 detection_figures.best(report))
    sheet.y += height - 0.25


def _provenance(report):
    given = report.data["provenance"]
    texts = [report.data["results"]] if "results" in report.data else []
    texts += [f"{name.replace('_', ' ')} {given[name]}" for name in
              ("code_version", "git_hash", "seed", "date", "host") if given.get(name)]
    return "gearpod: " + "; ".join(texts) + ". All numbers: gearpod report --html or --json."


def _filled(report, scale):
    """The sheet, and the distance of its last line from the lower margin (inches); negative if it
    does not fit."""
    sheet = Sheet(scale)
    sheet.text(report.title(), 10, colour=MUTED)
    sheet.gap(0.06)
    sheet.text(headline.answers(report)[0], 15, "bold", indent=0.17, bar=SERIES[0][0])
    sheet.gap(0.05)
    for text in [*headline.conditions(report), report.text("shortage")]:
        if text:
            sheet.text(text, 9.5, indent=0.17)
    sheet.gap(0.08)
    if "smallest_fault" in report.findings:
        _table(sheet, report)
        # The text below the figures is placed from their lower edge.
        rest = Sheet(scale)
        _below(rest, report)
        height = min(MOST_FIGURE, HEIGHT - sheet.y - rest.y)
        if height < LEAST_FIGURE:
            return sheet, height - LEAST_FIGURE
        _figure(sheet, report, height)
    _below(sheet, report)
    return sheet, HEIGHT - MARGIN - sheet.y


def _below(sheet, report):
    sheet.gap(0.1)
    texts = headline.limits(report)
    if texts:
        sheet.text("What limits it", 11, "bold")
        for text in texts:
            sheet.text(text, 9, indent=0.16, mark="•")
    sheet.gap(0.06)
    sheet.text(report.text("facts"), 8, colour=MUTED)
    sheet.text(_provenance(report), 7, colour=MUTED)


def sheet_of(report):
    """The sheet with the largest font scale at which everything fits."""
    for scale in SCALES:
        sheet, left = _filled(report, scale)
        if left >= -1e-6:
            break
    return sheet


def pdf(report):
    return pdf_of([sheet_of(report).figure], report.title(), report.text("headline"))
