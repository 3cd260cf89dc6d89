"""Summary of a report on one A4 sheet as PDF: the answer, its dependence on noise, and what limits
it."""

import io
import warnings

import charts  # noqa: F401  (its colours and styles)
import detection_figures
import headline
from charts import INK, MUTED, PAPER, RULE, SERIES
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle

WIDTH, HEIGHT, MARGIN = 8.27, 11.69, 0.7  # inches
LEAST_FIGURE, MOST_FIGURE = 1.9, 3.8
MOST_LEVELS = 8
SCALES = (1.0, 0.94, 0.88, 0.82, 0.76, 0.7, 0.64, 0.58, 0.52)


class Sheet:
    """Places texts from the top down, wrapped by their measured width. `y` is the top of the next
    line, in inches from the top of the sheet."""

    def __init__(self, scale):
        self.figure = Figure(figsize=(WIDTH, HEIGHT), facecolor=PAPER)
        self.renderer = FigureCanvasAgg(self.figure).get_renderer()
        self.scale, self.y = scale, MARGIN

    def width(self, text, size, weight):
        from matplotlib.font_manager import FontProperties
        font = FontProperties(size=size, weight=weight)
        return self.renderer.get_text_width_height_descent(text, font, False)[0] / self.figure.dpi

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

    def place(self, text, x, y, size, weight="normal", colour=INK):
        self.figure.text(x / WIDTH, 1 - y / HEIGHT, text, fontsize=size, fontweight=weight,
                         color=colour, va="top", ha="left", parse_math=False)

    def text(self, text, size, weight="normal", colour=INK, indent=0.0, mark="", bar=None):
        """Adds a paragraph. `mark` is a bullet to its left; `bar` is the colour of a vertical line
        to its left."""
        size *= self.scale
        step, top = 1.32 * size / 72, self.y
        if mark:
            self.place(mark, MARGIN, self.y, size, weight, colour)
        for line in self.lines(text, size, weight, WIDTH - 2 * MARGIN - indent):
            self.place(line, MARGIN + indent, self.y, size, weight, colour)
            self.y += step
        if bar:
            self.figure.add_artist(Rectangle((MARGIN / WIDTH, 1 - self.y / HEIGHT), 0.045 / WIDTH,
                                             (self.y - top) / HEIGHT, facecolor=bar, linewidth=0))
        self.y += 0.25 * step

    def gap(self, inches):
        self.y += inches * self.scale

    def table(self, head, rows, bold):
        """Adds a table; `bold` is the number of the row shown in bold. Columns have the width they
        need; the font shrinks if the table is too wide."""
        size = 9 * self.scale

        def widths():
            return [max(self.width(row[c], size, "bold") for row in [head, *rows]) + 0.16
                    for c in range(len(head))]

        room = WIDTH - 2 * MARGIN
        while sum(widths()) > room and size > 4:
            size *= 0.95
        extra = min(0.25, (room - sum(widths())) / len(head))
        for number_, row in enumerate([head, *rows]):
            x = MARGIN
            for cell, width in zip(row, widths()):
                self.place(cell, x, self.y, size, "bold" if number_ == bold + 1 else "normal",
                           MUTED if number_ == 0 else INK)
                x += width + max(0.0, extra)
            self.y += 1.5 * size / 72
            self.figure.add_artist(Line2D(
                [MARGIN / WIDTH, 1 - MARGIN / WIDTH], [1 - (self.y - 0.02) / HEIGHT] * 2,
                color=RULE, linewidth=0.6))
            self.y += 0.02

    def axes(self, left, right, height):
        """Adds axes; `left` and `right` are shares of the width between the margins."""
        room = WIDTH - 2 * MARGIN
        return self.figure.add_axes(((MARGIN + left * room) / WIDTH, 1 - (self.y + height) / HEIGHT,
                                     (right - left) * room / WIDTH, height / HEIGHT))


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
    named = [(name.replace("_", " "), given[name]) for name in
             ("code_version", "git_hash", "seed", "date", "host") if given.get(name)]
    texts = [f"{name} {value}" for name, value in named]
    if "results" in report.data:
        texts.insert(0, report.data["results"])
    return "gearpod: " + "; ".join(texts) + ". All numbers: gearpod report --html or --json."


def _filled(report, scale):
    """The sheet, and the distance of its last line from the lower margin (inches); negative if it
    does not fit."""
    assessable = "smallest_fault" in report.findings
    sheet = Sheet(scale)
    sheet.text(report.title(), 10, colour=MUTED)
    sheet.gap(0.06)
    sheet.text(report.text("headline"), 15, "bold", indent=0.17, bar=SERIES[0][0])
    sheet.gap(0.05)
    for text in [*headline.conditions(report), report.text("shortage")]:
        if text:
            sheet.text(text, 9.5, indent=0.17)
    sheet.gap(0.08)
    if assessable:
        _table(sheet, report)
    above, sheet.y = sheet.y, 0.0
    # The text below the figures is placed from their lower edge.
    rest = Sheet(scale)
    _below(rest, report, assessable)
    below = rest.y - MARGIN
    free = HEIGHT - MARGIN - above - below
    sheet.y = above
    if assessable:
        height = min(MOST_FIGURE, free)
        if height < LEAST_FIGURE:
            return sheet, height - LEAST_FIGURE
        _figure(sheet, report, height)
    _below(sheet, report, assessable)
    return sheet, HEIGHT - MARGIN - sheet.y


def _below(sheet, report, assessable):
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
    with warnings.catch_warnings():
        # Glyphs missing in the font are drawn as boxes.
        warnings.filterwarnings("ignore", message="Glyph")
        for scale in SCALES:
            sheet, left = _filled(report, scale)
            if left >= -1e-6:
                break
    return sheet


def pdf(report):
    buffer = io.BytesIO()
    # Embed fonts, so that text stays text.
    with rc_context({"pdf.fonttype": 42, "svg.fonttype": "path"}), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph")
        sheet_of(report).figure.savefig(buffer, format="pdf", facecolor=PAPER, metadata={
            "Title": report.title(), "Subject": report.text("headline"), "Creator": "gearpod",
            "CreationDate": None})
    return buffer.getvalue()
