"""Figure on the dependence of detection on every random input: rates in bins."""

from blocks import note
from charts import MUTED, colour, panel, to_svg
from detection_figures import best
from words import input_name, noise, percent, quantity, rate_with_bounds, with_unit

MOST_CHARTS = 6


def _effects(report, f, n):
    """Inputs of a feature at a noise level with unit and effect, the most significant first."""
    effects = [(name, entry["unit"], entry["features"][f]["levels"][n])
               for name, entry in (report.reliability.get("robustness") or {}).items() if name != "noise_level"]
    return sorted(effects, key=lambda e: (e[2]["p_value"] is None, e[2]["p_value"] or 0.0,
                                          -(e[2]["statistic"] or 0.0)))


def _clear(effects):
    return [e for e in effects if e[2]["p_value"] is not None and e[2]["p_value"] < 0.05]


def rates_by_input(report, page):
    if not report.reliability.get("robustness"):
        return ""
    f, n = best(report), report.reference
    effects = [e for e in _effects(report, f, n) if e[2]["bins"]]
    shown = (_clear(effects) or effects[:3])[:MOST_CHARTS]
    if not shown:
        return note("No detection rates by input: no random input varies where detection is "
                    "neither certain nor impossible.")
    charts = [_bin_chart(report, page, f, effect) for effect in shown]
    sizes = report.sizes.group(shown[0][2]["size_low"], shown[0][2]["size_high"])
    how = (f"Share of faulty gearboxes of {sizes} that {report.names[f]} finds, in bins of one input "
           f"with equally many gearboxes; lines are Wilson intervals at {percent(report.confidence)}. "
           + report.text(f"effects_text.{n}"))
    return page.figure(f"Detection rate against single inputs at {noise(report.levels[n])}", charts,
                       how, report.table(f"effects.{n}") + report.tables("bins."))


def _bin_chart(report, page, f, effect):
    name, unit, level = effect
    factor, shown = _axis_scale(level["bins"], unit)
    figure, axes = panel(2.6)
    bins = [b for b in level["bins"] if b["pd"] is not None]
    x = [b["middle"] * factor for b in bins]
    y = [b["pd"] for b in bins]

    def lengths(low, middle, high, factor):
        return [[max(0.0, b[end] - b[start]) * factor for b in bins]
                for start, end in ((low, middle), (middle, high))]

    axes.errorbar(x, y, yerr=lengths("lower", "pd", "upper", 1), xerr=lengths("low", "middle", "high", factor),
                  fmt="none", ecolor=MUTED, elinewidth=1)
    axes.plot(x, y, color=colour(0), marker="o", markersize=4.5, linewidth=1)
    axes.set(ylim=(-0.03, 1.03), ylabel="Detection rate",
             xlabel=with_unit(input_name(name, unit).capitalize(), shown, ", "))
    axes.locator_params(axis="x", nbins=6)
    about = "; ".join(f"{quantity(b['middle'], unit)}: "
                      f"{rate_with_bounds(b['pd'], b['lower'], b['upper'])}" for b in bins)
    return to_svg(figure, f"Detection rate of {report.names[f]} against {input_name(name, unit)}",
                  about, page.names)


def _axis_scale(bins, unit):
    """Factor that keeps the numbers of the axis short, and the unit with its prefix."""
    largest = max((abs(b["high"]) for b in bins), default=0.0)
    shown = quantity(1, unit).removeprefix("1").strip()
    if not shown or not (0 < largest < 1e-2 or largest >= 1e4):
        return 1.0, shown
    for factor, prefix in ((1e-9, "G"), (1e-6, "M"), (1e-3, "k"), (1e3, "m"), (1e6, "µ")):
        if largest * factor >= (1 if factor < 1 else 0.1):
            return factor, prefix + shown
    return 1.0, shown
