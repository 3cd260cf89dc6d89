"""Picture of the README: POD curve of a study with the signals of two of its gearboxes.

    PYTHONPATH=analysis/python /usr/bin/python3 docs/tools/readme_picture.py planet-crack.h5 docs/_static/pod.svg \\
        --feature change_window_ratio --noise 0.03

Draws the feature that finds the smallest fault (or --feature) at noise x 1 (or --noise): its POD curve with bounds and
the detection rates, and the sensor signals of a healthy gearbox and of one with the largest fault.
"""

import argparse

import gearpod
import matplotlib
import numpy as np

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "gearpod", "svg.fonttype": "none", "font.size": 9})


def first_row(results, size):
    rows = results.rows("graded")
    worked = rows[(results.size[rows] == size) & (results.status[rows] == 0)]
    return int(worked[0])


def extremes(time, values, stretches=700):
    """Smallest and largest value of each stretch: what a line of so few pixels shows."""
    length = max(1, len(values) // stretches)
    end = len(values) // length * length
    parts = values[:end].reshape(-1, length)
    ends = np.stack([parts.min(axis=1), parts.max(axis=1)], axis=1)
    return np.repeat(time[:end:length], 2), ends.ravel()


def draw_signal(axes, results, row, noise):
    signals = results.signals(row)
    name = f"sensor_noise_{noise:g}"
    values = signals[name if name in signals else "sensor"]
    time = next((signals[key] for key in ("time_s", "time") if key in signals),
                np.arange(len(values)))
    axes.plot(*extremes(time, values), linewidth=0.5, color="#33547d")
    axes.set_ylabel("sensor, m/s²")
    axes.margins(x=0)


def draw(results, feature, noise):
    import matplotlib.pyplot as plt
    figure, panels = plt.subplot_mosaic([["healthy", "pod"], ["faulty", "pod"]],
                                        figsize=(8.5, 3.8), layout="constrained")
    sizes = np.unique(results.size[results.rows("graded")])
    largest = sizes.max()
    draw_signal(panels["healthy"], results, first_row(results, sizes.min()), noise)
    draw_signal(panels["faulty"], results, first_row(results, largest), noise)
    panels["healthy"].set_title("healthy gearbox")
    panels["faulty"].set_title(f"crack of {1e3 * largest:.3g} mm")
    panels["faulty"].set_xlabel("time, s")
    limit = max(max(map(abs, panels[name].get_ylim())) for name in ("healthy", "faulty"))
    for name in ("healthy", "faulty"):
        panels[name].set_ylim(-limit, limit)
    axes = panels["pod"]
    gearpod.figures.detection(results, feature, noise, axes=axes)
    axes.lines[0].set_linestyle("none")
    axes.containers[0].set_label("detection rates")
    gearpod.figures.pod(results, feature, noise, axes=axes)
    found = results.smallest_fault(noise)
    axes.set_xlabel("crack depth, mm")
    axes.set_title(f"{feature}, noise x {noise:g}")
    if found is not None:
        axes.set_title(f"detected with 90 % probability: {1e3 * found[0]:.3g} mm")
    axes.legend(loc="lower right", frameon=False)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("results")
    parser.add_argument("picture")
    parser.add_argument("--feature")
    parser.add_argument("--noise", type=float)
    options = parser.parse_args()
    results = gearpod.open(options.results)
    noise = options.noise or results.reference
    found = results.smallest_fault(noise)
    feature = options.feature or (found[1] if found else results.features[0])
    draw(results, feature, noise).savefig(options.picture, metadata={"Date": None})


if __name__ == "__main__":
    main()
