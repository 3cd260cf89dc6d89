"""Which random inputs decide what is missed, and numerical against statistical error."""

from blocks import note, paragraph, table
from charts import MUTED, colour, panel, to_svg
from headline import influences
from words import input_name, joined, noise, number, p_value, percent, quantity, rate_with_bounds

MOST_CHARTS = 4


def misses(report, page):
    """One chart for each of the best features that has misses to look at."""
    n = report.reference
    with_misses = [f for f in report.order(n) if not report.reliable(f, n)["misses"]["refusal"]]
    charts = [_miss_chart(report, page, f) for f in with_misses[:MOST_CHARTS]]
    refused = [f"{report.names[f]} ({report.reliable(f, n)['misses']['refusal']})"
               for f in report.order(n) if report.reliable(f, n)["misses"]["refusal"]]
    left = (note("Not looked at: " + "; ".join(refused) + ".") if refused else "")
    if not charts:
        return note(f"No feature has misses to look at, at {noise(report.levels[n])}.") + left
    tables = "".join(_miss_table(report, f, k) for f in range(len(report.names))
                     for k in range(len(report.levels))
                     if not report.reliable(f, k)["misses"]["refusal"])
    how = ("Chance that a missed gearbox has the larger value of an input than a detected one with a "
           "fault of the same size: right of 0.5, large values hide the fault, left of it small "
           "ones. Lines are intervals at " + percent(report.confidence) + "; coloured inputs are "
           "told apart from chance (5 %, all inputs of a feature together). Only one input at a "
           "time, and only an influence in one direction, shows here.")
    return page.figure(f"What the missed gearboxes are like at {noise(report.levels[n])}", charts,
                       how, tables) + left


def _miss_chart(report, page, f):
    found = report.reliable(f, report.reference)["misses"]
    inputs = found["inputs"]
    strong = {i["name"] for i in influences(found)}
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
    axes.set_ylim(len(inputs) - 0.4, -0.6)
    axes.set_xlim(0, 1)
    axes.set_xlabel("Chance that the missed has the larger")
    figure.suptitle(f"{report.names[f]}, {_range(report, found)}: {found['misses']} of "
                    f"{found['misses'] + found['hits']} missed", fontsize=10, x=0.01, ha="left")
    texts = [f"{input_name(i['name'], i['unit'])} {number(i['larger_in_misses'], 2)}"
             for i in influences(found)]
    return to_svg(figure, f"Inputs of the gearboxes that {report.names[f]} misses",
                  "Told apart from chance: " + (joined(texts) or "none"), page.names)


def _range(report, found):
    return report.sizes.group(found["smallest"], found["largest"])


def _miss_table(report, f, n):
    found = report.reliable(f, n)["misses"]
    rows = [[input_name(i["name"], i["unit"]),
             rate_with_bounds(i["larger_in_misses"], i["lower"], i["upper"]),
             p_value(i["p_value"])] for i in found["inputs"]]
    return table(f"{report.names[f]} at {noise(report.levels[n])}, {_range(report, found)}: "
                 f"{found['misses']} of {found['misses'] + found['hits']} missed",
                 ["input", "chance that the missed has the larger", "p, adjusted"], rows)


def conditions(report):
    """Thresholds for each value of one input, where the report was asked for them."""
    given = (report.reliability or {}).get("conditions") or []
    if not given:
        return ""
    name = input_name(given[0]["input"], given[0]["unit"])
    refusals = {d["refusal"] for d in given if d["refusal"]}
    out = "".join(note(f"No thresholds by {name}: {reason}.") for reason in sorted(refusals))
    for detection in given:
        for level in detection["levels"]:
            thresholds = ", ".join(
                f"{quantity(t['condition'], detection['unit'])}: "
                f"{quantity(t['threshold'], report.unit(detection['feature']), 4)}"
                for t in level["thresholds"])
            rows = [[report.sizes.group(c["size_low"], c["size_high"]),
                     rate_with_bounds(c["pd"], c["lower"], c["upper"])] for c in level["sizes"]]
            out += table(f"{detection['feature']} at {noise(level['noise_level'])}; thresholds at "
                         f"{name} {thresholds}", ["size", "detection rate"], rows)
        out += "".join(note(f"{detection['feature']}: {warning}")
                       for warning in detection["warnings"])
    return paragraph(f"Every value of {name} has a threshold of its own, from healthy gearboxes with "
                     "that value.") + out
