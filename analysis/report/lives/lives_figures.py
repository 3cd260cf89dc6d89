"""Figures of the page of gearpod lives: crack growth, warning times, false alarms against depth."""

import blocks
from charts import DASHED, INK, NOISY, colour, dash, legend_below, marker, panel, plot, to_svg
from lives.campaign_data import millimetres
from words import number

DRAWN = 32  # lives drawn as single lines; gearpod lives --json gives deviations of as many


def fan(campaign, page):
    best = campaign.best()
    charts = [_depths(campaign, best, page), _deviations(campaign, best, page)]
    rows = []
    for k, life in enumerate(campaign.worked[:DRAWN]):
        alarm = campaign.alarm_h(best, k)
        rows.append([str(k + 1), _hours(life["end_h"]), _hours(alarm),
                     "–" if alarm is None else number(_depth_at(life, alarm))])
    names = f"{best['feature']} by {best['detector']}" if best else "no detector"
    return page.figure(
        "Crack growth and monitored deviation", charts,
        f"Each line is a life; a circle marks the first alarm of {names} after crack initiation, "
        "a cross the break of the tooth. The other chart shows the deviation of that feature "
        "from the gearbox's baseline in standard deviations; the grey band holds 90\u00a0% of "
        "the healthy lives. An alarm may use several records, so single points outside the band "
        "need not raise one.",
        blocks.table(f"Lives, alarms by {names}",
                     ["life", "tooth breaks, h", "alarm, h", "depth at alarm, mm"], rows))


def _panel_of(lines):
    """Chart with room for a legend of the given number of lines below."""
    return panel(2.9 + 0.22 * lines)


def _hours(value):
    return "–" if value is None else number(value)


def _depth_at(life, hours):
    return 1e3 * life["depth_m"][life["hours"].index(hours)]


def _alarm(axes, hours, value):
    axes.plot([hours], [value], marker="o", color=colour(1), markersize=4.5, markeredgewidth=0, zorder=4)


def _depths(campaign, best, page):
    figure, axes = panel()
    found = 0
    for k, life in enumerate(campaign.worked[:DRAWN]):
        grown = [(h, 1e3 * d) for h, d in zip(life["hours"], life["depth_m"]) if d > 0]
        if life["end_h"] is not None:
            grown.append((life["end_h"], campaign.depth_at_end(life)))
            axes.plot(*grown[-1], marker="x", color=INK, markersize=4, zorder=3)
        plot(axes, grown, color=colour(0), linewidth=0.8, alpha=0.55)
        alarm = campaign.alarm_h(best, k)
        if alarm is not None:
            found += 1
            _alarm(axes, alarm, _depth_at(life, alarm))
    axes.set(xlabel="Machine hours", ylabel="Depth of the crack, mm", ylim=(0, None))
    return to_svg(figure, "Depth of the crack over machine hours",
                  f"{min(DRAWN, len(campaign.worked))} lives, {found} of them found", page.names)


def _deviations(campaign, best, page):
    figure, axes = panel()
    name = best["feature"] if best else campaign.names()[0]
    one = next(f for f in campaign.data["fans"] if f["feature"] == name)
    step = campaign.data["interval_h"]
    band = [(k * step, low, high) for k, (low, high) in
            enumerate(zip(one["healthy_05"], one["healthy_95"])) if low is not None]
    axes.fill_between(*(list(zip(*band)) or [[]] * 3), color=NOISY, alpha=0.45, linewidth=0)
    largest = 1.0
    for k, values in enumerate(one["lives"]):
        line = [(i * step, v) for i, v in enumerate(values) if v is not None]
        largest = max([largest, *(abs(v) for _, v in line)])
        plot(axes, line, color=colour(0), linewidth=0.7, alpha=0.55)
        alarm = campaign.alarm_h(best, k)
        if alarm is not None and values[round(alarm / step)] is not None:
            _alarm(axes, alarm, values[round(alarm / step)])
    if largest > 50.0:
        _set_decades(axes)
    axes.axvline(campaign.crack_h, **DASHED)
    axes.set(xlabel="Machine hours (dashed: crack initiation)", title=name,
             ylabel="Deviation, standard deviations")
    return to_svg(figure, f"{name}: deviation from the baseline over machine hours",
                  f"{len(one['lives'])} lives with cracks, and the band of 90\u00a0% of the healthy lives",
                  page.names)


def _set_decades(axes):
    """Sets a scale that is linear to 5, then logarithmic, with marks from 10 on, because smaller
    ones would overlap 0."""
    axes.set_yscale("symlog", linthresh=5.0)
    low, high = axes.get_ylim()
    decades = [10.0 ** k for k in range(1, 12)]
    marks = [-d for d in reversed(decades) if -d >= low] + [0.0] + [d for d in decades if d <= high]
    axes.set_yticks(marks, [number(mark) for mark in marks])
    axes.minorticks_off()


def warning_times(campaign, page):
    if not campaign.ended:
        return blocks.note("No tooth breaks within its records, so there are no warning times.")
    figure, axes = _panel_of(len(campaign.names()))
    longest = max([w for name in campaign.names()
                   for w in campaign.warnings(campaign.best_of(name)) if w is not None] or [1.0])
    rows = []
    for k, name in enumerate(campaign.names()):
        best = campaign.best_of(name)
        warned = sorted((w for w in campaign.warnings(best) if w is not None), reverse=True)
        shares = [i / len(campaign.ended) for i in range(len(warned) + 1)]
        axes.step([longest, *warned, 0.0], [*shares, shares[-1]], where="post", color=colour(k),
                  linestyle=dash(k), label=f"{name}, {best['detector']}")
        rows.append([name, best["detector"], f"{best['found']}/{best['ended']}",
                     _hours(best["warning_50_h"]), _hours(best["warning_90_h"])])
    axes.set(xlabel="Hours before the tooth breaks", ylabel="Share found by then",
             xlim=(longest * 1.02, 0), ylim=(0, 1.02))
    legend_below(axes, 1)
    svg = to_svg(figure, "Share of cracks found against the time that is left",
                 "; ".join(f"{r[0]}: {r[2]} found" for r in rows), page.names)
    return page.figure(
        "Warning times", [svg],
        "Of the cracks that break the tooth, the share found when the given number of hours is "
        "left, for each feature with its best detector. The right edge, when the tooth breaks, "
        "is the total share found.",
        blocks.table("Warning times", ["feature", "detector", "found", "median, h",
                                       "90 % at least, h"], rows))


def trade_off(campaign, page):
    figure, axes = _panel_of(len(campaign.data["trade_offs"]))
    rows = []
    for k, one in enumerate(campaign.data["trade_offs"]):
        named = [one["feature"], one["detector"]]
        rows += [[*named, number(point["stated_per_1000_h"]), _hours(point["per_1000_h"]),
                  "–" if point["share"] is None else f"{point['share']:.2f}",
                  campaign.depth_text(point["depth_50_m"]), campaign.depth_text(point["depth_90_m"])]
                 for point in one["points"]]
        if one["points"]:
            plot(axes, [(p["stated_per_1000_h"], campaign.last_mm if p["depth_90_m"] is None else
                         millimetres(p["depth_90_m"])) for p in one["points"]], color=colour(k),
                 linestyle=dash(k), marker=marker(k), markersize=4, markeredgewidth=0, label=", ".join(named))
    data = blocks.table("False alarms and depth at detection",
                        ["feature", "detector", "set to, per 1000 h", "counted", "share found",
                         "50 % found by, mm", "90 % found by, mm"], rows)
    if not rows:
        return blocks.note("The healthy lives are too few for a threshold at any of these rates.") + data
    axes.set(xscale="log", ylim=(0, 1.05 * campaign.last_mm),
             xlabel="False alarms per 1000 hours", ylabel="90 % found by, mm")
    legend_below(axes, 1)
    svg = to_svg(figure, "Depth at detection against false alarms per 1000 hours",
                 "; ".join(f"{one['feature']} by {one['detector']}"
                           for one in campaign.data["trade_offs"]), page.names)
    return page.figure(
        "Depth at detection against false alarms", [svg],
        "Depth by which 90\u00a0% of the cracks are found, for thresholds set to more or fewer "
        "false alarms, for each feature with the detector that is best at the study's rate."
        + (f" Points at {number(campaign.last_mm)} mm, where lives end: fewer are found."
           if any(p["depth_90_m"] is None for one in campaign.data["trade_offs"] for p in one["points"])
           else ""), data)
