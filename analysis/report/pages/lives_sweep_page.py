"""Page of gearpod sweep --lives: cracks found in time over the values of some keys."""

import blocks
from lives.campaign_data import millimetres
from pages import sweep_grid
from pages.sweep_grid import MOST_LINES, Grid
from words import number, percent


class SweptLives(Grid):
    def __init__(self, data):
        super().__init__(data)
        self.confidence = self.points[0]["confidence"]
        self.pairs = [(one["feature"], one["detector"]) for one in data["order"]]

    def of(self, point, feature, detector):
        return next((one for one in point["monitored"]
                     if (one["feature"], one["detector"]) == (feature, detector)), None)


def _figure(swept, page, title, axis, how, value, limits=None):
    names = swept.pairs[:MOST_LINES]

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
            if len(swept.pairs) > len(names) else "")
    return page.figure(title, charts, how + some + left, sweep_grid.table_of(swept, "features"))


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    swept = SweptLives(data)
    body = ""
    if swept.pairs:
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
            f"{sure}. An arrow: too few lives for a bound. No mark: fewer are found.",
            lambda one: (millimetres(one["depth_90_m"]), millimetres(one["depth_90_m"]),
                         millimetres(one["depth_90_bound_m"]))))
        body += page.section("warning", "Warning times", _figure(
            swept, page, "Warning", "Hours before the tooth breaks",
            "Of the cracks found, the median of the hours left at the alarm; the line "
            "extends down to the time that 90\u00a0% have at least.",
            lambda one: (one["warning_50_h"], one["warning_90_h"], one["warning_50_h"])))
        body += page.section("alarms", "False alarms", _figure(
            swept, page, "False alarms", "Per 1000 hours",
            "Counted on healthy lives that did not set the threshold, with the interval at "
            f"{sure}; thresholds are set to "
            + " or ".join(sorted({number(p["false_alarms_per_1000_h"]) for p in swept.points})) + ".",
            lambda one: (one["false_alarms"]["per_1000_h"], *one["false_alarms"]["bounds"])))
    if records := sweep_grid.table_of(swept, "records"):
        body += page.section("records", "Records and interpolation errors", records)
    body += sweep_grid.files(swept, page)
    title = f"Sweep of lives: {data['title']}" if data["title"] else "Sweep of lives"
    return title, swept.text("headline"), sweep_grid.verdict(swept), body
