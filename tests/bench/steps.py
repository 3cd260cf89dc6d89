#!/usr/bin/python3
"""Nanoseconds per step and realization, and share of the peak, in tables: runs bench_step.

    tests/bench/steps.py [--repetitions 3] [--program build/tests/bench/bench_step] [--json FILE]

Every case is measured several times in random order; each result is the median of its mesh periods.
The fastest result counts, which other programs disturbed least. --json tabulates output of
bench_step with --benchmark_format=json instead of running it.
"""
import argparse
import json
import subprocess
import sys

RUN = ["--benchmark_min_time=0.15", "--benchmark_enable_random_interleaving=true"]
RUN += ["--benchmark_format=json"]
METHODS = ["rk4", "central-difference", "generalized-alpha", "sdirk3"]


def setting_of(name: str) -> tuple[str, ...]:
    """Returns (method, planets, motion, precision, instruction set, lanes)."""
    method, planets, motion, precision, instructions, lanes = name.split("/")[:6]
    return method, planets[2:], motion, precision, instructions, lanes[6:]


def measured(everything: dict) -> dict[tuple[str, ...], list[dict]]:
    turns: dict[tuple[str, ...], list[dict]] = {}
    for entry in everything["benchmarks"]:
        if entry["run_type"] == "iteration":
            turns.setdefault(setting_of(entry["name"]), []).append(entry)
    return turns


def cell(turns: list[dict] | None) -> str:
    if not turns:
        return "-"
    best = min(turns, key=lambda turn: turn["ns/step"])
    time = best["ns/step"]
    text = f"{time:,.0f}" if time >= 100 else f"{time:.3g}"
    return f"{text} ({best['peak%']:.0f} %)" if "peak%" in best else text


def print_table(title: list[str], rows: list[tuple[list[str], list[str]]]) -> None:
    print("| " + " | ".join(title) + " |")
    print("|" + " --- |" * len(title))
    for head, cells in rows:
        print("| " + " | ".join(head + cells) + " |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--program", default="build/tests/bench/bench_step")
    parser.add_argument("--json")
    options = parser.parse_args()
    if options.repetitions < 1:
        parser.error("--repetitions must be at least 1")
    if options.json:
        with open(options.json, encoding="utf-8") as file:
            text = file.read()
    else:
        command = [options.program, *RUN, f"--benchmark_repetitions={options.repetitions}"]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)} ended with {done.returncode}")
        text = done.stdout
    turns = measured(json.loads(text))
    sets = sorted({s[4] for s in turns}, reverse=True)

    scenes = [(n, motion) for motion in ("full", "torsional") for n in ("3", "4", "6")]
    rows = []
    for method in METHODS:
        for precision, lanes in (("double", "8"), ("single", "16")):
            keys = [(method, n, motion, precision, sets[0], lanes) for n, motion in scenes]
            if keys[0] in turns:
                rows.append(([method, f"{lanes} {precision}s"], [cell(turns.get(k)) for k in keys]))
    motions = {"full": "x, y, rotation", "torsional": "rotations"}
    print_table(["method", "lanes"] + [f"{n} planets, {motions[m]}" for n, m in scenes], rows)
    print()

    rows = []
    for method, precision, lanes in (
        [("rk4", "double", n) for n in ("8", "4", "1")]
        + [("rk4", "single", n) for n in ("16", "8", "4", "1")]
        + [("central-difference", "single", "16"), ("sdirk3", "double", "8")]
    ):
        keys = [(method, "4", "full", precision, instructions, lanes) for instructions in sets]
        rows.append(([method, f"{lanes} {precision}s"], [cell(turns.get(k)) for k in keys]))
    print_table(["method", "lanes"] + sets, rows)


if __name__ == "__main__":
    main()
