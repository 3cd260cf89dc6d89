"""Figures on the influence of random inputs on misses, and on a90 by false-alarm rate."""

from blocks import note
from charts import DASHED, MUTED, colour, dash, legend_below, marker, panel, to_svg
from words import input_name, joined, noise, number, percent

MOST_CHARTS = 4


def misses(report, page):
    """Inputs of missed gearboxes, one chart for each of the best features that has enough
    misses."""
    n = report.reference
    at = noise(report.levels[n])
    found = {f: report.reliable(f, n)["misses"] for f in report.order(n)}
    charts = [_miss_chart(report, page, report.names[f], entry)
              for f, entry in [one for one in found.items() if not one[1]["refusal"]][:MOST_CHARTS]]
    refused = "; ".join(f"{report.names[f]} ({entry['refusal']})" for f, entry in found.items()
                        if entry["refusal"])
    left = note(f"Not analysed: {refused}.") if refused else ""
    if not charts:
        return note(f"No feature has enough misses to analyse, at {at}.") + left
    how = ("Probability that a missed gearbox has a larger value of an input than a detected one "
           "with a fault of the same size: right of 0.5 large values hide the fault, left of it "
           "small ones. Lines are intervals at " + percent(report.confidence) +
           "; coloured inputs have a significant influence (5 %, all inputs of a feature "
           "together). Only the influence of single inputs in one direction is shown.")
    return page.figure(f"Inputs of the missed gearboxes at {at}", charts, how,
                       report.tables("miss_inputs.")) + left


def _miss_chart(report, page, name, found):
    inputs = found["inputs"]
    names = [input_name(i["name"], i["unit"]) for i in inputs]
    figure, axes = panel(1.1 + 0.23 * max(1, len(inputs)))
    axes.axvline(0.5, **DASHED)
    significant = []
    for row, i in enumerate(inputs):
        paint, mark = MUTED, "D"
        if i["p_value"] is not None and i["p_value"] < 0.05:
            paint, mark = colour(1), "o"
            significant.append(f"{names[row]} {number(i['larger_in_misses'], 2)}")
        if i["lower"] is not None and i["upper"] is not None:
            axes.plot([i["lower"], i["upper"]], [row, row], color=paint, linewidth=1.4)
        if i["larger_in_misses"] is not None:
            axes.plot([i["larger_in_misses"]], [row], marker=mark, markersize=4.5, color=paint)
    axes.set_yticks(range(len(inputs)), names, fontsize=9)
    axes.set(ylim=(len(inputs) - 0.4, -0.6), xlim=(0, 1), xlabel="Probability that missed is larger")
    figure.suptitle(f"{name}, {report.sizes.group(found['smallest'], found['largest'])}: {found['misses']} of "
                    f"{found['misses'] + found['hits']} missed", fontsize=10, x=0.01, ha="left")
    return to_svg(figure, f"Inputs of the gearboxes that {name} misses",
                  "Significant: " + (joined(significant) or "none"), page.names)


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
        lower, estimate, upper = (report.sizes.reached(points, end) for end in ("lower", "estimate", "upper"))
        axes.fill_between(rates, lower, upper, color=colour(f), alpha=0.16, linewidth=0)
        axes.plot(rates, estimate, color=colour(f), linestyle=dash(f), marker=marker(f), markersize=4,
                  label=report.names[f])
    axes.set(xscale="log", xlabel="False-alarm rate", ylabel="a90, " + report.sizes.axis().lower())
    axes.invert_xaxis()
    legend_below(axes, 1, handlelength=2.8)
    svg = to_svg(figure, f"Size found with 90 % probability over the false-alarm rate at "
                 f"{noise(report.levels[n])}",
                 "; ".join(report.names[f] for f in shown), page.names)
    how = (f"Shaded: bounds at {percent(report.confidence)} that include the uncertainty of the "
           "threshold. Sizes and bounds outside the tested sizes are not drawn.")
    return page.figure("Detectable size by false-alarm rate, at "
                       f"{noise(report.levels[n])}", [svg], how,
                       report.table(f"false_alarms.{n}"))
