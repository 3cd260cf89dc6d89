"""Numerical error compared with the statistical one."""

from blocks import bullets, note, paragraph, table
from charts import colour, legend_below, panel, to_svg
from words import joined, noise, number, quantity

LEAST = 1e-6  # smaller shares are drawn at this value


def numerical(report, page):
    given = report.data.get("numerical")
    if not given:
        return note("The study requested no check of its numerical error (numerics.verify or "
                    "numerics.tolerance), so it cannot be compared with the statistical error.")
    dominated = [s for s in given["shares"] if s["larger"] == "numerical"]
    text = (f"The run used {given['rung']}; {given['gearboxes']} of its gearboxes were computed "
            f"again with {given['finer']}. ")
    if not dominated:
        text += ("For every feature and noise level the statistical error is larger than the "
                 "numerical error: finer time steps would not help.")
    body = paragraph(text)
    if dominated:
        body += paragraph("The numerical error is larger than the statistical error "
                          "for:") + bullets(f"{s['feature']} at {noise(s['noise_level'])}"
                                            for s in dominated)
    here = [s for s in given["shares"] if s["noise_level"] == report.levels[report.reference]]
    here.sort(key=lambda s: report.order(report.reference).index(
        report.feature_number(s["feature"])))
    charts = [_chart(page, here)] if any(s["pd"] is not None for s in here) else []
    data = _table(report, given["shares"])
    if not charts:
        return body + data
    how = ("Largest change of a detection rate that the numerical error could cause, and largest "
           "half width of the intervals of the same rates, on a logarithmic scale. Where the "
           "second is larger, more gearboxes would help, finer time steps would not. Values "
           f"below {number(LEAST)} are drawn there.")
    return body + page.figure(f"Numerical and statistical error of the detection rates at "
                              f"{noise(report.levels[report.reference])}", charts, how, data)


def _chart(page, shares):
    figure, axes = panel(1.5 + 0.3 * len(shares))
    for key, paint, mark, label in (("pd", colour(1), "s", "numerical"),
                                    ("pd_half_width", colour(0), "o", "statistical")):
        points = [(max(s[key], LEAST), row) for row, s in enumerate(shares) if s[key] is not None]
        axes.plot([x for x, _ in points], [row for _, row in points], linestyle="none", marker=mark,
                  markersize=5, color=paint, label=label)
    axes.set_xscale("log")
    axes.set_xlim(LEAST / 2, 1)
    axes.set_yticks(range(len(shares)), [s["feature"] for s in shares])
    axes.set_ylim(len(shares) - 0.5, -0.5)
    axes.set_xlabel("Error of the detection rate")
    legend_below(axes, 2)
    about = "; ".join(f"{s['feature']}: numerical {number(s['pd'])}, statistical "
                      f"{number(s['pd_half_width'])}" for s in shares)
    return to_svg(figure, "Numerical and statistical error of the detection rates", about,
                  page.names)


def _table(report, shares):
    rows = []
    for s in shares:
        unit = report.unit(s["feature"])
        a90 = "–" if s["a90"] is None else report.sizes.text(s["a90"], 2)
        interval = "–" if s["a90_interval"] is None else report.sizes.text(s["a90_interval"], 2)
        rows.append([s["feature"], noise(s["noise_level"]).removeprefix("noise "),
                     quantity(s["rms"], unit, 2), quantity(s["healthy_spread"], unit, 2),
                     number(s["pd"], 2), number(s["pd_half_width"], 2), a90, interval, s["larger"]])
    return table("Numerical error (rms, of Pd, of a90) and statistical error",
                 ["feature", "noise", "rms", "spread of healthy gearboxes", "of Pd",
                  "half width of Pd", "of a90", "a90 to its bound", "larger"], rows)


def limit(report, name):
    """Sentence for the answer with the two errors of a feature; None if they are not known."""
    for s in (report.data.get("numerical") or {"shares": []})["shares"]:
        if (s["feature"] == name and s["noise_level"] == report.levels[report.reference]
                and s["pd"] is not None and s["pd_half_width"] is not None):
            what = joined([f"at most {number(s['pd'], 2)} numerical",
                           f"±{number(s['pd_half_width'], 2)} statistical"])
            return f"Error of the detection rate: {what}."
    return None
