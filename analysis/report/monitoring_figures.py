"""Figures on recordings monitored one after another: indicators, teeth and alarms over the records."""

import math
from functools import partial

import numpy
from charts import INK, MUTED, PAPER, colour, dash, legend_below, panel, to_svg
from words import number

MOST = 4  # features in a chart


def _single(watched, name):
    """Result of the detector `single`, or of the first one, for a feature."""
    own = [one for one in watched if one["feature"] == name]
    return next((one for one in own if one["detector"] == "single"), own[0])


def _boundary(axes, series, paint):
    """Draws a line before the first recording that is not known as healthy."""
    if not all(series["healthy"]):
        axes.axvline([*map(bool, series["healthy"])].index(False) + 0.5, color=paint, linewidth=0.9,
                     linestyle=(0, (2, 2)))


def _title(text, series):
    return f"{text} of {series['name']}" if series["name"] else text


def _draw_indicators(axes, monitoring, series, names):
    """Draws the indicators; returns the sustained alarms in words."""
    about = []
    for position, name in enumerate(names):
        values = [math.nan if value is None else value for value in series["deviations"][name]]
        axes.plot(range(1, len(values) + 1), values, color=colour(position),
                  linestyle=dash(position), linewidth=1, label=name)
        one = _single(monitoring["watched"], name)
        if one["detector"] == "single" and one["threshold"] is not None:
            axes.axhline(one["threshold"], color=colour(position), linewidth=0.7)
        gearbox = next((its for its in one["gearboxes"] if its["name"] == series["name"]), None)
        if gearbox and gearbox["sustained"]:
            at = series["rows"].index(gearbox["sustained"]["row"])
            axes.plot([at + 1], [values[at]], marker="v", markersize=8, color=colour(position),
                      markeredgecolor=INK, linestyle="none")
            about.append(f"{name}: sustained alarm at recording {at + 1}")
    axes.set_yscale("symlog", linthresh=3)
    _boundary(axes, series, MUTED)
    axes.set(xlabel="Recording, in time order",
             ylabel="Deviation from the first recordings,\nstandard deviations")
    return "; ".join(about) or "no sustained alarm"


def _tooth_count(series):
    return max((len(rms) for rms in series["tooth_rms"]), default=0)


def _draw_teeth(axes, series):
    """Draws the image; returns the tooth that stands out at the end in words."""
    teeth = _tooth_count(series)
    columns = numpy.full((len(series["tooth_rms"]), teeth), math.nan)
    for column, rms, first in zip(columns, series["tooth_rms"], series["first_tooth"]):
        if len(rms) == teeth and None not in rms and (middle := sorted(rms)[teeth // 2]):
            column[:] = numpy.roll(numpy.divide(rms, middle), round(first))
    image = axes.imshow(columns.T, origin="lower", aspect="auto", cmap="viridis",
                        interpolation="nearest", vmin=1,
                        extent=(0.5, len(columns) + 0.5, 0.5, teeth + 0.5))
    axes.figure.colorbar(image, ax=axes, label="Tooth RMS over the median tooth's")
    _boundary(axes, series, PAPER)
    axes.grid(False)
    axes.set(xlabel="Recording, in time order", ylabel="Tooth, from the baseline's start")
    last = columns[-1]
    return ("no value at the end" if numpy.isnan(last).all() else
            f"in the last recording tooth {numpy.nanargmax(last) + 1} stands out, "
            f"{number(numpy.nanmax(last))} times the median")


def _monitored(report):
    """Gearboxes that are monitored, each with titles and functions that draw on axes and return what
    they show in words."""
    monitoring = report.data.get("monitoring")
    if not monitoring or not monitoring["watched"]:
        return
    for series in monitoring["recordings"]:
        names = [name for name in series["deviations"] if name != "fused"][:MOST]
        if names:
            drawn = [("Indicators over the recordings", partial(
                _draw_indicators, monitoring=monitoring, series=series, names=names))]
            if _tooth_count(series) > 0:
                drawn.append(("Teeth over the recordings", partial(_draw_teeth, series=series)))
            yield series, drawn


def drawings(report):
    """Functions that draw the figures, each on axes."""
    def titled(axes, title, draw):
        draw(axes)
        axes.set_title(title)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(loc="upper left")

    return [partial(titled, title=_title(title, series), draw=draw)
            for series, drawn in _monitored(report) for title, draw in drawn]


def figures(report, page):
    """HTML of the figures of every gearbox that is monitored."""
    body = ""
    for series, drawn in _monitored(report):
        charts = []
        for title, draw in drawn:
            figure, axes = panel(3.8)
            about = draw(axes)
            if axes.get_legend_handles_labels()[0]:
                legend_below(axes, 1)
            charts.append(to_svg(figure, _title(title, series), about, page.names))
        body += page.figure(
            _title("Recordings in time order", series), charts,
            "Thin lines are the thresholds of single recordings, triangles the first sustained "
            "alarms. The dashed line separates the healthy recordings from the later ones. In the "
            "image of the teeth a horizontal line is one tooth that stays the worst one: a fault "
            "stays on its tooth, noise does not.", report.table("monitoring"))
    return body
