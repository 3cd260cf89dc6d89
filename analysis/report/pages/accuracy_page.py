"""Page of gearpod accuracy: error against computing time of every solver setting."""

import math

import blocks
from charts import DOTTED, INK, MUTED, colour, legend_below, marker, marks, names_of_rows, panel, plot, plt, to_svg
from words import count, joined, number, percent, typeset

TIME = "Integration, processor ms per gearbox"
LEAST = 1e-9  # smaller errors are drawn at this value
STYLES = {"double": "-", "single": (0, (4, 2)), "graded": (0, (1, 1)),
          "double, mass scaling": (0, (6, 1, 1, 1)), "single, mass scaling": (0, (3, 1, 1, 1, 1, 1))}


class Accuracy:
    def __init__(self, data):
        self.data = data
        self.measured = [row for row in data["settings"] if "refused" not in row]
        self.by_time = sorted(self.measured, key=lambda row: row["gearbox_s"])
        # Curves: settings with the tightest convergence, by integrator, precision and grid.
        self.curves, self.others = {}, []
        for row in self.measured:
            keys = {text.split("=")[0].removeprefix("numerics.") for text in row["overrides"]}
            if (row["integrator"] == "auto" or row["settle_tolerance"] > 1e-10
                    or keys & {"horizon", "stiffness_tolerance"}):
                self.others.append(row)
            else:
                kind = "graded" if "grid" in keys else row["precision"]
                kind += ", mass scaling" * ("mass_scaling_Hz" in keys)
                self.curves.setdefault((row["integrator"], kind), []).append(row)

    def named(self, name):
        return next((row for row in self.measured if row["name"] == name), None)

    def marked(self):
        """(setting, its meaning, marker) of the settings that a reader looks for."""
        found = [(self.named(self.data["own"]), "setting of the study", "s")]
        if self.data["fastest_within_share"]:
            found.append((self.named(self.data["fastest_within_share"]),
                          f"fastest within {self.data['share_of_scatter']:g} of the scatter", "D"))
        for choice in self.data.get("choices", []):
            if "chosen" in choice:
                found.append((self.named(choice["chosen"]),
                              f"chosen by tolerance = {choice['tolerance']:g}", "o"))
        found += [(row, "every mesh period integrated", "X") for row in self.measured
                  if "numerics.horizon=full" in row["overrides"]]
        return [entry for entry in found if entry[0]]


def _ms(row):
    return 1e3 * row["gearbox_s"]


def _diagram(report, axes, error_of):
    """Draws error against time. `error_of`: error of a setting, or None."""

    def points(rows):
        return [(_ms(row), max(LEAST, error_of(row["error"]))) for row in rows
                if error_of(row["error"]) is not None]

    marks(axes, points(report.others), ".", markersize=4, color=MUTED,
          label="looser convergence, fewer terms")
    integrators = list(dict.fromkeys(name for name, _ in report.curves))
    for (name, kind), rows in report.curves.items():
        k = integrators.index(name)
        plain = kind == "double"
        plot(axes, points(sorted(rows, key=lambda row: row["steps"])), color=colour(k), marker=marker(k),
             markersize=4, linewidth=1.1, linestyle=STYLES[kind],
             markerfacecolor=colour(k) if plain else "none", label=name + ("" if plain else f", {kind}"))
    for at, (row, meaning, mark) in enumerate(report.marked()):
        if error_of(row["error"]) is not None:
            marks(axes, points([row]), mark, markersize=9 + 2.5 * at, markerfacecolor="none",
                  markeredgecolor=INK, markeredgewidth=1.4, label=meaning)
    for peer in report.data.get("peers", []):
        if error_of(peer) is not None:
            marks(axes, points([{**peer, "error": peer}]), "*", markersize=9, color=INK, label=peer["name"])
    # Frontier: settings than which none is both faster and more accurate.
    best, steps = math.inf, []
    for row in report.by_time:
        error = error_of(row["error"])
        if error is not None and error < best:
            best = error
            steps += points([row])
    axes.step(*zip(*steps), where="post", color=INK, linewidth=2.4, alpha=0.35, label="frontier")


def _drawn(report, page, title, error_of, label, lines=(), main=False):
    """Work-precision diagram with horizontal lines (value, meaning). The main one has a legend."""
    if all(error_of(row["error"]) is None for row in report.measured):
        return blocks.note(f"{title}: no setting has an error above zero.")
    figure, axes = plt.subplots(figsize=(5.8, 5.0), layout="tight") if main else panel(3.4)
    _diagram(report, axes, error_of)
    axes.set(xscale="log", yscale="log", xlabel=TIME, ylabel=label)
    for value, meaning in lines:
        axes.axhline(value, **DOTTED)
        axes.annotate(meaning, (0.01, value), xycoords=("axes fraction", "data"), ha="left",
                      va="bottom", fontsize=8, color=MUTED)
    if main:
        limit = report.data["explicit_limit"]
        axes.axvline(_ms(limit), color=MUTED, linewidth=1.0, linestyle=(0, (6, 3)),
                     label="rk4 at its stability limit" + (", refused" * limit["refused"]))
        legend_below(axes, 2)
    else:
        axes.set_title(title.split(":")[0])
    about = "; ".join(f"{meaning}: {row['name']}, {number(_ms(row))} ms, error "
                      f"{number(error_of(row['error']))}" for row, meaning, _ in report.marked())
    return to_svg(figure, title, about, page.names)


def _numbers(values, names):
    return [number(values[name], 2) for name in names]


def _settings_table(report):
    return blocks.table(
        "Measured solver settings, the fastest first",
        ["Setting", "Steps per mesh", "Time, ms", "Worst feature", "Sensor", "TE", "Share of scatter"],
        [[row["name"], count(row["steps"]), number(_ms(row)),
          *_numbers(row["error"], ("worst_feature", "sensor", "te", "worst_of_scatter"))]
         for row in report.by_time])


def _signals(report, page):
    agreement = report.data["reference"]["agreement"]
    charts = [_drawn(report, page, f"{name}: error against time",
                     lambda error, key=key: error[key], "Relative error",
                     [(agreement[key], "agreement of the two references")]
                     if agreement[key] else [])
              for key, name in (("sensor", "Sensor signal"), ("te", "Transmission error"))]
    return page.figure("Error of the signals against time", charts,
                       "Relative L2 error of the noise-free sensor signal, and of the transmission "
                       "error without its mean. Colours and marks as in figure 1.",
                       blocks.paragraph("The numbers are in the table of figure 1."))


def _features(report, page):
    known = any(row["error"]["worst_of_scatter"] is not None for row in report.measured)
    charts = []
    for name in report.measured[0]["error"]["features"]:
        share = known and any(row["error"]["of_scatter"][name] for row in report.measured)
        key = "of_scatter" if share else "features"
        label = "Error over scatter" if share else "Relative error"
        lines = [(report.data["share_of_scatter"], "widens the scatter by 2 %")] if share else []
        charts.append(_drawn(report, page, f"{name}: error against time",
                             lambda error, key=key, name=name: error.get(key, {}).get(name) or None,
                             label, lines))
    text = ("Error of each feature over its standard deviation between healthy gearboxes. Below "
            "the dotted line more gearboxes help, finer steps do not. Colours and marks as in "
            "figure 1." if known else
            "Relative error of each feature. Its scatter between gearboxes was not measured.")
    head = ["Setting", *report.measured[0]["error"]["features"]]
    rows = [[row["name"], *(number(value, 2) for value in row["error"]["features"].values())]
            for row, _, _ in report.marked()]
    return page.figure("Error of each feature against time", charts, text,
                       blocks.table("Relative errors of the marked settings", head, rows))


def _detection(report, page):
    """What the settings change in the answer, next to the statistical error of the pilot."""
    rows = [row for row in report.measured if "detection" in row]
    if not rows:
        return blocks.note("Detection rates were not compared: "
                           "the time was used up, or --gearboxes 0 was given.")
    gearboxes = count(rows[0]["detection"]["gearboxes"])
    charts = []
    for change, spread, label in (("pd_change", "pd_half_width", "detection rate"),
                                  ("a90_change", "a90_interval", "a90, relative")):
        drawn = [row for row in rows if row["detection"][change] is not None]
        if not drawn:
            continue
        figure, axes = panel(3.6)
        for key, k, meaning in ((change, 1, "change by the setting"),
                                (spread, 0, "half width of its interval")):
            marks(axes, [(_ms(row), max(1e-5, row["detection"][key])) for row in drawn
                         if row["detection"][key] is not None], marker(k), color=colour(k), label=meaning)
        axes.set(xscale="log", yscale="log", xlabel=TIME, ylabel=f"Change of the {label}")
        legend_below(axes, 2)
        charts.append(to_svg(figure, f"Change of the {label} against time",
                             f"{len(drawn)} settings", page.names))
    table = blocks.table(
        f"The same {gearboxes} test gearboxes with these settings and with the most accurate one",
        ["Setting", "Time, ms", "Alarms changed", "Pd changed", "Half width", "a90 changed", "a90 interval"],
        [[row["name"], number(_ms(row)), percent(row["detection"]["alarms_changed"]),
          *_numbers(row["detection"], ("pd_change", "pd_half_width", "a90_change", "a90_interval"))]
         for row in rows])
    return page.figure(f"Change of the answer, {gearboxes} test gearboxes", charts,
                       "Largest change over features, sizes and noise levels against the most "
                       "accurate setting, and the statistical uncertainty of the same quantity. "
                       "Changes below 0.00001 are drawn there.", table)


def _effects(report, page):
    """Change and cost of each optional effect, next to the change that matters."""
    rows = report.data.get("effects", [])
    if not rows:
        return blocks.note("The cost of effects was not measured: the time was used up.")
    measured = [row for row in rows if "refused" not in row]
    known = any(row["change"]["worst_of_scatter"] is not None for row in measured)
    key, over = ("worst_of_scatter", "scatter") if known else ("worst_feature", "value")
    drawn = [row for row in measured if row["change"][key]]
    charts = []
    if drawn:
        figure, axes = panel(1.4 + 0.3 * len(drawn))
        for y, row in enumerate(drawn):
            k = 0 if row["in_study"] else 1
            marks(axes, [(max(LEAST, row["change"][key]), y)], marker(k), color=colour(k))
        if known:
            axes.axvline(report.data["share_of_scatter"], label="widens the scatter by 2 %", **DOTTED)
        for k, text in ((0, "left out of the study"), (1, "added to it")):
            marks(axes, [], marker(k), color=colour(k), label=text)
        names_of_rows(axes, [row["effect"] for row in drawn])
        axes.set(xscale="log", xlabel=f"Largest change of a feature over its {over}")
        legend_below(axes, 1)
        charts.append(to_svg(figure, "Change of the features by each effect", "; ".join(
            f"{row['effect']}: {number(row['change'][key])}" for row in drawn), page.names))
    table = blocks.table(
        "The pilot without an effect of the study, or with one that it leaves out",
        ["Effect", "In the study", "Time with / without", "Sensor changes", "Features change",
         "Over scatter", "Needed"],
        [[row["effect"], "yes" if row["in_study"] else "no",
          *(("not possible: " + row["refused"], "–", "–", "–", "–") if "refused" in row else
            (number(row["time_ratio"]),
             *_numbers(row["change"], ("sensor", "worst_feature", "worst_of_scatter")),
             "yes" if row["needed"] else "no"))] for row in rows])
    return page.figure("Change of the features by each effect", charts,
                       "An effect is needed if it changes a feature by more than "
                       f"{report.data['share_of_scatter']:g} of its scatter between healthy "
                       f"gearboxes, or by {report.data['change_of_feature']:g} of its value where "
                       "the scatter was not measured.", table)


def _stability(report, page):
    """Fewest stable steps of explicit methods over the stiffness of the meshes."""
    given = report.data.get("stability")
    if not given:
        return ""
    factors, limit = given["stiffness_factors"], given["most_explicit_steps"]
    figure, axes = panel(3.6)
    for k, curve in enumerate(given["curves"]):
        axes.plot(factors, curve["steps"], color=colour(k), marker=marker(k), markersize=4,
                  linewidth=1.1, label=curve["integrator"])
    axes.axhspan(limit, 10 * limit, color=MUTED, alpha=0.15, label="explicit methods refused")
    marks(axes, [(1.0, given["own_steps"])], "s", markersize=9, markerfacecolor="none",
          markeredgecolor=INK, markeredgewidth=1.4, label=f"the study: {given['own']}")
    axes.set(xscale="log", yscale="log", ylim=(None, 10 * limit),
             xlabel="Stiffness of the meshes over that of the study",
             ylabel="Steps per mesh period")
    legend_below(axes, 2)
    about = "; ".join(f"{curve['integrator']}: {number(curve['steps'][len(factors) // 2])} steps"
                      for curve in given["curves"])
    data = blocks.table("Fewest stable steps per mesh period by the factor on the stiffness",
                        ["Integrator", *(f"x {number(factor)}" for factor in factors[::3])],
                        [[curve["integrator"], *(count(round(steps)) for steps in curve["steps"][::3])]
                         for curve in given["curves"]])
    return page.figure("Stability of explicit methods",
                       [to_svg(figure, "Stability of explicit methods", about, page.names)],
                       "An explicit method is stable above its curve. Implicit methods ("
                       + joined(given["implicit"]) + ") are stable everywhere. Mass scaling lowers "
                       "the curve of central-difference to that of a softer gearbox.", data)


def _limits(report):
    texts = [typeset(f"{row['name']}: {row['refused']}") for row in report.data["settings"] if "refused" in row]
    left = report.data["left_out"]
    return ((blocks.bullets(texts) if texts else "<p>All listed settings were measured.</p>")
            + (blocks.note(f"Omitted because the time was used up: {joined(left)}.") if left else ""))


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    report = Accuracy(data)
    headline = typeset(data["headline"])
    summary = blocks.answer(headline) + blocks.paragraph(
        f"{data['gearboxes']} pilot gearboxes; signals over {data['signal_meshes']} mesh periods, "
        f"features over {count(data['span_meshes'])}. Errors are relative to a reference on which "
        "two independent methods agree to "
        f"{number(data['reference']['agreement']['sensor'], 2)} of the sensor signal.")
    lines = [(choice["tolerance"], f"tolerance {choice['tolerance']:g}")
             for choice in data.get("choices", [])]
    body = page.section(
        "features", "What accuracy costs",
        page.figure("Error of the worst feature against time",
                    [_drawn(report, page, "Error of the worst feature against time",
                            lambda error: error["worst_feature"],
                            "Relative error of the worst feature", lines, main=True)],
                    "One curve per method, precision (dashed: single), grid (dotted: graded steps) and "
                    "mass scaling (dash-dotted), "
                    "from few steps to many. Lower left is better. The broad line is the frontier: no measured "
                    "setting is both faster and more accurate.", _settings_table(report))
        + _features(report, page))
    body += page.section("signals", "Signals", _signals(report, page))
    body += page.section("detection", "Numerical against statistical error",
                         _detection(report, page))
    body += page.section("effects", "Cost of each effect", _effects(report, page))
    body += page.section("stability", "Stability", _stability(report, page))
    body += page.section("limits", "Settings that were not measured", _limits(report))
    return data["title"] or "Accuracy and computing time", headline, summary, body
