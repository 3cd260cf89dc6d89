"""Shared by the scripts of this folder: runs programs, and holds a part of performance.json.

A part is a dictionary with `tables` (title, columns, rows) and `ratios` (by name: median and range of the
rounds). A cell of a row is a text, a number or a ratio.
"""
import argparse
import dataclasses
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence

import h5py

Part = dict[str, list | dict]
SUCCESS = (0, 3)  # 3: some gearboxes failed


@dataclasses.dataclass
class Finished:
    """Outputs of a program, with its wall-clock and processor time and its largest resident set."""

    output: str
    wall_s: float
    processor_s: float
    megabytes: float


def finished(command: Sequence[str], environment: dict[str, str] | None = None) -> Finished:
    """Runs a command, and exits with its messages if it fails."""
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        start = time.perf_counter()
        child = subprocess.Popen(command, stdout=output, stderr=errors, env=environment)
        _, status, usage = os.wait4(child.pid, 0)
        wall_s = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        errors.seek(0)
        if child.returncode not in SUCCESS:
            sys.exit(f"{' '.join(command)} ended with {child.returncode}:\n{output.read()}{errors.read()}")
        return Finished(output.read(), wall_s, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024 / 1e6)


def processor_s(command: Sequence[str]) -> float:
    return finished(command).processor_s


def times_in(results: str) -> dict[str, float]:
    """Seconds of a results file by part of the work, and its number of rows."""
    with h5py.File(results) as file:
        times = {name.removesuffix("_thread_s").removesuffix("_s"): float(value[()])
                 for name, value in file["timing"].items()}
        return times | {"rows": len(file["status"])}


def number_in(pattern: str, text: str) -> float:
    """Returns the group of a pattern's first match as a number."""
    found = re.search(pattern, text, re.MULTILINE)
    if not found:
        sys.exit(f"no match of {pattern!r} in:\n{text}")
    return float(found[1])


def ratio(values: Sequence[float]) -> dict[str, float]:
    """Median and range of a ratio over the rounds."""
    return {"median": statistics.median(values), "low": min(values), "high": max(values), "rounds": len(values)}


def number(value: float) -> str:
    """Integers as they are; otherwise three significant digits. Thousands are separated."""
    if isinstance(value, int):
        return f"{value:,}"
    return f"{float(f'{value:.3g}'):,.0f}" if abs(value) >= 100 else f"{value:#.3g}".removesuffix(".")


def ratio_text(one: dict[str, float]) -> str:
    text = number(one["median"])
    return text if one["rounds"] == 1 else f"{text} ({number(one['low'])} to {number(one['high'])})"


def table(columns: list[str], rows: list[list], title: str = "") -> dict[str, str | list]:
    return {"title": title, "columns": columns, "rows": rows}


def cell_text(cell: str | float | dict) -> str:
    if isinstance(cell, dict):
        return ratio_text(cell)
    return cell if isinstance(cell, str) else number(cell)


def markdown(one: dict) -> str:
    lines = [one["title"], ""] if one["title"] else []
    lines += ["| " + " | ".join(one["columns"]) + " |", "|" + " --- |" * len(one["columns"])]
    return "\n".join(lines + ["| " + " | ".join(map(cell_text, row)) + " |" for row in one["rows"]])


def arguments(description: str | None, rounds: int) -> argparse.ArgumentParser:
    """Parser with the options of all scripts."""
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=rounds, help=f"default: {rounds}")
    parser.add_argument("--build", default="build", help="folder of the programs")
    parser.add_argument("--json", metavar="FILE", help="write tables and ratios to a file")
    return parser


def parsed(parser: argparse.ArgumentParser) -> argparse.Namespace:
    options = parser.parse_args()
    if options.rounds < 1:
        parser.error("--rounds must be at least 1")
    options.program = options.build + "/gearpod"
    return options


def show(part: Part, options: argparse.Namespace) -> None:
    """Prints the tables of a part, and writes the part to the file of --json."""
    print("\n\n".join(markdown(one) for one in part["tables"]))
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(part, file)


def bench_program(build: str, name: str) -> str:
    return f"{build}/tests/bench/{name}"


def benchmark_runs(build: str, name: str, repetitions: int, seconds: float) -> dict[str, list[dict]]:
    """Repetitions of each case of a program of Google Benchmark, in random order; without cases that it skips."""
    command = [bench_program(build, name), f"--benchmark_min_time={seconds}", f"--benchmark_repetitions={repetitions}",
               "--benchmark_enable_random_interleaving=true", "--benchmark_format=json"]
    runs: dict[str, list[dict]] = {}
    for entry in json.loads(finished(command).output)["benchmarks"]:
        if entry["run_type"] == "iteration" and not entry.get("error_occurred"):
            runs.setdefault(entry["run_name"], []).append(entry)
    return {case: sorted(own, key=lambda run: run["repetition_index"]) for case, own in sorted(runs.items())}
