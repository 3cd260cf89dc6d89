"""Page of gearpod sweep --lives: cracks found in time over the values of some keys."""

import blocks
from pages import sweep_grid
from pages.sweep_grid import MOST_LINES, Grid
from words import count, escape, number, percent


class SweptLives(Grid):
    def __init__(self, data):
        super().__init__(data)
        self.confidence = self.points[0]["confidence"]

    def of(self, point, feature, detector):
        return next((one for one in point["monitored"] if one["unranked"] is None
                     and (one["feature"], one["detector"]) == (feature, detector)), None)

    def best(self, point):
        """Entry of the feature and detector that find most over all points."""
        best = self.data["best"]
        return best and self.of(point, best["feature"], best["detector"])

    def best_here(self, point):
        ranking = point["ranking"]
        return point["monitored"][ranking[0]] if ranking else None

    def names(self):
        """Features with the detector that is best over all points, the best feature first."""
        pairs = {}
        for point in self.points:
            for one in point["monitored"]:
                if one["unranked"] is None:
                    score = pairs.setdefault((one["feature"], one["detector"]), [0.0, 0.0])
                    score[0] -= one["net_share"]
                    score[1] += min(one["depth_90_m"] or point["last_depth_m"],
                                    point["last_depth_m"])
        chosen = []
        for pair in sorted(pairs, key=lambda pair: pairs[pair]):
            if pair[0] not in [feature for feature, _ in chosen]:
                chosen.append(pair)
        return chosen

    def sentence(self):
        best = self.data["best"]
        if best is None:
            return ("At none of these points does a detector find more cracks than chance with at most the "
                    "stated false alarms.")
        known = [(one["share"], point) for point in self.points
                 if (one := self.best(point)) and one["share"] is not None]
        begin = f"{best['feature']} by {best['detector']} "
        if not known:
            return begin + "finds nothing in time, because no tooth breaks within its records."
        low, high = min(known, key=lambda k: k[0]), max(known, key=lambda k: k[0])
        text = begin + f"finds {percent(high[0])} of the cracks before the tooth breaks"
        if low[0] < high[0]:
            text += f" at {self.name(high[1])}, {percent(low[0])} at {self.name(low[1])}"
        else:
            text += " at every point"
        warned = [(one["warning_50_h"], point) for point in self.points
                  if (one := self.best(point)) and one["warning_50_h"] is not None]
        if warned:
            low, high = min(warned, key=lambda k: k[0]), max(warned, key=lambda k: k[0])
            text += (f"; half of those found at least {number(low[0])} h before at "
                     f"{self.name(low[1])}")
            if high[0] > low[0]:
                text += f", {number(high[0])} h at {self.name(high[1])}"
        return text + "."


def _depth(metres, point):
    return f"> {number(1e3 * point['last_depth_m'])}" if metres is None else number(1e3 * metres)


def _cells(one, point):
    if one is None:
        return ["–"] * 6
    alarms = one["false_alarms"]
    share = depths = None
    if one["share"] is not None:
        low, high = one["share_bounds"]
        share = f"{one['found']}/{one['ended']}\u00a0[{low:.2f},\u00a0{high:.2f}]"
        depths = [_depth(one["depth_50_m"], point),
                  f"{_depth(one['depth_90_m'], point)}\u00a0({number(_mm(one['depth_90_bound_m']))})"]
    rate = "–" if alarms["per_1000_h"] is None else (
        f"{number(alarms['per_1000_h'])}\u00a0[{number(alarms['bounds'][0])},\u00a0"
        f"{number(alarms['bounds'][1])}]")
    return [rate, share or "–", *(depths or ["–", "–"]), number(one["warning_50_h"]),
            number(one["warning_90_h"])]


CELLS = ["false alarms per 1000 h", "found before the end", "50 % found by, mm",
         "90 % found by, mm (bound)", "median warning, h", "90 % at least, h"]


def _mm(metres):
    return None if metres is None else 1e3 * metres


def _verdict(swept):
    rows = []
    for point in swept.points:
        here = swept.best_here(point)
        rows.append(sweep_grid.values(swept, point) + _cells(swept.best(point), point)
                    + [f"{here['feature']}, {here['detector']}" if here else "–",
                       count(point["lives"]), count(point["failed"])])
    best = swept.data["best"]
    name = f"{best['feature']} by {best['detector']}" if best else "no detector"
    return sweep_grid.table(swept, f"By {name}", [key.name for key in swept.keys] + CELLS
                            + ["best here", "lives", "failed"], rows)


def _figure(swept, page, title, axis, how, value, limits=None):
    names = swept.names()[:MOST_LINES]

    def line(pair):
        def at(point):
            one = swept.of(point, *pair)
            return one and value(one)
        return f"{pair[0]}, {pair[1]}", at

    title = f"{title} over {swept.along.name}"
    charts, left = sweep_grid.charts_of(swept, page, title, axis, [line(pair) for pair in names],
                                        limits)
    if not charts:
        return blocks.note(f"{title}: nothing to show.")
    some = (f" The chart shows the {len(names)} features that find the most."
            if len(swept.names()) > len(names) else "")
    data = sweep_grid.table(
        swept, title, [key.name for key in swept.keys] + ["feature", "detector", *CELLS],
        [sweep_grid.values(swept, point) + list(pair) + _cells(swept.of(point, *pair), point)
         for point in swept.points for pair in names])
    return page.figure(title, charts, how + some + left, data)


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    swept = SweptLives(data)
    verdict = f'<p class="answer">{escape(swept.sentence())}</p>' + _verdict(swept)
    body = ""
    if swept.data["best"] is not None:
        sure = percent(swept.confidence)
        body += page.section("found", "Found before the end", _figure(
            swept, page, "Share found", "Share of the cracks",
            "Of the lives whose tooth breaks within their records, the share with an alarm "
            "before, for each feature with the detector that finds most over all points, "
            f"with Wilson intervals at {sure}.",
            lambda one: (one["share"], *one["share_bounds"]), (0.0, 1.02)))
        body += page.section("depth", "Depth at detection", _figure(
            swept, page, "90 % found by", "Depth, mm",
            "The depth by which 90\u00a0% of the cracks are found, with its upper bound at "
            f"{sure} where there are enough lives. No mark: fewer are found.",
            lambda one: (_mm(one["depth_90_m"]), None, _mm(one["depth_90_bound_m"]))))
        body += page.section("warning", "Warning times", _figure(
            swept, page, "Warning", "Hours before the tooth breaks",
            "Of the cracks found, the median of the hours left at the alarm; the line "
            "extends down to the time that 90\u00a0% have at least.",
            lambda one: (one["warning_50_h"], one["warning_90_h"], None)))
        body += page.section("alarms", "False alarms", _figure(
            swept, page, "False alarms", "Per 1000 hours",
            "Counted on healthy lives that did not set the threshold, with the interval at "
            f"{sure}; thresholds are set to "
            + " or ".join(sorted({number(p["false_alarms_per_1000_h"]) for p in swept.points})) + ".",
            lambda one: (one["false_alarms"]["per_1000_h"], *one["false_alarms"]["bounds"])))
        records = blocks.table("Records", [key.name for key in swept.keys] + [
            "record", "error at the first depths", "at the last", "between loads"], [
                sweep_grid.values(swept, p) + [p["record"]] + [
                    "–" if p["interpolation"][key] is None else percent(p["interpolation"][key])
                    for key in ("first", "last", "load")] for p in swept.points])
        body += page.section("records", "Records and interpolation errors", records)
    body += sweep_grid.files(swept, page, "")
    title = f"Sweep of lives: {data['title']}" if data["title"] else "Sweep of lives"
    return title, swept.sentence(), verdict, body
