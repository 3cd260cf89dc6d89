#!/usr/bin/python3
"""Nanoseconds per step and realization, and share of the peak, in tables: runs bench_step.

    tests/bench/steps.py [--rounds 3] [--build build] [--json FILE]

Every case is measured several times in random order; each result is the median of its mesh periods.
The fastest result counts, which other programs disturbed least. A build with GEARPOD_PORTABLE=ON has other
numbers of lanes and instruction sets too. Ratios are shares of the peak; where
operations are not counted, times over those of rk4. The last table is that of bench_peaks.
"""
from measuring import arguments, bench_program, benchmark_runs, finished, parsed, ratio, show, table

METHODS = ["rk4", "central-difference", "sdirk3"]
MOTIONS = {"full": "x, y, rotation", "torsional": "rotations"}
Setting = tuple[str, ...]  # method, planets, motion, precision, instruction set, lanes


def setting_of(name: str) -> Setting:
    method, planets, motion, precision, instructions, lanes = name.split("/")[:6]
    return method, planets[2:], motion, precision, instructions, lanes[6:]


def cell(runs: list[dict] | None) -> str:
    if not runs:
        return "-"
    best = min(runs, key=lambda run: run["ns/step"])
    time = best["ns/step"]
    text = f"{time:,.0f}" if time >= 100 else f"{time:.3g}"
    return f"{text} ({best['peak%']:.0f} %)" if "peak%" in best else text


def ratios_of(runs: dict[Setting, list[dict]]) -> dict[str, dict]:
    ratios = {}
    for setting, own in runs.items():
        name = "{} N={} {} {} {} {} lanes".format(*setting)
        rk4 = runs[("rk4", *setting[1:])]
        ratios[name] = ratio([run["peak%"] / 100 if "peak%" in run else run["ns/step"] / other["ns/step"]
                              for run, other in zip(own, rk4)])
    return ratios


def peaks(build: str) -> dict:
    rows = [line.split() for line in finished([bench_program(build, "bench_peaks")]).output.splitlines()[1:]]
    return table(["", "scalar", "256 bit", "512 bit"], [[" ".join(r[:-3]), *r[-3:]] for r in rows],
                 "Peak rates of one core (`bench_peaks`), 1e9 per second:")


def main() -> None:
    options = parsed(arguments(__doc__, 3))
    runs = {setting_of(name): own for name, own in benchmark_runs(options.build, "bench_step", options.rounds, 0.15).items()}
    sets = sorted({s[4] for s in runs}, reverse=True)
    scenes = [(n, motion) for motion in MOTIONS for n in ("3", "4", "6")]
    by_scene = []
    for method in METHODS:
        for precision, lanes in (("double", "8"), ("single", "16")):
            keys = [(method, n, motion, precision, sets[0], lanes) for n, motion in scenes]
            if keys[0] in runs:
                by_scene.append([method, f"{lanes} {precision}s"] + [cell(runs.get(k)) for k in keys])
    by_set = []
    for method, precision, lanes in (
        [("rk4", "double", n) for n in ("8", "4", "1")] + [("rk4", "single", n) for n in ("16", "8", "4", "1")]
        + [("central-difference", "single", "16"), ("sdirk3", "double", "8")]
    ):
        keys = [(method, "4", "full", precision, instructions, lanes) for instructions in sets]
        if any(key in runs for key in keys):
            by_set.append([method, f"{lanes} {precision}s"] + [cell(runs.get(k)) for k in keys])
    tables = [table(["method", "lanes"] + [f"{n} planets, {MOTIONS[m]}" for n, m in scenes], by_scene, f"With {sets[0]}:"),
              peaks(options.build)]
    if len(sets) > 1:
        tables.insert(1, table(["method", "lanes"] + sets, by_set, "Four planets in x, y and rotation, by instruction set:"))
    show({"tables": tables, "ratios": ratios_of(runs)}, options)


if __name__ == "__main__":
    main()
