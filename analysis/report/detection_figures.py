"""Figures on detection: POD, ROC curve, ranking of the features."""

import math

from charts import (DASHED, RULE, colour, dash, legend_below, mark_size, marker, marks, panel, shade, to_svg)
from words import joined, noise, number, percent, rate

REJECTED = "Dotted: curves that do not fit the hits and misses, without bounds."
POOR = " (poor fit)"
MOST_INSIDE = 12  # entries of a legend within the axes


def _limits(axes, report):
    largest = max((c["size_high"] for f in report.detection for level in f["levels"]
                   for c in level["sizes"]), default=0)
    axes.set(xlim=(0, report.sizes.shown(largest) * 1.03 or 1), ylim=(-0.02, 1.03),
             xlabel=report.sizes.axis(), ylabel="Probability of detection")
    axes.set_yticks([0, 0.25, 0.5, 0.75, 0.9, 1], ["0", "0.25", "0.5", "0.75", "0.9", "1"])


def _curve(axes, report, pod, paint, line, label, band):
    if pod["refusal"] or not pod["band"]["size"]:
        return False
    x = [report.sizes.shown(size) for size in pod["band"]["size"]]
    # The curve may begin where its bounds begin; missing bounds are gaps.
    lower, upper, values = ([math.nan if value is None else value for value in pod["band"][name]]
                            for name in ("lower", "upper", "pod"))
    poor = pod["doubtful"]  # its bounds are not valid
    if band and not poor:
        axes.fill_between(x, lower, upper, color=paint, alpha=0.16, linewidth=0)
    axes.plot(x, values, color=paint, linestyle=(0, (1, 2)) if poor else line,
              linewidth=0.9 if poor else None, label=label + POOR if poor and label else label)
    return True


def _open(axes, report, level, paint):
    """Draws the band due to epistemic inputs."""
    if level["uncertain"] and level["uncertain"]["band"]["size"]:
        band = level["uncertain"]["band"]
        axes.fill_between([report.sizes.shown(size) for size in band["size"]], band["lower"],
                          band["upper"], facecolor="none", edgecolor=paint, hatch="///",
                          linewidth=0, alpha=0.6)


def _rates(axes, report, f, n, paint, mark, label=None, bars=True):
    """Draws the detection rates of a feature's fault sizes at a noise level."""
    points = [c for c in report.cells(f, n) if c["size_high"] > 0 and c["pd"] is not None]
    x = [report.sizes.shown(0.5 * (c["size_low"] + c["size_high"])) for c in points]
    y = [c["pd"] for c in points]
    if bars:
        axes.errorbar(x, y, yerr=[[max(0.0, c["pd"] - c["lower"]) for c in points],
                                  [max(0.0, c["upper"] - c["pd"]) for c in points]],
                      fmt="none", ecolor=paint, elinewidth=1, capsize=0)
    marks(axes, list(zip(x, y)), mark, markersize=4.5, color=paint, label=label, markeredgewidth=0)


def _state(report, f, n):
    """Curve of a feature in words, for a description."""
    pod = report.reliable(f, n)["hit_miss"]
    if pod["refusal"]:
        return f"{report.names[f]}: no curve ({pod['refusal']})"
    return f"{report.names[f]}: 90 % at {report.sizes.estimate(pod['a90']['estimate'], pod, report.sizes.text)}"


def _found(axes, report, found):
    """Draws the smallest fault found."""
    mark_size(axes, report.sizes.shown(found["size"]), report.sizes.text(found["size"]), 0.02)


def best(report):
    """Number of the feature in the answer."""
    return report.feature_number(report.data["best_feature"])


def headline(report, page):
    """POD curve with its bounds of the feature in the answer, at the reference level."""
    n, f = report.reference, best(report)
    figure, axes = panel(2.5)
    axes.axhline(0.9, **DASHED)
    if report.curves:
        level = report.reliable(f, n)
        _curve(axes, report, level["hit_miss"], colour(0), "-", None, band=True)
        _open(axes, report, level, colour(0))
    _rates(axes, report, f, n, colour(0), "o")
    if report.smallest[n]:
        _found(axes, report, report.smallest[n])
    _limits(axes, report)
    return to_svg(figure, f"Probability of detection by {report.names[f]}", report.text("figure"),
                  page.names)


def comparison(report, page):
    n = report.reference
    labels = [name + (POOR if report.reliable(f, n)["hit_miss"]["doubtful"] else "")
              for f, name in enumerate(report.names)]
    columns = 2 if max(map(len, labels)) < 20 else 1
    figure, axes = panel(3.3 + 0.2 * math.ceil(len(report.names) / columns))
    axes.axhline(0.9, **DASHED)
    for position, f in enumerate(report.order(n)):
        level = report.reliable(f, n)
        drawn = _curve(axes, report, level["hit_miss"], colour(f), dash(f), report.names[f],
                       band=position < 3)
        if position == 0:
            _open(axes, report, level, colour(f))
        _rates(axes, report, f, n, colour(f),
               marker(f), None if drawn else report.names[f] + " (rates)", bars=not drawn)
    found = report.smallest[n]
    if found:
        _found(axes, report, found)
    _limits(axes, report)
    legend_below(axes, columns, handlelength=2.8)
    about = "; ".join(_state(report, f, n) for f in report.order(n))
    svg = to_svg(figure, f"Probability of detection of every feature at "
                 f"{noise(report.levels[n])}", about, page.names)
    bound = f"a90/{number(100 * report.confidence, 6)}"
    how = ("Each curve is fitted to the hits and misses of single gearboxes; marks are observed "
           "detection rates. Shaded, for the three best ranked: bounds, each one-sided at "
           f"{percent(report.confidence)}. {REJECTED} {bound} is the size at which the lower "
           "bound passes 0.9 (dashed); "
           + ("the vertical line is the smallest fault found by any feature." if found
              else "no feature reaches it."))
    unknown = report.text(f"unknown.{n}")
    if unknown:
        how += f" Hatched, for the best ranked: the epistemic inputs. {unknown}"
    return page.figure(f"Probability of detection at {noise(report.levels[n])}", [svg], how,
                       report.table(f"curves.{n}") + report.table(f"responses.{n}")
                       + report.notes(f"responses_refused.{n}"))


def of_feature(axes, report, f):
    """Draws the rates of a feature at all noise levels, with the curves where they exist."""
    axes.axhline(0.9, **DASHED)
    for n, level in enumerate(report.levels):
        paint = shade(n / max(1, len(report.levels) - 1))
        if report.reliability:
            reliable = report.reliable(f, n)
            _curve(axes, report, reliable["hit_miss"], paint, "-", None, band=True)
            _open(axes, report, reliable, paint)
        _rates(axes, report, f, n, paint,
               marker(n), f"× {number(level)}")
    _limits(axes, report)
    axes.set_title(report.names[f], fontsize=10, loc="left")
    if report.levels:
        axes.legend(title="noise", loc="best", title_fontsize=9, handletextpad=0.2)


def by_feature(report, page):
    """Detection rates over size at every noise level, with the curves where they exist."""
    charts = []
    for f in report.order(report.reference):
        figure, axes = panel()
        of_feature(axes, report, f)
        rates = "; ".join(f"{noise(level)}: " + ", ".join(rate(c["pd"]) for c in report.cells(f, n))
                          for n, level in enumerate(report.levels))
        charts.append(to_svg(figure, f"Probability of detection of {report.names[f]} by noise",
                             rates, page.names))
    refused = [f"{report.names[f]} at {noise(level)}"
               for f in report.order(report.reference) for n, level in enumerate(report.levels)
               if report.curves and report.reliable(f, n)["hit_miss"]["refusal"]]
    how = ("Marks are detection rates with their Wilson bounds, at "
           f"{percent(report.confidence)}, from blue for the least noise to red for the most"
           + ("; lines are the fitted curves with their bounds. " + REJECTED if report.curves else ".")
           + (f" There is no curve for {joined(refused)}: the reasons are listed with the numbers."
              if refused else ""))
    return page.figure("Probability of detection by feature and noise", charts, how,
                       report.tables("rates.") + report.tables("curves."))


def roc(report, page):
    """ROC curves, one chart per noise level."""
    charts = []
    inside = len(report.names) <= MOST_INSIDE
    for n, level in enumerate(report.levels):
        figure, axes = panel(3.9 if inside else 3.9 + 0.2 * len(report.names))
        axes.plot([0, 1], [0, 1], color=RULE, linewidth=1)
        axes.axvline(report.data["detection"]["false_alarm_rate"], **DASHED)
        texts = []
        for f in report.order(n):
            reliable = report.reliable(f, n)
            if not reliable["roc"]["false_alarm_rate"]:
                texts.append(f"{report.names[f]}: none")
                continue
            auc = reliable["auc"]
            axes.plot(reliable["roc"]["false_alarm_rate"], reliable["roc"]["detection_rate"],
                      color=colour(f), linestyle=dash(f),
                      label=f"{report.names[f]}  {number(auc['auc'])}")
            texts.append(f"{report.names[f]}: area {number(auc['auc'])}")
        axes.set(xlim=(-0.01, 1.01), ylim=(-0.01, 1.02), xlabel="False-alarm rate",
                 ylabel="Detection rate")
        axes.set_title(f"noise × {number(level)}", fontsize=10, loc="left")
        if axes.get_legend_handles_labels()[0]:
            options = {"title": "feature, area", "title_fontsize": 9, "handlelength": 2.4,
                       "labelspacing": 0.25}
            if inside:
                axes.legend(loc="lower right", **options)
            else:
                legend_below(axes, 1, **options)
        charts.append(to_svg(figure, f"Receiver operating characteristic at {noise(level)}",
                             "; ".join(texts), page.names))
    how = ("Each threshold gives one point; closer to the upper left corner is better. The grey "
           "diagonal is guessing; the dashed line is the false-alarm rate of the study. All fault "
           "sizes are combined, so areas compare features but depend on the simulated sizes.")
    return page.figure("Receiver operating characteristic", charts, how,
                       report.tables("curves."))


def area_text(area):
    if area["auc"] is None:
        return "–"
    if area["lower"] is None or area["upper"] is None:
        return f"{area['auc']:.3f}"
    return f"{area['auc']:.3f} [{area['lower']:.3f}, {area['upper']:.3f}]"


def ranking(report, page):
    """Areas of all features and noise levels, with intervals."""
    order = report.order(report.reference)
    levels = len(report.levels)
    figure, axes = panel(1.5 + 0.42 * max(1, len(order)))
    axes.axvline(0.5, **DASHED)
    for n, level in enumerate(report.levels):
        offset = 0.0 if levels < 2 else 0.56 * (n / (levels - 1) - 0.5)
        points = [(i, report.reliable(f, n)["auc"]) for i, f in enumerate(order)]
        points = [(i, auc) for i, auc in points if auc["auc"] is not None]
        paint = shade(n / max(1, levels - 1))
        for i, auc in points:
            if auc["lower"] is not None:
                axes.plot([auc["lower"], auc["upper"]], [i + offset] * 2, color=paint, linewidth=1.6)
        marks(axes, [(auc["auc"], i + offset) for i, auc in points], marker(n), markersize=4.5, color=paint,
              label=f"× {number(level)}")
    axes.set_yticks(range(len(order)), [report.names[f] for f in order])
    axes.set(ylim=(len(order) - 0.45, -0.55), xlabel="Area under the ROC")
    if levels:
        legend_below(axes, min(levels, 5), title="noise", title_fontsize=9, handletextpad=0.1,
                     columnspacing=1)
    ranks = report.reliability["levels"][report.reference]["ranking"]
    about = "; ".join(f"{r['name']} {area_text(r)}"
                      for r in ranks["ranks"]) or str(ranks["refusal"])
    svg = to_svg(figure, f"Ranking of the features, by area under the ROC at "
                 f"{noise(report.levels[report.reference])}", about, page.names)
    how = ("Probability that a faulty gearbox lies further to the alarm side than a healthy one: "
           "1 is perfect separation, 0.5 is chance. Best at the top, ranked at "
           f"{noise(report.levels[report.reference])}; lines are DeLong's intervals at "
           f"{percent(report.confidence)}. {report.text(f'ranking.{report.reference}')}")
    return page.figure("Ranking of the features", [svg], how,
                       report.tables("ranks.") + report.notes("unranked."))
