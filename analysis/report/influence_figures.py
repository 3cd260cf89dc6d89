"""Figures on the influence of random inputs on misses, and on a90 by false-alarm rate."""

import math

from blocks import note
from charts import MUTED, colour, dash, legend_below, marker, panel, to_svg
from words import input_name, joined, noise, number, percent

MOST_CHARTS = 4


def misses(report, page):
    """Inputs of missed gearboxes, one chart for each of the best features that has enough
    misses."""
    n = report.reference
    with_misses = [f for f in report.order(n) if not report.reliable(f, n)["misses"]["refusal"]]
    charts = [_miss_chart(report, page, f) for f in with_misses[:MOST_CHARTS]]
    refused = [f"{report.names[f]} ({report.reliable(f, n)['misses']['refusal']})"
               for f in report.order(n) if report.reliable(f, n)["misses"]["refusal"]]
    left = (note("Not analysed: " + "; ".join(refused) + ".") if refused else "")
    if not charts:
        return note("No feature has enough misses to analyse, at "
                    f"{noise(report.levels[n])}.") + left
    how = ("Probability that a missed gearbox has a larger value of an input than a detected one "
           "with a fault of the same size: right of 0.5 large values hide the fault, left of it "
           "small ones. Lines are intervals at " + percent(report.confidence) +
           "; coloured inputs have a significant influence (5 %, all inputs of a feature "
           "together). Only the influence of single inputs in one direction is shown.")
    return page.figure(f"Inputs of the missed gearboxes at {noise(report.levels[n])}", charts,
                       how, report.tables("miss_inputs.")) + left


def _significant(found):
    return [i for i in found["inputs"] if i["p_value"] is not None and i["p_value"] < 0.05]


def _miss_chart(report, page, f):
    found = report.reliable(f, report.reference)["misses"]
    inputs = found["inputs"]
    strong = {i["name"] for i in _significant(found)}
    figure, axes = panel(1.1 + 0.23 * max(1, len(inputs)))
    axes.axvline(0.5, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    for row, i in enumerate(inputs):
        paint = colour(1) if i["name"] in strong else MUTED
        if i["lower"] is not None and i["upper"] is not None:
            axes.plot([i["lower"], i["upper"]], [row, row], color=paint, linewidth=1.4)
        if i["larger_in_misses"] is not None:
            axes.plot([i["larger_in_misses"]], [row], marker="o" if i["name"] in strong else "D",
                      markersize=4.5, color=paint)
    axes.set_yticks(range(len(inputs)), [input_name(i["name"], i["unit"]) for i in inputs],
                    fontsize=9)
    axes.set(ylim=(len(inputs) - 0.4, -0.6), xlim=(0, 1),
             xlabel="Probability that missed is larger")
    figure.suptitle(f"{report.names[f]}, {_range(report, found)}: {found['misses']} of "
                    f"{found['misses'] + found['hits']} missed", fontsize=10, x=0.01, ha="left")
    texts = [f"{input_name(i['name'], i['unit'])} {number(i['larger_in_misses'], 2)}"
             for i in _significant(found)]
    return to_svg(figure, f"Inputs of the gearboxes that {report.names[f]} misses",
                  "Significant: " + (joined(texts) or "none"), page.names)


def _range(report, found):
    return report.sizes.group(found["smallest"], found["largest"])


def _sizes(points, report, which):
    """Sizes of a bound over the points; NaN where the bound is open."""
    return [report.sizes.shown(p["a90"][which]["size"])
            if p["a90"][which]["where"] == "reached" else math.nan for p in points]


def false_alarm_curves(report, page):
    """a90 over the false-alarm rate, for the best ranked features that have one."""
    n = report.reference
    shown = [f for f in report.order(n)
             if any(p["a90"]["estimate"]["where"] == "reached"
                    for p in report.reliable(f, n)["by_false_alarm_rate"]["points"])][:3]
    if not shown:
        return ""
    figure, axes = panel(3.5)
    for f in shown:
        points = report.reliable(f, n)["by_false_alarm_rate"]["points"]
        rates = [p["false_alarm_rate"] for p in points]
        axes.fill_between(rates, _sizes(points, report, "lower"), _sizes(points, report, "upper"),
                          color=colour(f), alpha=0.16, linewidth=0)
        axes.plot(rates, _sizes(points, report, "estimate"), color=colour(f), linestyle=dash(f),
                  marker=marker(f), markersize=4, label=report.names[f])
    axes.set(xscale="log", xlabel="False-alarm rate", ylabel="a90, " + report.sizes.axis().lower())
    axes.invert_xaxis()
    legend_below(axes, 1, handlelength=2.8)
    svg = to_svg(figure, f"Size found with 90 % probability over the false-alarm rate at "
                 f"{noise(report.levels[n])}",
                 "; ".join(f"{report.names[f]}" for f in shown), page.names)
    how = (f"Shaded: bounds at {percent(report.confidence)} that include the uncertainty of the "
           "threshold. Sizes and bounds outside the tested sizes are not drawn.")
    return page.figure("Detectable size by false-alarm rate, at "
                       f"{noise(report.levels[n])}", [svg], how,
                       report.table(f"false_alarms.{n}"))
