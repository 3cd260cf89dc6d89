#!/usr/bin/python3
"""Compares the time and memory that `describe` predicts with those of `run`, for shipped studies.

    tests/bench/prediction.py [--rounds 1] [--program build/gearpod] [STUDY.toml ...]

The default is all studies that run, about ten minutes per round on two processors. A round
describes each study, runs it and describes it again, to compensate for a varying load of the
machine; the forecast is the mean of both. Time is wall time, memory the peak of the program
(VmHWM), and a ratio is prediction over measurement. Prints every round and finally the medians by
study and the share of them within 0.77 to 1.3.
"""
import argparse
import glob
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

LOWEST, HIGHEST = 0.77, 1.3


def finished(command: list[str]) -> tuple[str, float, float]:
    """Returns standard output, seconds and megabytes."""
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        start = time.perf_counter()
        child = subprocess.Popen(command, stdout=output, stderr=errors)
        _, status, usage = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - start
        child.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        if child.returncode not in (0, 3):  # 3: some gearboxes failed
            errors.seek(0)
            sys.exit(f"{' '.join(command)} ended with {child.returncode}:\n{errors.read()}")
        return output.read(), seconds, usage.ru_maxrss * 1024 / 1e6


def forecast(program: str, study: str) -> tuple[float, float, float]:
    """Seconds and megabytes predicted by `describe`, and the seconds that it took."""
    text, seconds, _ = finished([program, "describe", study])
    predicted_s = re.search(r"estimated time +([\d.]+) s", text)
    predicted_MB = re.search(r"estimated memory +([\d.]+) MB", text)
    if predicted_s is None or predicted_MB is None:
        sys.exit(f"{program} describe {study}: no forecast")
    return float(predicted_s[1]), float(predicted_MB[1]), seconds


def runs(study: str) -> bool:
    """True if a study has gears with teeth; the others have modes only."""
    with open(study, encoding="utf-8") as text:
        return re.search(r"^(sun|pinion)_teeth", text.read(), re.MULTILINE) is not None


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("studies", nargs="*", metavar="STUDY.toml")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--program", default="build/gearpod")
    options = parser.parse_args()
    studies = options.studies or [s for s in sorted(glob.glob("studies/**/*.toml", recursive=True)) if runs(s)]

    times: dict[str, list[float]] = {study: [] for study in studies}
    memory: dict[str, list[float]] = {study: [] for study in studies}
    print(f"{'':24} {'time, s':>30} {'memory, MB':>30} {'describe':>9}")
    print(f"{'':24}" + 2 * f" {'predicted':>10} {'run':>9} {'ratio':>9}" + f" {'s':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for study in studies:
                before = forecast(options.program, study)
                _, seconds, megabytes = finished(
                    [options.program, "run", study, "--out", folder + "/r.h5"]
                )
                after = forecast(options.program, study)
                predicted = [statistics.mean(pair) for pair in zip(before, after)]
                times[study].append(predicted[0] / seconds)
                memory[study].append(predicted[1] / megabytes)
                name = os.path.basename(study).removesuffix(".toml")
                print(
                    f"{name:24} {predicted[0]:10.2f} {seconds:9.2f} {times[study][-1]:9.2f}"
                    f" {predicted[1]:10.0f} {megabytes:9.0f} {memory[study][-1]:9.2f}"
                    f" {predicted[2]:9.2f}",
                    flush=True,
                )
    for what, ratios in (("time", times), ("memory", memory)):
        medians = [statistics.median(ratios[study]) for study in studies]
        good = sum(LOWEST <= median <= HIGHEST for median in medians)
        print(
            f"{what}: medians {min(medians):.2f} to {max(medians):.2f}, {good} of {len(studies)}"
            f" studies within {LOWEST} to {HIGHEST}"
        )


if __name__ == "__main__":
    main()
