#!/usr/bin/env python3
"""Error against time of every solver setting measured by `gearpod accuracy STUDY --json F`.

    python3 analysis/figures/accuracy.py F.json figure.svg      # or .png; Debian's python3-matplotlib

The left chart shows the worst feature, the right one the sensor signal (filled) and the
transmission error (open), all as relative errors. The line is the Pareto frontier: no measured
setting is both faster and more accurate."""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

MARKS = "osD^vPX*"
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#999999"]


def draw_settings(axes, report, styles):
    for setting in report["rungs"]:
        if "refused" in setting or setting["integrator"] == "auto":
            continue
        colour, mark = styles[setting["integrator"]]
        time, error = 1e6 * setting["gearbox_s"], setting["error"]
        tight = setting["settle_tolerance"] <= 1e-10
        style = {"marker": mark, "color": colour, "ms": 5 if tight else 3,
                 "alpha": 1.0 if tight else 0.45, "ls": "none"}
        if error["worst_feature"]:
            axes[0].plot(time, error["worst_feature"], **style)
        if error["sensor"] and tight:
            axes[1].plot(time, error["sensor"], **style)
        if error["te"] and tight:
            axes[1].plot(time, error["te"], **{**style, "mfc": "none", "ms": 4})


def draw_frontier(axis, report):
    frontier = sorted((1e6 * r["gearbox_s"], r["error"]["worst_feature"]) for r in report["rungs"]
                      if r.get("frontier") and r["error"]["worst_feature"])
    axis.step(*zip(*frontier), where="post", color="0.25", lw=1.2, zorder=1)


def draw_others(axes, report):
    """Draws the results outside the candidate list: the study's own setting, full integration of
    all meshes, other programs, and the stability limit."""
    def place(label, seconds, worst, sensor, mark):
        for axis, error in zip(axes, (worst, sensor)):
            if error:
                axis.plot(1e6 * seconds, error, mark, color="k", ms=9, mfc="none", label=label)

    for setting in report["rungs"]:
        if "refused" in setting:
            continue
        error = setting["error"]
        if setting["name"] == report["own"]:
            place("setting of the study", setting["gearbox_s"], error["worst_feature"],
                  error["sensor"], "s")
        elif any("horizon=full" in key for key in setting["overrides"]):
            place("the same, full integration", setting["gearbox_s"], error["worst_feature"],
                  error["sensor"], "D")
    for peer, mark in zip(report.get("peers", []), "ov^<>"):
        place(peer["name"], peer["gearbox_s"], peer["worst_feature"], peer["sensor"], mark)
    limit = report["explicit_limit"]
    for axis in axes:
        axis.axvline(1e6 * limit["gearbox_s"], color="0.5", ls=":", lw=1,
                     label="classical Runge-Kutta at its stability limit"
                     + (" (refused)" if limit["refused"] else ""))


def main():
    report = json.load(open(sys.argv[1]))
    names = []
    for setting in report["rungs"]:
        if setting["integrator"] not in names and setting["integrator"] != "auto" and "refused" not in setting:
            names.append(setting["integrator"])
    styles = {name: (COLOURS[i % 8], MARKS[i % 8]) for i, name in enumerate(names)}

    figure, axes = plt.subplots(1, 2, figsize=(11, 5), sharex=True)
    draw_settings(axes, report, styles)
    draw_frontier(axes[0], report)
    draw_others(axes, report)
    for choice in report.get("choices", []):
        axes[0].axhline(choice["tolerance"], color="0.85", lw=0.8, zorder=0)
        if "chosen" in choice:
            setting = next(r for r in report["rungs"] if r["name"] == choice["chosen"])
            axes[0].plot(1e6 * setting["gearbox_s"], setting["error"]["worst_feature"], "o", ms=12,
                         mfc="none", color="#C00000")
    for name, (colour, mark) in styles.items():
        axes[0].plot([], [], mark, color=colour, label=name)
    axes[0].plot([], [], "o", ms=12, mfc="none", color="#C00000", label="chosen for a tolerance")
    axes[0].plot([], [], color="0.25", lw=1.2, label="frontier")
    axes[0].plot([], [], "o", color="0.3", ms=3, alpha=0.45,
                 label="small: looser convergence tolerance")
    axes[0].set_title("worst feature")
    axes[1].set_title("sensor signal (filled), transmission error (open)")
    agreement = report["reference"]["agreement"]["sensor"]
    axes[1].axhline(agreement, color="0.5", ls="--", lw=1)
    axes[1].annotate("agreement of the two references, sensor", (0.02, agreement), fontsize=7,
                     xycoords=("axes fraction", "data"), va="bottom")
    for axis in axes:
        axis.set(xscale="log", yscale="log",
                 xlabel="processor time of the integration, us per gearbox")
        axis.grid(True, which="major", color="0.93")
    axes[0].set_ylabel("relative error")
    figure.suptitle(report["title"])
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=4, fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    figure.savefig(sys.argv[2], dpi=110)


main()
