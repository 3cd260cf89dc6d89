"""Numerical error compared with the statistical one."""

from blocks import paragraph
from charts import colour, legend_below, marks, names_of_rows, panel, to_svg
from words import noise, number

TITLE = "Numerical and statistical error of the detection rates"
LEAST = 1e-6  # smaller shares are drawn at this value


def numerical(report, page):
    body = ("".join(paragraph(text) for key in ("numerical.text", "step_error") if (text := report.text(key)))
            + report.notes("numerical.none"))
    data = report.table("numerical")
    given = report.data.get("numerical") or {"shares": []}
    here = [s for s in given["shares"] if s["noise_level"] == report.levels[report.reference]]
    here.sort(key=lambda s: report.order(report.reference).index(report.feature_number(s["feature"])))
    if not any(s["pd"] is not None for s in here):
        return body + data
    how = ("Largest change of a detection rate that the numerical error could cause, and largest "
           "half width of the intervals of the same rates, on a logarithmic scale. Where the "
           "second is larger, more gearboxes would help, finer time steps would not. Values "
           f"below {number(LEAST)} are drawn there.")
    return body + page.figure(f"{TITLE} at {noise(report.levels[report.reference])}", [_chart(page, here)],
                              how, data)


def _chart(page, shares):
    figure, axes = panel(1.5 + 0.3 * len(shares))
    for key, paint, mark, label in (("pd", colour(1), "s", "numerical"),
                                    ("pd_half_width", colour(0), "o", "statistical")):
        marks(axes, [(max(s[key], LEAST), row) for row, s in enumerate(shares) if s[key] is not None], mark,
              markersize=5, color=paint, label=label)
    names_of_rows(axes, [s["feature"] for s in shares])
    axes.set(xscale="log", xlim=(LEAST / 2, 1), xlabel="Error of the detection rate")
    legend_below(axes, 2)
    about = "; ".join(f"{s['feature']}: numerical {number(s['pd'])}, statistical "
                      f"{number(s['pd_half_width'])}" for s in shares)
    return to_svg(figure, TITLE, about, page.names)
