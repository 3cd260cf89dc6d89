#!/usr/bin/python3
"""Cost of a study against its number of gearboxes: whole runs on one thread.

    tests/bench/instances.py [--rounds 2] [--most 8000] [--study studies/reference-10k.toml]
                             [--program build/gearpod]

A round runs the study with 1/32, 1/16, ..., 1/1 of the largest number of test gearboxes, each
with a quarter as many healthy ones for the thresholds. It then runs `report` on the results, whose
time is that of detection rates, curves and their intervals. Prints processor seconds of the fastest
round (least disturbed by other programs), the straight line of least relative deviations through
the times without detection, and the share of each phase of a run.
"""
import argparse
import re
import resource
import subprocess
import sys
import tempfile

PHASES = ["sampling", "stiffness", "integration", "signals", "noise", "features", "output"]


def processor_s() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def call(command: list[str]) -> tuple[float, str]:
    """Returns processor seconds and output of a program."""
    start = processor_s()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return processor_s() - start, done.stdout


def number_in(pattern: str, text: str) -> float:
    found = re.search(pattern, text, re.MULTILINE)
    if not found:
        sys.exit(f"no match of {pattern!r} in:\n{text}")
    return float(found.group(1))


def run(options: argparse.Namespace, graded: int, folder: str) -> dict[str, float]:
    """Returns seconds of a run, of detection alone, and of the phases."""
    results = folder + "/r.h5"
    command = [options.program, "run", options.study, "--out", results]
    command += ["--instances", str(graded), "--set", "numerics.threads=1"]
    command += ["--set", f"ensemble.threshold_instances={graded // 4}"]
    whole, text = call(command)
    detection, _ = call([options.program, "report", results])
    times = {"gearboxes": whole - detection, "detection": detection}
    for phase in PHASES:
        times[phase] = number_in(rf"^  {phase} +[0-9.]+ % +([0-9.]+)", text)
    return times


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
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--most", type=int, default=8000)
    parser.add_argument("--study", default="studies/reference-10k.toml")
    parser.add_argument("--program", default="build/gearpod")
    options = parser.parse_args()

    if options.rounds < 1 or options.most < 256:
        parser.error("--rounds must be at least 1, --most at least 256")
    graded = [options.most >> k for k in range(5, -1, -1)]
    runs: dict[int, list[dict[str, float]]] = {n: [] for n in graded}
    with tempfile.TemporaryDirectory() as folder:
        for i in range(options.rounds):
            for n in graded:
                runs[n].append(run(options, n, folder))
                last = runs[n][-1]
                print(
                    f"round {i + 1}, {n + n // 4}: {last['gearboxes']:.2f} s"
                    f" + {last['detection']:.2f} s",
                    file=sys.stderr,
                )

    best = [min(runs[n], key=lambda r: r["gearboxes"]) for n in graded]
    sizes = [n + n // 4 for n in graded]
    seconds = [r["gearboxes"] for r in best]
    offset, slope = line_through(sizes, seconds)
    off = [s / (offset + slope * n) - 1 for n, s in zip(sizes, seconds)]
    print("gearboxes  processor s  off the line  detection s  % of the phases: " + "  ".join(PHASES))
    for r, size, s, deviation in zip(best, sizes, seconds, off):
        total = sum(r[phase] for phase in PHASES)
        each = [f"{100 * r[phase] / total:{len(phase)}.1f}" for phase in PHASES]
        print(
            f"{size:9d}  {s:11.2f}  {100 * deviation:+10.1f} %  {r['detection']:11.2f}"
            + " " * 20
            + "  ".join(each)
        )
    print(
        f"{offset:.2f} s + {1e3 * slope:.3f} ms a gearbox;"
        f" largest deviation {100 * max(map(abs, off)):.1f} %"
    )


if __name__ == "__main__":
    main()
