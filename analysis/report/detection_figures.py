"""Figures on detection: POD, ROC curve, detection rates over noise, ranking of the features."""

import math

from blocks import note, table
from charts import (GAP, INK, MUTED, PAPER, RULE, between, cell, colour, dash, legend_below, marker,
                    panel, shade, to_svg)
from words import (input_name, joined, noise, number, p_value, percent, rate, rate_with_bounds)

REJECTED = "Dotted: curves that do not fit the hits and misses, without bounds."
POOR = " (poor fit)"
MISSED, FOUND = (0.93, 0.95, 0.98), (0.03, 0.25, 0.48)


def _limits(axes, report):
    largest = max((c["size_high"] for f in report.detection for level in f["levels"]
                   for c in level["sizes"]), default=0)
    axes.set_xlim(0, report.sizes.shown(largest) * 1.03 or 1)
    axes.set_ylim(-0.02, 1.03)
    axes.set_yticks([0, 0.25, 0.5, 0.75, 0.9, 1])
    axes.set_yticklabels(["0", "0.25", "0.5", "0.75", "0.9", "1"])
    axes.set_xlabel(report.sizes.axis())
    axes.set_ylabel("Probability of detection")


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


def epistemic_text(report, n):
    """Text on the epistemic inputs and the range of a90 of the first feature with a band."""
    for f in report.order(n) if report.reliability else []:
        level = report.reliable(f, n)
        found = level["uncertain"]
        if found and not found["refusal"]:
            low, high = (_size(report, found[key], level["hit_miss"])
                         for key in ("a90_low", "a90_high"))
            inputs = joined([input_name(name, "") for name in found["inputs"]])
            return (f"Unknown for this machine: {inputs}. Over the middle 90\u00a0% of their "
                    f"possible values, the size that {report.names[f]} finds with 90\u00a0% "
                    f"probability ranges from {low} to {high}; more gearboxes do not narrow this "
                    "range.")
    return None


def _rates(axes, report, cells, paint, mark, label=None, bars=True):
    points = [c for c in cells if c["pd"] is not None]
    x = [report.sizes.shown(0.5 * (c["size_low"] + c["size_high"])) for c in points]
    y = [c["pd"] for c in points]
    if bars:
        axes.errorbar(x, y, yerr=[[max(0.0, c["pd"] - c["lower"]) for c in points],
                                  [max(0.0, c["upper"] - c["pd"]) for c in points]],
                      fmt="none", ecolor=paint, elinewidth=1, capsize=0)
    axes.plot(x, y, linestyle="none", marker=mark, markersize=4.5, color=paint, label=label,
              markeredgewidth=0)


def _state(report, f, n):
    """Curve of a feature in words, for a description."""
    pod = report.reliable(f, n)["hit_miss"]
    if pod["refusal"]:
        return f"{report.names[f]}: no curve ({pod['refusal']})"
    return f"{report.names[f]}: 90 % at {_size(report, pod['a90']['estimate'], pod)}"


def _size(report, estimate, pod):
    if estimate["where"] == "reached":
        return report.sizes.text(estimate["size"])
    if estimate["where"] == "below_tested":
        return "< " + report.sizes.text(pod["smallest"])
    return "> " + report.sizes.text(pod["largest"])


def _pod_table(report, n):
    rows = []
    for f in report.order(n):
        level = report.reliable(f, n)
        pod = level["hit_miss"]
        if pod["refusal"]:
            rows.append([report.names[f], "–", "–", "–", f"no curve: {pod['refusal']}"])
            continue
        fit = pod["fit"]["p_value"]
        rows.append([report.names[f], _size(report, pod["a50"]["estimate"], pod),
                     _size(report, pod["a90"]["estimate"], pod),
                     _size(report, pod["a90"]["upper"], pod),
                     f"{pod['model']}; fit p {p_value(fit)}"
                     + (" (rejected)" if pod["doubtful"] else "")])
    bound = f"a90/{number(100 * report.confidence)}"
    return table(f"POD curves at {noise(report.levels[n])}",
                 ["feature", "a50", "a90", bound, "curve"], rows)


def _rate_table(report, f):
    head = ["size"] + [f"× {number(level)}" for level in report.levels]
    rows = []
    for i, group in enumerate(report.cells(f, 0)):
        row = [report.sizes.group(group["size_low"], group["size_high"])]
        for n in range(len(report.levels)):
            c = report.cells(f, n)[i]
            row.append(rate_with_bounds(c["pd"], c["lower"], c["upper"])
                       + (f" ({c['failed']} without value)" if c["failed"] else ""))
        rows.append(row)
    return table(f"{report.names[f]}: detection rate, with Wilson bounds, by noise", head, rows)


def _comparison(report, page):
    n = report.reference
    labels = [name + (POOR if report.reliable(f, n)["hit_miss"]["doubtful"] else "")
              for f, name in enumerate(report.names)]
    columns = 2 if max(map(len, labels)) < 20 else 1
    figure, axes = panel(3.3 + 0.2 * math.ceil(len(report.names) / columns))
    axes.axhline(0.9, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    for position, f in enumerate(report.order(n)):
        level = report.reliable(f, n)
        drawn = _curve(axes, report, level["hit_miss"], colour(f), dash(f), report.names[f],
                       band=position < 3)
        if position == 0:
            _open(axes, report, level, colour(f))
        _rates(axes, report, [c for c in report.cells(f, n) if c["size_high"] > 0], colour(f),
               marker(f), None if drawn else report.names[f] + " (rates)", bars=not drawn)
    found = report.smallest_fault(n)
    if found:
        x = report.sizes.shown(found["size"])
        axes.plot([x, x], [-0.02, 0.9], color=INK, linewidth=1)
        axes.annotate(report.sizes.text(found["size"]), (x, 0.02), xytext=(4, 0),
                      textcoords="offset points", fontsize=9, color=INK,
                      bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 1.2, "alpha": 0.85})
    _limits(axes, report)
    legend_below(axes, columns, handlelength=2.8)
    about = "; ".join(_state(report, f, n) for f in report.order(n))
    svg = to_svg(figure, f"Probability of detection of every feature at "
                 f"{noise(report.levels[n])}", about, page.names)
    bound = f"a90/{number(100 * report.confidence)}"
    how = ("Each curve is fitted to the hits and misses of single gearboxes; marks are observed "
           "detection rates. Shaded, for the three best ranked: bounds, each one-sided at "
           f"{percent(report.confidence)}. {REJECTED} {bound} is the size at which the lower "
           "bound passes 0.9 (dashed); "
           + ("the vertical line is the smallest fault found by any feature." if found
              else "no feature reaches it."))
    unknown = epistemic_text(report, n)
    if unknown:
        how += f" Hatched, for the best ranked: {unknown[0].lower()}{unknown[1:]}"
    return page.figure(f"Probability of detection at {noise(report.levels[n])}", [svg], how,
                       _pod_table(report, n))


def of_feature(axes, report, f):
    """Draws the rates of a feature at all noise levels, with the curves where they exist."""
    axes.axhline(0.9, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    for n, level in enumerate(report.levels):
        paint = shade(n / max(1, len(report.levels) - 1))
        if report.reliability:
            reliable = report.reliable(f, n)
            _curve(axes, report, reliable["hit_miss"], paint, "-", None, band=True)
            _open(axes, report, reliable, paint)
        _rates(axes, report, [c for c in report.cells(f, n) if c["size_high"] > 0], paint,
               marker(n), f"× {number(level)}")
    _limits(axes, report)
    axes.set_title(report.names[f], fontsize=10, loc="left")
    if report.levels:
        axes.legend(title="noise", loc="best", title_fontsize=9, handletextpad=0.2)


def _by_feature(report, page):
    charts, tables = [], []
    for f in report.order(report.reference):
        figure, axes = panel()
        of_feature(axes, report, f)
        states = "; ".join(f"{noise(level)}: {_state(report, f, n).split(': ', 1)[1]}"
                           for n, level in enumerate(report.levels))
        charts.append(to_svg(figure, f"Probability of detection of {report.names[f]} by noise",
                             states, page.names))
        tables.append(_rate_table(report, f))
    refused = [f"{report.names[f]} at {noise(level)}"
               for f in report.order(report.reference) for n, level in enumerate(report.levels)
               if report.reliable(f, n)["hit_miss"]["refusal"]]
    how = ("Marks are detection rates with their Wilson bounds, at "
           f"{percent(report.confidence)}; lines are the fitted curves with their bounds, from blue "
           "for the least noise to red for the most. " + REJECTED
           + (f" There is no curve for {joined(refused)}: the reasons are listed with the numbers."
              if refused else ""))
    reasons = table("Fitted curves", ["feature", "noise", "a50", "a90",
                                      f"a90/{number(100 * report.confidence)}", "curve"],
                    [[report.names[f], f"× {number(level)}"] + _curve_cells(report, f, n)
                     for f in report.order(report.reference)
                     for n, level in enumerate(report.levels)])
    return page.figure("Probability of detection by feature and noise", charts, how,
                       reasons + "".join(tables))


def _curve_cells(report, f, n):
    pod = report.reliable(f, n)["hit_miss"]
    if pod["refusal"]:
        return ["–", "–", "–", f"none: {pod['refusal']}"]
    return [_size(report, pod["a50"]["estimate"], pod), _size(report, pod["a90"]["estimate"], pod),
            _size(report, pod["a90"]["upper"], pod),
            pod["model"] + (" (fit rejected)" if pod["doubtful"] else "")]


def heat_maps(report, page):
    """Detection rates over noise and size."""
    charts = []
    for f in report.order(report.reference):
        cells = [report.cells(f, n) for n in range(len(report.levels))]
        sizes = [report.sizes.group(c["size_low"], c["size_high"]).replace(
            f"\u00a0{report.sizes.unit}", "") for c in cells[0]]
        figure, axes = panel(0.95 + 0.36 * len(cells))
        axes.grid(False)
        for n, row in enumerate(cells):
            for i, c in enumerate(row):
                known = c["pd"] is not None
                cell(axes, i, n, between(MISSED, FOUND, c["pd"]) if known else GAP, rate(c["pd"]))
        axes.set_xlim(0, max(1, len(sizes)))
        axes.set_ylim(0, max(1, len(cells)))
        axes.set_xticks([i + 0.5 for i in range(len(sizes))], sizes,
                        rotation=40 if any(len(s) > 5 for s in sizes) else 0)
        axes.set_yticks([n + 0.5 for n in range(len(cells))],
                        [f"× {number(level)}" for level in report.levels])
        axes.tick_params(length=0)
        axes.set_xlabel(report.sizes.axis())
        axes.set_ylabel("noise")
        axes.set_title(report.names[f], fontsize=10, loc="left")
        about = "; ".join(
            f"{noise(level)}: " + ", ".join(rate(c["pd"]) for c in cells[n])
            for n, level in enumerate(report.levels))
        charts.append(to_svg(figure, f"Detection rate of {report.names[f]} over noise and size",
                             about, page.names))
    how = ("Share of gearboxes that raise an alarm, by fault size (horizontal) and noise "
           "(vertical); dark means that many are found. A column of size 0 shows false alarms.")
    return page.figure("Detection rate over noise and fault size", charts, how,
                       "".join(_rate_table(report, f) for f in report.order(report.reference)))


def roc(report, page):
    """ROC curves, one chart per noise level."""
    charts, rows = [], []
    for n, level in enumerate(report.levels):
        figure, axes = panel(3.9)
        axes.plot([0, 1], [0, 1], color=RULE, linewidth=1)
        axes.axvline(report.data["detection"]["false_alarm_rate"], color=MUTED, linewidth=0.9,
                     linestyle=(0, (4, 3)))
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
            rows.append([f"× {number(level)}", report.names[f],
                         rate_3(auc["auc"], auc["lower"], auc["upper"]), str(auc["healthy"]),
                         str(auc["faulty"])])
        axes.set_xlim(-0.01, 1.01)
        axes.set_ylim(-0.01, 1.02)
        axes.set_xlabel("False-alarm rate")
        axes.set_ylabel("Detection rate")
        axes.set_title(f"noise × {number(level)}", fontsize=10, loc="left")
        if axes.get_legend_handles_labels()[0]:
            axes.legend(loc="lower right", title="feature, area", title_fontsize=9,
                        handlelength=2.4, labelspacing=0.25)
        charts.append(to_svg(figure, f"Receiver operating characteristic at {noise(level)}",
                             "; ".join(texts), page.names))
    how = ("Each threshold gives one point; closer to the upper left corner is better. The grey "
           "diagonal is guessing; the dashed line is the false-alarm rate of the study. All fault "
           "sizes are combined, so areas compare features but depend on the simulated sizes.")
    data = table("Areas below the curves, with DeLong's intervals",
                 ["noise", "feature", "area", "healthy", "faulty"], rows)
    return page.figure("Receiver operating characteristic", charts, how, data)


def rate_3(value, lower, upper):
    if value is None:
        return "–"
    if lower is None or upper is None:
        return f"{value:.3f}"
    return f"{value:.3f} [{lower:.3f}, {upper:.3f}]"


def ranking(report, page):
    """Areas of all features and noise levels, with intervals."""
    order = report.order(report.reference)
    levels = len(report.levels)
    figure, axes = panel(1.5 + 0.42 * max(1, len(order)))
    axes.axvline(0.5, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    for n, level in enumerate(report.levels):
        offset = 0.0 if levels < 2 else 0.56 * (n / (levels - 1) - 0.5)
        points = [(i, report.reliable(f, n)["auc"]) for i, f in enumerate(order)]
        points = [(i, auc) for i, auc in points if auc["auc"] is not None]
        paint = shade(n / max(1, levels - 1))
        for i, auc in points:
            if auc["lower"] is not None:
                axes.plot([auc["lower"], auc["upper"]], [i + offset] * 2, color=paint, linewidth=1.6)
        axes.plot([auc["auc"] for _, auc in points], [i + offset for i, _ in points],
                  linestyle="none", marker=marker(n), markersize=4.5, color=paint,
                  label=f"× {number(level)}")
    axes.set_yticks(range(len(order)), [report.names[f] for f in order])
    axes.set_ylim(len(order) - 0.45, -0.55)
    axes.set_xlabel("Area under the ROC")
    if levels:
        legend_below(axes, min(levels, 5), title="noise", title_fontsize=9, handletextpad=0.1,
                     columnspacing=1)
    ranks = report.reliability["levels"][report.reference]["ranking"]
    about = "; ".join(f"{r['name']} {rate_3(r['auc'], r['lower'], r['upper'])}"
                      for r in ranks["ranks"]) or str(ranks["refusal"])
    svg = to_svg(figure, f"Ranking of the features, by area under the ROC at "
                 f"{noise(report.levels[report.reference])}", about, page.names)
    how = ("Probability that a faulty gearbox lies further to the alarm side than a healthy one: "
           "1 is perfect separation, 0.5 is chance. Best at the top, ranked at "
           f"{noise(report.levels[report.reference])}; lines are DeLong's intervals at "
           f"{percent(report.confidence)}. {_tie(report)}")
    return page.figure("Ranking of the features", [svg], how, _ranking_tables(report))


def _tie(report):
    ranking_ = report.reliability["levels"][report.reference]["ranking"]
    if ranking_["refusal"]:
        return f"No ranking: {ranking_['refusal']}."
    ranks = ranking_["ranks"]
    if len(ranks) < 2:
        return ""
    same = [ranks[i]["name"] for i in range(1, len(ranks))
            if ranks[0]["p_values"][i] is None or ranks[0]["p_values"][i] >= 0.05]
    if same:
        return f"{ranks[0]['name']} has the largest area, not significantly above {joined(same)}."
    return f"{ranks[0]['name']} has the largest area, significantly larger than all others."


def _ranking_tables(report):
    out = ""
    for n, level in enumerate(report.levels):
        ranking_ = report.reliability["levels"][n]["ranking"]
        if ranking_["refusal"]:
            out += note(f"No ranking at {noise(level)}: {ranking_['refusal']}.")
            continue
        rows = [[str(i + 1), r["name"], rate_3(r["auc"], r["lower"], r["upper"]),
                 "" if i == 0 else p_value(ranking_["ranks"][0]["p_values"][i])]
                for i, r in enumerate(ranking_["ranks"])]
        out += table(f"Ranking at {noise(level)}, {ranking_['healthy']} healthy and "
                     f"{ranking_['faulty']} faulty gearboxes",
                     ["rank", "feature", "area", "p against the first"], rows)
        out += "".join(note(f"Not ranked: {line}") for line in ranking_["left_out"])
    return out


def pod(report, page):
    return _comparison(report, page) + _by_feature(report, page)


def over_time(report, page, groups):
    """Share of recordings with an alarm over time, for the three best features."""
    names = [report.names[f] for f in report.order(report.reference)[:3]]
    middle = [0.5 * (group["first"] + group["last"]) for group in groups]

    def caption_text(group, name):
        alarms = group["alarms"][name]
        return "-" if alarms is None else f"{alarms} of {group['values'][name]}"

    figure, axes = panel(3.4)
    for position, name in enumerate(names):
        share = [math.nan if group["alarms"][name] is None else
                 group["alarms"][name] / group["values"][name] for group in groups]
        axes.plot(middle, share, color=colour(position), linestyle=dash(position),
                  marker=marker(position), markersize=4.5, markeredgewidth=0, label=name)
    axes.set_ylim(-0.03, 1.03)
    axes.set_xlabel("Time")
    axes.set_ylabel("Share of recordings that alarm")
    legend_below(axes, 1)
    about = "; ".join(f"{name}: {caption_text(groups[-1], name)} at the end" for name in names)
    svg = to_svg(figure, "Alarms over time", about, page.names)
    rows = [[number(group["first"]) if group["first"] == group["last"]
             else f"{number(group['first'])} to {number(group['last'])}", str(group["recordings"])]
            + [f"{caption_text(group, name)} ({number(group['medians'][name])})" for name in names]
            for group in groups]
    return page.figure("Alarms over time", [svg], "All recordings with a value of the "
                       "feature, against the thresholds that the healthy recordings set.",
                       table("Alarms, and the feature's median", ["time", "recordings"] + names,
                             rows))
