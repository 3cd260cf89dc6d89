"""Page of gearpod sweep --lives: cracks found in time over the values of some keys."""

from functools import partial

from lives.campaign_data import millimetres
from pages import sweep_grid
from pages.sweep_grid import MOST_LINES, Grid
from words import number


def _figure(swept, page, title, axis, how, value, limits=None):
    def at(point, pair):
        return next((value(one) for one in point["monitored"]
                     if (one["feature"], one["detector"]) == pair), None)

    pairs = [(one["feature"], one["detector"]) for one in swept.data["order"]]
    if len(pairs) > MOST_LINES:
        how += f" The chart shows the {MOST_LINES} features that find the most."
    title = f"{title} over {swept.along.name}"
    return sweep_grid.figure(swept, page, title, axis, how,
                             [(", ".join(pair), partial(at, pair=pair)) for pair in pairs[:MOST_LINES]],
                             "features", f"{title}: nothing to show.", limits)


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    swept = Grid(data)
    body = ""
    if data["order"]:
        body += page.section("found", "Found before the end", _figure(
            swept, page, "Share found", "Share of the cracks",
            "Of the lives whose tooth breaks within their records, the share with an alarm before, for each "
            "feature with the detector that finds most over all points, with Wilson intervals at "
            f"{swept.confidence}.", lambda one: (one["share"], *one["share_bounds"]), (0.0, 1.02)))
        body += page.section("depth", "Depth at detection", _figure(
            swept, page, "90 % found by", "Depth, mm",
            "The depth by which 90\u00a0% of the cracks are found, with its upper bound at "
            f"{swept.confidence}. An arrow: too few lives for a bound. No mark: fewer are found.",
            lambda one: (millimetres(one["depth_90_m"]), millimetres(one["depth_90_m"]),
                         millimetres(one["depth_90_bound_m"]))))
        body += page.section("warning", "Warning times", _figure(
            swept, page, "Warning", "Hours before the tooth breaks",
            "Of the cracks found, the median of the hours left at the alarm; the line extends down to the "
            "time that 90\u00a0% have at least.",
            lambda one: (one["warning_50_h"], one["warning_90_h"], one["warning_50_h"])))
        rates = sorted({number(p["false_alarms_per_1000_h"]) for p in swept.points})
        body += page.section("alarms", "False alarms", _figure(
            swept, page, "False alarms", "Per 1000 hours",
            "Counted on healthy lives that did not set the threshold, with the interval at "
            f"{swept.confidence}; thresholds are set to {' or '.join(rates)}.",
            lambda one: (one["false_alarms"]["per_1000_h"], *one["false_alarms"]["bounds"])))
    if records := sweep_grid.table_of(swept, "records"):
        body += page.section("records", "Records and interpolation errors", records)
    return sweep_grid.parts(swept, page, "Sweep of lives", body)
