#!/usr/bin/python3
"""Cost of a study against its number of gearboxes: whole runs on one thread.

    tests/bench/instances.py [--rounds 2] [--most 8000] [--study studies/reference-10k.toml]
                             [--build build] [--json FILE]

A round runs the study with 1/32, 1/16, ..., 1/1 of the largest number of test gearboxes, each
with a quarter as many healthy ones for the thresholds. It then runs `report` on the results, whose
time is that of detection rates, curves and their intervals. The tables have the processor time of the
fastest round (least disturbed by other programs), and its deviation from the straight line of least
relative deviations through the times without detection. Ratios compare the time per gearbox with that
of the largest number in the same round.
"""
import argparse
import tempfile

from measuring import arguments, finished, parsed, processor_s, ratio, show, table, times_in

PHASES = ["sampling", "stiffness", "integration", "signals", "noise", "features", "output"]


def run(options: argparse.Namespace, graded: int, folder: str) -> dict[str, float]:
    """Returns seconds of a run without detection, of detection alone, and of the phases."""
    results = folder + "/r.h5"
    command = [options.program, "run", options.study, "--out", results, "--force"]
    command += ["--instances", str(graded), "--set", "numerics.threads=1"]
    command += ["--set", f"ensemble.threshold_instances={graded // 4}"]
    whole = finished(command)
    detection = processor_s([options.program, "report", results])
    times = {"gearboxes": whole.processor_s - detection, "detection": detection}
    parts = times_in(results)
    return times | {part: parts[part] for part in PHASES}


def line_through(sizes: list[int], seconds: list[float]) -> tuple[float, float]:
    """Offset and slope with the least sum of squared relative deviations."""
    weights = [1.0 / s**2 for s in seconds]
    total = sum(weights)
    mean_n = sum(w * n for w, n in zip(weights, sizes)) / total
    mean_s = sum(w * s for w, s in zip(weights, seconds)) / total
    slope = sum(w * (n - mean_n) * (s - mean_s) for w, n, s in zip(weights, sizes, seconds))
    slope /= sum(w * (n - mean_n) ** 2 for w, n in zip(weights, sizes))
    return mean_s - slope * mean_n, slope


def main() -> None:
    parser = arguments(__doc__, 2)
    parser.add_argument("--most", type=int, default=8000)
    parser.add_argument("--study", default="studies/reference-10k.toml")
    options = parsed(parser)
    if options.most < 256:
        parser.error("--most must be at least 256")
    graded = [options.most >> k for k in range(5, -1, -1)]
    sizes = [n + n // 4 for n in graded]
    with tempfile.TemporaryDirectory() as folder:
        rounds = [[run(options, n, folder) for n in graded] for _ in range(options.rounds)]
    best = [min(runs, key=lambda r: r["gearboxes"]) for runs in zip(*rounds)]
    seconds = [r["gearboxes"] for r in best]
    offset, slope = line_through(sizes, seconds)
    ratios = {f"time per gearbox, {size:,} over {sizes[-1]:,}":
              ratio([runs[i]["gearboxes"] / size / (runs[-1]["gearboxes"] / sizes[-1]) for runs in rounds])
              for i, size in enumerate(sizes[:-1])}
    rows = []
    for r, size, s in zip(best, sizes, seconds):
        total = sum(r[phase] for phase in PHASES)
        rows.append([size, s, f"{100 * (s / (offset + slope * size) - 1):+.1f} %", r["detection"]]
                    + [f"{100 * r[phase] / total:.1f}" for phase in PHASES])
    columns = ["gearboxes", "without detection, s", "off the line", "detection, s"]
    show({"tables": [table(columns + [PHASES[0] + ", %"] + PHASES[1:], rows),
                     table(["offset of the line, s", "slope, ms per gearbox"], [[offset, 1e3 * slope]])],
          "ratios": ratios}, options)


if __name__ == "__main__":
    main()
