"""Page of gearpod pod: POD from a table of inspections."""

import math

import blocks
from charts import INK, MUTED, NOISY, PAPER, colour, dash, legend_below, panel, to_svg
from report import Findings
from words import Sizes, escape, number, rate

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
        group = points[first:first + step]
        yield (sum(size for size, _ in group) / len(group),
               sum(value for _, value in group) / len(group), len(group))


def _columns(pod):
    """POD and its bounds by size; missing ones are gaps."""
    gap = float("nan")
    return {name: [gap if v is None else v for v in pod["band"][name]]
            for name in ("pod", "lower", "upper")}


def draw_curve(axes, inspection):
    """Draws POD over size with its bounds, hits and misses."""
    pod, data = inspection.pod, inspection.data
    shown = inspection.sizes.shown
    x = [shown(size) for size in pod["band"]["size"]]
    column = _columns(pod)
    axes.axhline(0.9, color=MUTED, linewidth=0.9, linestyle=(0, (4, 3)))
    axes.fill_between(x, column["lower"], column["upper"], color=colour(0), alpha=0.16, linewidth=0)
    axes.plot(x, column["pod"], color=colour(0), label="POD")
    if data["hit_miss"]:
        flawed = [(shown(s), v) for s, v in zip(data["data"]["size"], data["data"]["value"]) if s > 0]
        axes.plot([s for s, _ in flawed], [0.01 + 0.98 * v for _, v in flawed], linestyle="none",
                  marker="|", color=NOISY, label="hits and misses")
        groups = list(_bars(flawed))
        axes.plot([g[0] for g in groups], [g[1] for g in groups], linestyle="none", marker="o",
                  markersize=4.5, markeredgewidth=0, color=colour(1), label="rates of groups")
    upper = pod["a90"]["upper"]
    if upper["where"] == "reached":
        at = shown(upper["size"])
        axes.plot([at, at], [-0.02, 0.9], color=INK, linewidth=1)
        axes.annotate(inspection.sizes.text(upper["size"], DIGITS), (at, 0.05), xytext=(4, 0), textcoords="offset points",
                      fontsize=9, color=INK, bbox={"facecolor": PAPER, "edgecolor": "none",
                                                   "pad": 1.2, "alpha": 0.85})
    axes.set(ylim=(-0.02, 1.03), xlabel=inspection.sizes.axis(), ylabel="Probability of detection")


def _curve(inspection, page):
    pod = inspection.pod
    figure, axes = panel(3.6)
    draw_curve(axes, inspection)
    legend_below(axes, 3)
    column = _columns(pod)
    svg = to_svg(figure, "Probability of detection over size", inspection.text("headline"), page.names)
    rows = [[number(inspection.sizes.shown(s), DIGITS), rate(p), rate(low), rate(high)]
            for s, p, low, high in zip(pod["band"]["size"], column["pod"], column["lower"],
                                       column["upper"])]
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
    shown = inspection.sizes.shown
    points = [(shown(s), v) for s, v in zip(data["data"]["size"], data["data"]["value"])]
    axes.plot([s for s, _ in points], [v for _, v in points], linestyle="none", marker="o",
              markersize=3.5, markeredgewidth=0, color=colour(0), label="measured")
    x = [shown(size) for size in pod["band"]["size"]]
    y = pod.get("mean") or [_line(pod, size) for size in pod["band"]["size"]]
    axes.plot(x, y, color=colour(1), linestyle=dash(1), label="line" if not pod.get("mean") else "curve")
    axes.axhline(pod["threshold"], color=INK, linewidth=1, linestyle=(0, (4, 3)), label="threshold")
    axes.set_xlabel(inspection.sizes.axis())
    unit = data["value"]["unit"]
    axes.set_ylabel(inspection.value + (f", {unit}" if unit else ""))
    legend_below(axes, 3)
    svg = to_svg(figure, "Responses over size", f"{len(points)} values and {pod['model']}",
                 page.names)
    rows = [[number(s, DIGITS), number(v, DIGITS)] for s, v in points]
    how = (f"The mean ({pod['model']}) and the decision threshold; {pod['censored'][0]} values are "
           f"censored below and {pod['censored'][1]} above.")
    return page.figure("Responses", [svg], how,
                       blocks.table("Measured values", ["size", inspection.value], rows))


def _trade_off(inspection, page):
    points = [p for p in inspection.data["trade_off"] if p["a90"]["estimate"]["where"] == "reached"]
    if len(points) < 2:
        return ""
    figure, axes = panel(3.4)
    nothing = float("nan")
    known = all(p["false_calls"] for p in points)
    x = [p["false_calls"] if known else p["threshold"] for p in points]

    def sizes_of(name):
        return [inspection.sizes.shown(p["a90"][name]["size"])
                if p["a90"][name]["where"] == "reached" else nothing for p in points]
    axes.plot(x, sizes_of("estimate"), color=colour(0), label="a90")
    axes.plot(x, sizes_of("upper"), color=colour(1), linestyle=dash(1), label=inspection.bound)
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
    verdict = (f'<p class="answer">{escape(inspection.text("headline"))}</p>'
               + inspection.table("sizes") + inspection.notes("warning."))
    body = ""
    if not inspection.pod["refusal"]:
        figures = _curve(inspection, page)
        if data["signal_response"]:
            figures += _responses(inspection, page) + _trade_off(inspection, page)
        body += page.section("detection", "Detection", figures)
    method = [inspection.text(block["key"]) for block in data["findings"][-1]["blocks"]
              if "text" in block]
    body += page.section("facts", "Data and method",
                         blocks.bullets([text for text in map(inspection.text, ("bound", "coverage",
                                                                         "measured_coverage"))
                                        if text] + method))
    return inspection.title(), inspection.text("headline"), verdict, body
