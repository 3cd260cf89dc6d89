"""Page of gearpod pod: POD from a table of inspections."""

import math
from statistics import fmean

import blocks
from charts import DASHED, INK, NOISY, colour, dash, legend_below, mark_size, marks, panel, to_svg
from report import Findings
from words import Sizes, number, rate, with_unit

DIGITS = 4


class Inspection(Findings):
    def __init__(self, data):
        super().__init__(data)
        self.sizes = Sizes(data["size"])
        self.pod = data["hit_miss"] or data["signal_response"]
        if self.pod and self.pod.get("smooth"):  # a monotone curve instead of a line
            self.pod = {**self.pod, **self.pod["smooth"], "refusal": None, "model": "a monotone curve",
                        "bound": "from tables simulated from the curve"}
        self.value = data["value"]["name"]
        self.bound = f"a90/{number(100 * data['confidence'], 6)}"

    def title(self):
        return f"{self.value} over {self.sizes.name}"


def _bars(points, parts=12):
    """Hit rates in groups of about equal count, by size."""
    points = sorted(points)
    step = max(1, round(len(points) / parts))
    for first in range(0, len(points), step):
        yield tuple(fmean(values) for values in zip(*points[first:first + step]))


def _columns(inspection):
    """Size, and POD with its bounds, as shown; missing values are gaps."""
    band = inspection.pod["band"]
    return [list(map(inspection.sizes.shown, band["size"])),
            *([math.nan if v is None else v for v in band[name]] for name in ("pod", "lower", "upper"))]


def _points(inspection):
    data = inspection.data["data"]
    return [(inspection.sizes.shown(size), value) for size, value in zip(data["size"], data["value"])]


def draw_curve(axes, inspection):
    """Draws POD over size with its bounds, hits and misses."""
    x, pod, lower, upper = _columns(inspection)
    axes.axhline(0.9, **DASHED)
    axes.fill_between(x, lower, upper, color=colour(0), alpha=0.16, linewidth=0)
    axes.plot(x, pod, color=colour(0), label="POD")
    if inspection.data["hit_miss"]:
        flawed = [(size, hit) for size, hit in _points(inspection) if size > 0]
        marks(axes, [(size, 0.01 + 0.98 * hit) for size, hit in flawed], "|", color=NOISY,
              label="hits and misses")
        marks(axes, list(_bars(flawed)), "o", markersize=4.5, markeredgewidth=0, color=colour(1),
              label="rates of groups")
    found = inspection.pod["a90"]["upper"]
    if found["where"] == "reached":
        mark_size(axes, inspection.sizes.shown(found["size"]), inspection.sizes.text(found["size"], DIGITS), 0.05)
    axes.set(ylim=(-0.02, 1.03), xlabel=inspection.sizes.axis(), ylabel="Probability of detection")


def _curve(inspection, page):
    pod = inspection.pod
    figure, axes = panel(3.6)
    draw_curve(axes, inspection)
    legend_below(axes, 3)
    svg = to_svg(figure, "Probability of detection over size", inspection.text("headline"), page.names)
    rows = [[number(size, DIGITS), *map(rate, rates)] for size, *rates in zip(*_columns(inspection))]
    how = (f"The curve with its bounds ({pod['bound']}); the vertical line at {inspection.bound} "
           "is where the lower bound passes 0.9 (dashed).")
    return page.figure("Probability of detection", [svg], how,
                       blocks.table("POD over size", ["size", "POD", "lower", "upper"], rows))


def _line(pod, size):
    """Mean response on the line of the chosen candidate."""
    line = pod["candidates"][pod["chosen"]]
    at = line["intercept"] + line["slope"] * (math.log(size) if line["log_size"] else size)
    power = line["power"]
    inside = 1 + power * at
    return (at if power == 1 else math.exp(at) if power == 0
            else inside ** (1 / power) if inside > 0 else float("nan"))


def _responses(inspection, page):
    pod, data = inspection.pod, inspection.data
    figure, axes = panel(3.6)
    points = _points(inspection)
    marks(axes, points, "o", markersize=3.5, markeredgewidth=0, color=colour(0), label="measured")
    axes.plot(_columns(inspection)[0], pod.get("mean") or [_line(pod, size) for size in pod["band"]["size"]],
              color=colour(1), linestyle=dash(1), label="curve" if pod.get("mean") else "line")
    axes.axhline(pod["threshold"], color=INK, linewidth=1, linestyle=(0, (4, 3)), label="threshold")
    axes.set(xlabel=inspection.sizes.axis(), ylabel=with_unit(inspection.value, data["value"]["unit"], ", "))
    legend_below(axes, 3)
    svg = to_svg(figure, "Responses over size", f"{len(points)} values and {pod['model']}",
                 page.names)
    rows = [[number(v, DIGITS) for v in point] for point in points]
    how = (f"The mean ({pod['model']}) and the decision threshold; {pod['censored'][0]} values are "
           f"censored below and {pod['censored'][1]} above.")
    return page.figure("Responses", [svg], how,
                       blocks.table("Measured values", ["size", inspection.value], rows))


def _trade_off(inspection, page):
    points = [p for p in inspection.data["trade_off"] if p["a90"]["estimate"]["where"] == "reached"]
    if len(points) < 2:
        return ""
    figure, axes = panel(3.4)
    known = all(p["false_calls"] for p in points)
    x = [p["false_calls"] if known else p["threshold"] for p in points]
    for k, end, label in ((0, "estimate", "a90"), (1, "upper", inspection.bound)):
        axes.plot(x, inspection.sizes.reached(points, end), color=colour(k), linestyle=dash(k), label=label)
    axes.set(xscale="log" if known else "linear", ylabel=inspection.sizes.axis(),
             xlabel="False-call probability" if known else "Threshold")
    legend_below(axes, 2)
    svg = to_svg(figure, "What another threshold would trade",
                 "Detectable size against " + ("false calls" if known else "threshold"), page.names)
    return page.figure("What another threshold would trade", [svg],
                       "A lower threshold finds smaller flaws, but gives more false calls.",
                       inspection.table("trade_off"))


def parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    inspection = Inspection(data)
    verdict = (blocks.answer(inspection.text("headline")) + inspection.table("sizes")
               + inspection.notes("warning."))
    body = ""
    if not inspection.pod["refusal"]:
        figures = _curve(inspection, page)
        if data["signal_response"]:
            figures += _responses(inspection, page) + _trade_off(inspection, page)
        body += page.section("detection", "Detection", figures)
    keys = ["bound", "coverage", "measured_coverage",
            *(block["key"] for block in data["findings"][-1]["blocks"] if "text" in block)]
    body += page.section("facts", "Data and method",
                         blocks.bullets(filter(None, map(inspection.text, keys))))
    return inspection.title(), inspection.text("headline"), verdict, body
