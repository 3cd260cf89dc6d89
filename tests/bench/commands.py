#!/usr/bin/python3
"""Time of whole commands: from the study file to results and their report, on all processors.

    tests/bench/commands.py [--rounds 3] [--build build] [--json FILE]

A round runs each command in turn. Times and shares are medians. The ratio is processor time over that
of 1e11 independent scalar fused multiply-adds, whose rate bench_peaks measures before and after each
run: it depends less on the processor's frequency and on other programs. The second table is `describe`
of a study for `lives`, which measures a gearbox and a further record of it.
"""
import os
import statistics
import tempfile

from measuring import arguments, bench_program, finished, number_in, parsed, ratio, show, table, times_in

COMMANDS = ["studies/planet-crack-ideal.toml", "studies/reference-10k.toml",
            "studies/reference-10k.toml --set numerics.tolerance=1e-3", "studies/planet-crack.toml"]
LIVES = "studies/planet-life.toml"
OPERATIONS = 1e11
PARTS = ["sampling", "stiffness", "integration", "signals", "noise", "features", "waiting"]


def rate(peaks: str) -> float:
    """Scalar fused multiply-adds per second of one core."""
    return 1e9 * number_in(r"^fused multiply-adds +([\d.]+)", finished([peaks, "50"]).output)


def run(program: str, peaks: str, command: str, out: str) -> dict[str, float]:
    before = rate(peaks)
    done = finished([program, "run", *command.split(), "--out", out, "--force"])
    times = times_in(out)
    percent = 100 / sum(times[part] for part in PARTS)
    return {"gearboxes": times["rows"], "wall": done.wall_s,
            "processor": done.processor_s, "integration": percent * times["integration"],
            "noise and features": percent * (times["noise"] + times["features"]),
            "detection": done.wall_s - times["setup"] - times["ensemble"],
            "ratio": done.processor_s / (OPERATIONS * (1 / before + 1 / rate(peaks)) / 2)}


def records(program: str, rounds: int) -> tuple[list, dict[str, float]]:
    """Time of a gearbox and of a further record of it, and their ratio."""
    texts = [finished([program, "describe", LIVES]).output for _ in range(rounds)]
    gearbox = [number_in(r"time integration ([\d.e+-]+) s of processor", text) for text in texts]
    record = [1e-3 * number_in(r"superposition ([\d.e+-]+) ms of processor", text) for text in texts]
    one = ratio([a / b for a, b in zip(gearbox, record)])
    return [f"`./gearpod describe {LIVES}`", statistics.median(gearbox), 1e3 * statistics.median(record), one], one


def main() -> None:
    options = parsed(arguments(__doc__, 3))
    peaks = bench_program(options.build, "bench_peaks")
    runs: dict[str, list[dict[str, float]]] = {command: [] for command in COMMANDS}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for command, own in runs.items():
                own.append(run(options.program, peaks, command, os.path.join(folder, "r.h5")))
    rows, ratios = [], {}
    for command, own in runs.items():
        def median(what: str) -> float:
            return statistics.median(one[what] for one in own)
        ratios[f"run {command}"] = one = ratio([one["ratio"] for one in own])
        rows.append([f"`./gearpod run {command}`", int(median("gearboxes")), median("wall"), median("processor"), one,
                     f"{median('integration'):.0f} %",
                     f"{median('noise and features'):.0f} %", median("detection")])
    record, ratios["gearbox over further record in lives"] = records(options.program, options.rounds)
    show({"tables": [table(["command", "gearboxes", "s", "processor s", "over 1e11 multiply-adds", "integration",
                            "noise and features", "detection and results, s"], rows),
                     table(["command", "gearbox, s", "further record, ms", "ratio"], [record],
                           "Processor time of a gearbox in `lives`, and of a further record of it:")],
          "ratios": ratios}, options)


if __name__ == "__main__":
    main()
