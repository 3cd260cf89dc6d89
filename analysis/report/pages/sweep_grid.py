"""Points of a sweep in charts and tables: one key along the axis, one chart per combination of the
others."""

import itertools
import math
import re

from matplotlib.ticker import MaxNLocator

import blocks
from charts import colour, dash, legend_above, marker, open_end, panel, to_svg
from report import Findings
from words import count, number, percent

MOST_LINES = 5  # in a chart
MOST_CHARTS = 24  # in a figure
MOST_ROWS = 2000  # in a table
LONGEST = 28  # letters of a value below an axis


def clipped(text):
    """Shortened TOML value: uniform, low=1, high=2 for { distribution = "uniform", low = 1, high =
    2 }."""
    text = re.sub(" *= *", "=", re.sub(r"[{}\"]|distribution *= *", "", text)).strip()
    return text if len(text) <= LONGEST else text[:LONGEST - 1] + "…"


def as_number(text):
    try:
        return float(text)
    except ValueError:
        return math.nan


class Key:
    """A key with its values, on a scale if all are distinct numbers, otherwise at equal
    distances."""

    def __init__(self, entry):
        self.key, self.values = entry["key"], entry["values"]
        self.name = self.key.rpartition(".")[2]
        texts = [clipped(text) for text in self.values]
        # Clipped values, numbered where several are clipped to the same text.
        self.labels = {value: f"{i}: {text}" if texts.count(text) > 1 else text
                       for i, value, text in zip(itertools.count(1), self.values, texts)}
        numbers = [as_number(text) for text in self.values]
        self.scaled = all(map(math.isfinite, numbers)) and len(set(numbers)) == len(numbers)
        self.places = numbers if self.scaled else list(range(len(self.values)))
        self.log = self.scaled and min(numbers) > 0 and max(numbers) >= 6 * min(numbers)

    def place(self, point):
        return self.places[self.values.index(point["values"][self.key])]

    def set_axis(self, axes):
        axes.set_xlabel(self.name)
        if not self.scaled:
            room = 26 // max(2, len(self.places))
            labels = [self.labels[text] for text in self.values]
            turned = {"rotation": 30, "ha": "right", "fontsize": 9}
            axes.set_xticks(self.places, labels,
                            **turned if any(len(text) > room for text in labels) else {})
            axes.set_xlim(-0.4, len(self.places) - 0.6)
            return
        forth, back = (math.log, math.exp) if self.log else (float, float)
        if self.log:
            axes.set_xscale("log")
        at = sorted(map(forth, self.places))
        reach = (at[-1] - at[0]) or 1.0
        if len(at) > 1:  # the same where a panel lacks points
            axes.set_xlim(back(at[0] - 0.07 * reach), back(at[-1] + 0.07 * reach))
        if all(b - a > 0.16 * reach for a, b in zip(at, at[1:])):
            axes.set_xticks(sorted(self.places), [number(v, 4) for v in sorted(self.places)])
            axes.minorticks_off()
        elif self.log:
            axes.minorticks_off()
        else:
            axes.xaxis.set_major_locator(MaxNLocator(5))


class Grid(Findings):
    """Findings and points of a sweep over the values of its keys."""

    def __init__(self, data):
        super().__init__(data)
        self.points = data["points"]
        self.confidence = percent(self.points[0]["confidence"])
        self.keys = [Key(entry) for entry in data["varied"]]
        # Key along the axis: the numeric key with most values.
        self.along = max(self.keys, key=lambda k: (k.scaled, len(k.values)))
        self.others = [key for key in self.keys if key is not self.along]

    def panels(self):
        """Title and points of every combination of the other keys' values."""
        for values in itertools.product(*(key.values for key in self.others)):
            chosen = [p for p in self.points if all(
                p["values"][key.key] == value for key, value in zip(self.others, values))]
            yield ", ".join(f"{key.name} = {key.labels[value]}"
                            for key, value in zip(self.others, values)), sorted(
                                chosen, key=self.along.place)


def _series(swept, points, value):
    """Place, value, lower and upper end of every point. The value is NaN where there is none; an open
    end is infinite."""
    out = []
    for point in points:
        at, lower, upper = value(point) or (None, None, None)
        out.append((swept.along.place(point), math.nan if at is None else at,
                    -math.inf if lower is None else lower, math.inf if upper is None else upper))
    return out


def _shifted(swept, x, line, lines):
    """Position shifted by line, so that intervals of several lines do not overlap."""
    places = swept.along.places
    if len(places) < 2 or lines < 2:
        return x
    share = 0.014 * (line - 0.5 * (lines - 1))
    if swept.along.log:
        return x * (max(places) / min(places)) ** share
    return x + share * (max(places) - min(places))


def figure(swept, page, title, axis, how, lines, data, nothing, limits=None):
    """Figure with one chart per combination of the other keys, all with the same axes. `lines`: name
    and value(point), drawn where there is a value; `data`: key of the table with the numbers;
    `nothing`: text where there is no value at all."""
    panels = list(swept.panels())
    drawn = [(text, points, [_series(swept, points, value) for _, value in lines])
             for text, points in panels[:MOST_CHARTS]]
    ends = [end for *_, series in drawn for line in series for point in line
            if math.isfinite(point[1]) for end in point[1:] if math.isfinite(end)]
    if not ends:
        return blocks.note(nothing)
    pad = 0.06 * ((max(ends) - min(ends)) or abs(max(ends)) or 1.0)
    low, high = limits or (min(ends) - pad, max(ends) + pad)
    low = max(low, 0.0) if min(ends) >= 0 else low
    charts = []
    for text, chosen, series in drawn:
        chart, axes = panel(3.0 + 0.22 * ((len(lines) + 1) // 2))
        for i, ((name, _), line) in enumerate(zip(lines, series)):
            bounded = any(point[2] < point[3] for point in line if math.isfinite(point[1]))
            x = [_shifted(swept, point[0], i, len(lines) if bounded else 1) for point in line]
            axes.plot(x, [point[1] for point in line], color=colour(i),
                      linestyle=dash(i) if swept.along.scaled else "none",
                      marker=marker(i), markersize=5, markeredgewidth=0, label=name)
            if bounded:
                for place, (_, at, *ends) in zip(x, line):
                    if math.isfinite(at):
                        axes.vlines(place, *(end if math.isfinite(end) else at for end in ends),
                                    color=colour(i), linewidth=1.1)
                        for end, direction in zip(ends, (-1, 1)):
                            if math.isinf(end):
                                open_end(axes, (place, at), (0, direction), colour(i))
        swept.along.set_axis(axes)
        axes.set(ylim=(low, high), ylabel=axis)
        legend_above(axes, text, pad=6 + 14 * ((len(lines) + 1) // 2))
        about = "; ".join(f"{name}: " + ", ".join(
            f"{number(at)} at {swept.along.labels[value['values'][swept.along.key]]}"
            for value, (_, at, _, _) in zip(chosen, line))
            for (name, _), line in zip(lines, series))
        charts.append(to_svg(chart, f"{title}{', ' if text else ''}{text}", about, page.names))
    if len(panels) > len(drawn):
        how += f" The charts show the first {MOST_CHARTS} of {len(panels)} combinations."
    return page.figure(title, charts, how, table_of(swept, data))


def table_of(swept, key):
    """HTML of a table of the findings, cut if it is very long."""
    if key not in swept.findings:
        return ""
    head, rows = swept.rows(key)
    return blocks.table(swept.heading(key), head, rows[:MOST_ROWS]) + blocks.paragraph(
        f"The first {count(MOST_ROWS)} of {count(len(rows))} lines; all are in the JSON."
        ) * (len(rows) > MOST_ROWS)


def parts(swept, page, name, body):
    """Title, headline sentence, HTML of the answer (its sentence, whether the points differ, and the
    table of all points), HTML of the sections with the results files and the common properties."""
    answer = (blocks.answer(swept.text("headline"))
              + "".join(map(blocks.paragraph, swept.texts("differences") + swept.texts("withheld")))
              + swept.notes("shortage.") + table_of(swept, "points")
              + "".join(map(blocks.small, swept.texts("note."))))
    body += page.section("files", "The studies", blocks.bullets(
        swept.texts("common") + swept.texts("varied")) + table_of(swept, "files"))
    title = swept.data["title"]
    return f"{name}: {title}" if title else name, swept.text("headline"), answer, body
