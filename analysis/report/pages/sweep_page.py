"""Page of gearpod sweep: a study at every combination of the values of some keys."""

import blocks
from pages import sweep_grid
from pages.sweep_grid import MOST_LINES, Grid
from words import (TESTED_ALONE, Sizes, count, escape, noise, number, percent, plural,
                   rate_with_bounds)


class Swept(Grid):
    def __init__(self, data):
        super().__init__(data)
        first = self.points[0]
        self.sizes = Sizes({"name": first["size_name"],
                            "unit": "m" if first["size_unit"] == "mm" else first["size_unit"]})
        self.sizes.factor = 1.0  # the points' sizes are in the displayed unit
        self.level = first["shown_level"]
        self.confidence = first["confidence"]

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
        """Features in order of how often they find the smallest fault, then of their area."""
        score = {}
        for point in self.points:
            found = self.smallest(point)
            for entry in point["features"]:
                if entry["noise_level"] == self.level:
                    leads, area = score.get(entry["feature"], (0, 0.0))
                    here = found is not None and found["feature"] == entry["feature"]
                    score[entry["feature"]] = (leads + here, area + (entry["auc"] or 0.0))
        return sorted(score, key=lambda name: score[name], reverse=True)

    def shortages(self):
        """Shortages of the studies' healthy samples, each once."""
        return list(dict.fromkeys(p["shortage"] for p in self.points if p["shortage"]))

    def without_threshold(self):
        """Number of studies without a threshold at the level shown."""
        return sum(at["noise_level"] == self.level and not at["has_threshold"]
                   for p in self.points for at in p["smallest_fault"])

    def sentence(self):
        if self.level is None:
            return "The study computes no feature, so there is nothing to detect a fault with."
        found = [(at["size"], at["feature"], p) for p in self.points if (at := self.smallest(p))]
        begin = (f"Smallest fault found with 90\u00a0% probability at {percent(self.confidence)} "
                 f"confidence, {noise(self.level)}: ")
        unknown = self.without_threshold()
        missing = len(self.points) - len(found) - unknown
        if not found and unknown:
            return begin + (f"no threshold in {unknown} of "
                            f"{plural(len(self.points), 'study', 'studies')}"
                            + (f", none in {missing}." if missing else "."))
        if not found:
            return begin + f"none in any of {plural(len(self.points), 'study', 'studies')}."
        best, worst = min(found, key=lambda f: f[0]), max(found, key=lambda f: f[0])
        text = f"{self.sizes.text(best[0])} by {best[1]} at {self.name(best[2])}"
        if worst[0] > best[0]:
            text += f"; largest {self.sizes.text(worst[0])} by {worst[1]} at {self.name(worst[2])}"
        if missing:
            text += f"; none in {missing} of {count(len(self.points))}"
        if unknown:
            text += f"; no threshold in {unknown} of {count(len(self.points))}"
        return begin + text + "."


def _verdict(swept):
    levels = swept.levels()
    rows = []
    for point in swept.points:
        found = swept.smallest(point)
        best = found["feature"] if found else next(
            (f["feature"] for f in point["features"] if f["noise_level"] == swept.level), "–")
        entry = swept.feature(point, best)
        rows.append(sweep_grid.values(swept, point)
                    + [swept.smallest_text(point, level) for level in levels]
                    + [best, "–" if entry is None else rate_with_bounds(
                        entry["auc"], entry["auc_lower"], entry["auc_upper"]),
                       count(point["gearboxes"]), count(point["failed"])])
    head = ([key.name for key in swept.keys] + [noise(level) for level in levels]
            + ([f"by, {noise(swept.level)}"] if swept.level is not None else ["by"])
            + ["its area under the ROC", "gearboxes", "failed"])
    return sweep_grid.table(swept, "Smallest fault found, by noise", head, rows)


def _footnote(swept):
    star = any(at["size"] is not None and not at["from_curve"]
               for p in swept.points for at in p["smallest_fault"])
    return f'<p class="small">{TESTED_ALONE}</p>' if star else ""


def _by_noise(swept, page):
    levels = swept.levels()
    # The reference level, and as many of the others as can be distinguished.
    chosen = sorted([swept.level] + [v for v in levels if v != swept.level][:MOST_LINES - 1])

    def line(level):
        def value(point):
            found = swept.smallest(point, level)
            return (found["size"], None, None) if found else None
        return noise(level), value

    title = f"Smallest fault found over {swept.along.name}"
    charts, left = sweep_grid.charts_of(swept, page, title, swept.sizes.axis(), [line(v) for v in chosen])
    if not charts:
        return blocks.note("No fault size is found in any study.")
    data = sweep_grid.table(swept, title, [key.name for key in swept.keys] + [noise(v) for v in levels],
                  [sweep_grid.values(swept, p) + [swept.smallest_text(p, v) for v in levels]
                   for p in swept.points])
    return page.figure(title, charts, "Lower is better: the smallest fault found with 90\u00a0% "
                                      f"probability at {percent(swept.confidence)} confidence by "
                                      "any feature. No mark: no tested size is found." + left, data)


def _by_feature(swept, page, key, title, axis, how, shown):
    names = swept.names()[:MOST_LINES]

    def line(name):
        def value(point):
            entry = swept.feature(point, name)
            return entry and (entry[key], *(entry[end] for end in shown))
        return name, value

    charts, left = sweep_grid.charts_of(swept, page, title, axis, [line(name) for name in names])
    if not charts:
        return blocks.note(f"{title}: no feature has one.")
    rows = []
    for point in swept.points:
        for name in swept.names():
            entry = swept.feature(point, name)
            if entry is not None:
                rows.append(sweep_grid.values(swept, point) + [name] + [
                    number(entry[k]) for k in (key, *shown)])
    data = sweep_grid.table(swept, title, [k.name for k in swept.keys]
                  + ["feature", "value", "lower", "upper"], rows)
    some = (f" The chart shows the {len(names)} features that are best most often."
            if len(swept.names()) > len(names) else "")
    return page.figure(title, charts, how + some + left, data)


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    swept = Swept(data)
    verdict = "".join(f'<p class="answer">{escape(text)}</p>'
                     for text in [*swept.shortages(), swept.sentence()])
    verdict += _verdict(swept) + _footnote(swept)
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
            "Area under the ROC", "Share of pairs of a faulty and a healthy gearbox that the "
                                  "feature ranks correctly, all fault sizes together, with its "
                                  f"interval at {sure}; 0.5 is chance.",
            ("auc_lower", "auc_upper")))
    body += sweep_grid.files(
        swept, page, ": gearpod compare takes the difference gearbox by gearbox")
    title = f"Sweep: {data['title']}" if data["title"] else "Sweep"
    return title, swept.sentence(), verdict, body
