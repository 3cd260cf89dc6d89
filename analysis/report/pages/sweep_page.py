"""The page of gearpod sweep: a study at every combination of the values of some keys."""

import itertools
import math
import re

from matplotlib.ticker import MaxNLocator

import blocks
from charts import INK, colour, dash, legend_above, marker, panel, to_svg
from words import (TESTED_ALONE, Sizes, count, escape, noise, number, percent, plural,
                   rate_with_bounds)

MOST_LINES = 5     # in a chart
MOST_CHARTS = 24   # in a figure
MOST_ROWS = 2000   # in a table
LONGEST = 18       # letters of a value below an axis


def short(key):
    return key.rpartition(".")[2]


def clipped(text):
    """A TOML value in few letters: uniform, 1, 2 of { distribution = "uniform", low = 1, high = 2 }."""
    text = re.sub(r"[{}\"]|\w+ *= *", "", text).strip()
    return text if len(text) <= LONGEST else text[:LONGEST - 1] + "…"


def as_number(text):
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


class Key:
    """A key with its values, on a scale if all are numbers, else one beside the other."""

    def __init__(self, entry):
        self.key, self.values = entry["key"], entry["values"]
        self.name = short(self.key)
        numbers = [as_number(text) for text in self.values]
        self.scaled = all(v is not None for v in numbers) and len(set(numbers)) == len(numbers)
        self.places = numbers if self.scaled else list(range(len(self.values)))
        self.log = (self.scaled and min(numbers) > 0 and max(numbers) >= 6 * min(numbers))

    def place(self, text):
        return self.places[self.values.index(text)]

    def set_axis(self, axes):
        axes.set_xlabel(self.name)
        if self.log:
            axes.set_xscale("log")
        transform = math.log if self.log else float
        at = sorted(transform(place) for place in self.places)
        reach = (at[-1] - at[0]) or 1.0
        if self.scaled and len(at) > 1:  # the same where a panel lacks points
            back = math.exp if self.log else float
            axes.set_xlim(back(at[0] - 0.07 * reach), back(at[-1] + 0.07 * reach))
        if not self.scaled:
            room = 26 // max(2, len(self.places))
            labels = [clipped(text) for text in self.values]
            if any(len(text) > room for text in labels):
                axes.set_xticks(self.places, labels, rotation=30, ha="right", fontsize=9)
            else:
                axes.set_xticks(self.places, labels)
            axes.set_xlim(-0.4, len(self.places) - 0.6)
            return
        if all(b - a > 0.16 * reach for a, b in zip(at, at[1:])):
            axes.set_xticks(sorted(self.places), [number(v, 4) for v in sorted(self.places)])
            axes.minorticks_off()
        elif self.log:
            axes.minorticks_off()
        else:
            axes.xaxis.set_major_locator(MaxNLocator(5))


class Swept:
    def __init__(self, data):
        self.data = data
        self.points = data["points"]
        self.keys = [Key(entry) for entry in data["varied"]]
        first = self.points[0]
        self.sizes = Sizes({"name": first["size_name"],
                            "unit": "m" if first["size_unit"] == "mm" else first["size_unit"]})
        self.sizes.factor = 1.0  # the points' sizes are in the unit that is shown
        self.level = first["shown_level"]
        self.confidence = first["confidence"]
        # Along the axis: of the keys that are numbers the one with most values.
        self.along = max(self.keys, key=lambda k: (k.scaled, len(k.values)))
        self.others = [key for key in self.keys if key is not self.along]

    def name(self, point):
        return ", ".join(f"{short(k)} = {clipped(v)}" for k, v in point["values"].items())

    def smallest(self, point, level=None):
        level = self.level if level is None else level
        at = next((at for at in point["smallest_fault"] if at["noise_level"] == level), None)
        return at if at and at["size"] is not None else None

    def smallest_text(self, point, level):
        at = next((at for at in point["smallest_fault"] if at["noise_level"] == level), None)
        if at is None:
            return "–"
        if at["size"] is None:
            return "none" if at["has_threshold"] else "no threshold"
        return self.sizes.text(at["size"]) + ("" if at["from_curve"] else "*")

    def levels(self):
        return sorted({at["noise_level"] for p in self.points for at in p["smallest_fault"]})

    def feature(self, point, name):
        return next((f for f in point["features"]
                     if f["feature"] == name and f["noise_level"] == self.level), None)

    def names(self):
        """Features, first those that find the smallest fault most often, then by their area."""
        score = {}
        for point in self.points:
            found = self.smallest(point)
            for entry in point["features"]:
                if entry["noise_level"] == self.level:
                    leads, area = score.get(entry["feature"], (0, 0.0))
                    here = found is not None and found["feature"] == entry["feature"]
                    score[entry["feature"]] = (leads + here, area + (entry["auc"] or 0.0))
        return sorted(score, key=lambda name: score[name], reverse=True)

    def panels(self):
        """Title and points of every combination of the other keys' values."""
        for values in itertools.product(*(key.values for key in self.others)):
            chosen = [p for p in self.points if all(
                p["values"][key.key] == value for key, value in zip(self.others, values))]
            yield ", ".join(f"{key.name} = {clipped(value)}"
                            for key, value in zip(self.others, values)), sorted(
                                chosen, key=lambda p: self.along.place(p["values"][self.along.key]))

    def sentence(self):
        if self.level is None:
            return "The study computes no feature, so there is nothing to detect a fault with."
        found = [(at["size"], at["feature"], p) for p in self.points if (at := self.smallest(p))]
        begin = (f"Smallest fault found with 90\u00a0% probability at {percent(self.confidence)} "
                 f"confidence, {noise(self.level)}: ")
        missing = len(self.points) - len(found)
        if not found:
            return begin + f"none in any of {plural(len(self.points), 'study', 'studies')}."
        best, worst = min(found, key=lambda f: f[0]), max(found, key=lambda f: f[0])
        text = f"{self.sizes.text(best[0])} by {best[1]} at {self.name(best[2])}"
        if worst[0] > best[0]:
            text += f"; largest {self.sizes.text(worst[0])} by {worst[1]} at {self.name(worst[2])}"
        if missing:
            text += f"; none in {missing} of {count(len(self.points))}"
        return begin + text + "."


def _series(swept, points, value):
    """Place, value, lower and upper end of every point; NaN where it has none."""
    out = []
    for point in points:
        at, lower, upper = value(point) or (None, None, None)
        at = math.nan if at is None else at
        out.append((swept.along.place(point["values"][swept.along.key]), at,
                    at if lower is None else lower, at if upper is None else upper))
    return out


def _shifted(swept, x, line, lines):
    """Intervals of several lines stand beside each other, not on each other."""
    places = swept.along.places
    if len(places) < 2 or lines < 2:
        return x
    share = 0.014 * (line - 0.5 * (lines - 1))
    if swept.along.log:
        return x * (max(places) / min(places)) ** share
    return x + share * (max(places) - min(places))


def _charts(swept, page, title, axis, lines, limits=None):
    """A chart a combination of the other keys; `lines`: name and value(point), drawn where there is
    one. All with the same axes."""
    panels = list(swept.panels())
    drawn = [(text, points, [_series(swept, points, value) for _, value in lines])
             for text, points in panels[:MOST_CHARTS]]
    ends = [end for *_, series in drawn for line in series for point in line for end in point[1:]
            if math.isfinite(end)]
    if not ends:
        return [], ""
    pad = 0.06 * ((max(ends) - min(ends)) or abs(max(ends)) or 1.0)
    low, high = limits or (min(ends) - pad, max(ends) + pad)
    low = max(low, 0.0) if min(ends) >= 0 else low
    charts = []
    for text, chosen, series in drawn:
        figure, axes = panel(3.0 + 0.22 * ((len(lines) + 1) // 2))
        for i, ((name, _), line) in enumerate(zip(lines, series)):
            bounded = any(point[2] < point[3] for point in line)
            x = [_shifted(swept, point[0], i, len(lines) if bounded else 1) for point in line]
            axes.plot(x, [point[1] for point in line], color=colour(i),
                      linestyle=dash(i) if swept.along.scaled else "none",
                      marker=marker(i), markersize=5, markeredgewidth=0, label=name)
            if bounded:
                axes.vlines(x, [point[2] for point in line], [point[3] for point in line],
                            color=colour(i), linewidth=1.1)
        swept.along.set_axis(axes)
        axes.set_ylim(low, high)
        axes.set_ylabel(axis)
        legend_above(axes)
        if text:
            axes.set_title(text, fontsize=10, color=INK, loc="left",
                           pad=6 + 14 * ((len(lines) + 1) // 2))
        about = "; ".join(f"{name}: " + ", ".join(
            f"{number(at)} at {clipped(value['values'][swept.along.key])}"
            for value, (_, at, _, _) in zip(chosen, line))
            for (name, _), line in zip(lines, series))
        charts.append(to_svg(figure, f"{title}{', ' if text else ''}{text}", about, page.names))
    left = len(panels) - len(drawn)
    return charts, (f" Drawn are the first {MOST_CHARTS} of {len(panels)} combinations." if left
                    else "")


def _table(swept, caption, head, rows):
    cut = rows[:MOST_ROWS]
    html = blocks.table(caption, head, cut)
    if len(cut) < len(rows):
        html += blocks.paragraph(f"The first {count(len(cut))} of {count(len(rows))} lines; all are "
                                 "in the JSON.")
    return html


def _values(swept, point):
    return [clipped(point["values"][key.key]) for key in swept.keys]


def _answer(swept):
    levels = swept.levels()
    rows = []
    for point in swept.points:
        found = swept.smallest(point)
        best = found["feature"] if found else next(
            (f["feature"] for f in point["features"] if f["noise_level"] == swept.level), "–")
        entry = swept.feature(point, best)
        rows.append(_values(swept, point)
                    + [swept.smallest_text(point, level) for level in levels]
                    + [best, "–" if entry is None else rate_with_bounds(
                        entry["auc"], entry["auc_lower"], entry["auc_upper"]),
                       count(point["gearboxes"]), count(point["failed"])])
    head = ([key.name for key in swept.keys] + [noise(level) for level in levels]
            + ([f"by, {noise(swept.level)}"] if swept.level is not None else ["by"])
            + ["its area under the ROC", "gearboxes", "failed"])
    return _table(swept, "Smallest fault found, by noise", head, rows)


def _footnote(swept):
    star = any(at["size"] is not None and not at["from_curve"]
               for p in swept.points for at in p["smallest_fault"])
    return f'<p class="small">{TESTED_ALONE}</p>' if star else ""


def _by_noise(swept, page):
    levels = swept.levels()
    # The one shown first, and of the others as many as can be told apart.
    chosen = sorted([swept.level] + [v for v in levels if v != swept.level][:MOST_LINES - 1])

    def line(level):
        def value(point):
            found = swept.smallest(point, level)
            return (found["size"], None, None) if found else None
        return noise(level), value

    title = f"Smallest fault found over {swept.along.name}"
    charts, left = _charts(swept, page, title, swept.sizes.axis(), [line(v) for v in chosen])
    if not charts:
        return blocks.note("No fault size is found in any of them.")
    data = _table(swept, title, [key.name for key in swept.keys] + [noise(v) for v in levels],
                  [_values(swept, p) + [swept.smallest_text(p, v) for v in levels]
                   for p in swept.points])
    return page.figure(title, charts, "Lower is better: the smallest fault found with 90\u00a0% "
                       f"probability at {percent(swept.confidence)} confidence by any feature. No "
                       "mark: none of the tested sizes is." + left, data)


def _by_feature(swept, page, key, title, axis, how, shown):
    names = swept.names()[:MOST_LINES]

    def line(name):
        def value(point):
            entry = swept.feature(point, name)
            return entry and (entry[key], *(entry[end] for end in shown))
        return name, value

    charts, left = _charts(swept, page, title, axis, [line(name) for name in names])
    if not charts:
        return blocks.note(f"{title}: no feature has one.")
    rows = []
    for point in swept.points:
        for name in swept.names():
            entry = swept.feature(point, name)
            if entry is not None:
                rows.append(_values(swept, point) + [name] + [
                    number(entry[k]) for k in (key, *shown)])
    data = _table(swept, title, [k.name for k in swept.keys]
                  + ["feature", "value", "lower", "upper"], rows)
    some = (f" Drawn are the {len(names)} features that lead most often."
            if len(swept.names()) > len(names) else "")
    return page.figure(title, charts, how + some + left, data)


def parts(data, page):
    """Title, one sentence, HTML of the answer, HTML of the sections."""
    swept = Swept(data)
    answer = f'<p class="answer">{escape(swept.sentence())}</p>' + _answer(swept) + _footnote(swept)
    body = ""
    if swept.level is not None:
        at = noise(swept.level)
        body += page.section("found", "Smallest fault found", _by_noise(swept, page))
        sure = percent(swept.confidence)
        body += page.section("features", "Features", _by_feature(
            swept, page, "a90", f"a90 over {swept.along.name} at {at}",
            f"a90{', ' + swept.sizes.unit if swept.sizes.unit else ''}",
            "The size that the fitted curve finds with 90\u00a0% probability, with its one-sided "
            f"bounds at {sure}; a bound beyond the tested sizes ends at the mark. No mark: there is "
            "no curve, or it does not reach 90\u00a0% within the tested sizes.",
            ("a90_lower", "a90_bound")) + _by_feature(
            swept, page, "auc", f"Area under the ROC over {swept.along.name} at {at}",
            "Area under the ROC", "Share of pairs of a faulty and a healthy gearbox that the feature "
            f"ranks rightly, all fault sizes together, with its interval at {sure}; 0.5 is chance.",
            ("auc_lower", "auc_upper")))
    files = blocks.table("Results files", [key.name for key in swept.keys] + ["file"],
                         [_values(swept, p) + [p["results"]] for p in swept.points[:MOST_ROWS]])
    said = blocks.bullets([
        "Every study draws the same gearboxes (common random numbers): points differ by the varied "
        "keys, not by chance. Intervals are each point's own, so they may overlap where a pair "
        "differs surely: gearpod compare takes the difference gearbox by gearbox.",
        "Varied: " + "; ".join(f"{k.key} = {', '.join(map(clipped, k.values[:50]))}"
                               for k in swept.keys) + "."])
    body += page.section("files", "The studies", said + files)
    title = f"Sweep: {data['title']}" if data["title"] else "Sweep"
    return title, swept.sentence(), answer, body
