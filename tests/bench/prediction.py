#!/usr/bin/python3
"""Compares the time and memory that `describe` predicts with those of `run`, for shipped studies.

    tests/bench/prediction.py [--rounds 1] [--settings] [--build build] [--json FILE] [STUDY.toml ...]

The default is all studies that run, about ten minutes per round on two idle processors. --settings
takes larger studies with few gearboxes instead (SETTINGS below). A round describes each study, runs it
and describes it again, to compensate for a varying load of the machine; the forecast is the mean of
both. Time is wall-clock time, memory the largest resident set (VmHWM), and a ratio is prediction over
measurement. Prints every round to stderr.
"""
import glob
import math
import os
import re
import statistics
import sys
import tempfile

from measuring import Finished, arguments, finished, number_in, parsed, ratio, show, table

LOWEST, HIGHEST = 0.77, 1.3
FEW, HEALTHY, ONE_THREAD = "ensemble.instances={}", "ensemble.threshold_instances={}", "numerics.threads=1"
# Study and settings; housing and stages need every sample of a record.
SETTINGS = [
    ("planet-crack-ideal", []),
    ("planet-crack-ideal", [ONE_THREAD]),
    ("planet-crack-ideal", [FEW.format(300), HEALTHY.format(200)]),
    ("planet-crack-ideal", [FEW.format(300), HEALTHY.format(200), "sensor.record_turns=5"]),
    ("planet-crack", [FEW.format(32)]),
    ("crack-in-sun", [FEW.format(60)]),
    ("gusts", [FEW.format(40)]),
    ("noise-density", [FEW.format(140), HEALTHY.format(100)]),
    ("snu-rig", []),
    ("wind-turbine", []),
    ("bearing-fault", [FEW.format(24)]),
    ("sensor-places", [FEW.format(16)]),
]
Case = tuple[str, tuple[str, ...]]  # study file, settings


def forecast(command: list[str]) -> tuple[float, float, float]:
    """Seconds and megabytes predicted by `describe`, and the seconds that it took.

    A forecast without computed gearboxes has no time (not a number), and a lower bound of the memory.
    """
    done = finished(command)
    has_time = "\n  estimated time " in done.output
    return (number_in(r"^  estimated time +([\d.]+) s", done.output) if has_time else math.nan,
            number_in(r"^  (?:estimated )?memory +(?:at least )?([\d.]+) MB", done.output), done.wall_s)


def measured(program: str, case: Case, folder: str) -> tuple[tuple[float, float, float], Finished]:
    """Mean of the forecasts before and after a run, and the run."""
    study, settings = case
    added = [study] + [text for setting in settings for text in ("--set", setting)]
    before = forecast([program, "describe", *added])
    done = finished([program, "run", *added, "--out", folder + "/r.h5", "--force"])
    after = forecast([program, "describe", *added])
    return tuple(statistics.mean(pair) for pair in zip(before, after)), done


def runs(study: str) -> bool:
    """True if a study has gears with teeth; the others have modes only."""
    with open(study, encoding="utf-8") as text:
        return re.search(r"^(teeth|\w+\.teeth) =", text.read(), re.MULTILINE) is not None


def main() -> None:
    parser = arguments(__doc__, 1)
    parser.add_argument("studies", nargs="*", metavar="STUDY.toml")
    parser.add_argument("--settings", action="store_true", help="larger studies with few gearboxes")
    options = parsed(parser)
    cases: list[Case] = [(study, ()) for study in options.studies or sorted(glob.glob("studies/**/*.toml", recursive=True))
                         if options.studies or runs(study)]
    if options.settings:
        cases = [(f"studies/{study}.toml", tuple(settings)) for study, settings in SETTINGS]
    results: dict[Case, list[tuple]] = {case: [] for case in cases}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for case in cases:
                results[case].append(measured(options.program, case, folder))
                (time_s, memory_MB, describe_s), done = results[case][-1]
                print(f"{' '.join((case[0], *case[1]))}: {time_s:.2f} s for {done.wall_s:.2f} s, {memory_MB:.0f} MB for "
                      f"{done.megabytes:.0f} MB, describe {describe_s:.2f} s", file=sys.stderr, flush=True)
    rows, ratios = [], {}
    for (study, settings), rounds in results.items():
        name = os.path.basename(study).removesuffix(".toml")
        row = [f"`{name}`", ", ".join(f"`{text}`" for text in settings)]
        for i, what, of_run in ((0, "time", lambda done: done.wall_s), (1, "memory", lambda done: done.megabytes)):
            one = ratio([predicted[i] / of_run(done) for predicted, done in rounds])
            predicted_one, of_runs = (statistics.median(values) for values in zip(*((p[i], of_run(done)) for p, done in rounds)))
            if math.isnan(predicted_one):
                row += ["-", of_runs, "-"]
                continue
            ratios[f"{what}, {' '.join((name, *settings))}"] = one
            row += [predicted_one, of_runs, one]
        rows.append(row + [statistics.median(predicted[2] for predicted, _ in rounds)])
    columns = ["study", "settings", "time: predicted, s", "run, s", "ratio", "memory: predicted, MB", "run, MB", "ratio",
               "`describe`, s"]
    if not options.settings:
        columns.pop(1)
        rows = [row[:1] + row[2:] for row in rows]
    summary = []
    for what in ("time", "memory"):
        medians = [one["median"] for name, one in ratios.items() if name.startswith(what)]
        good = sum(LOWEST <= median <= HIGHEST for median in medians)
        summary.append([what, f"{min(medians):.2f} to {max(medians):.2f}", f"{good} of {len(medians)}"])
    show({"tables": [table(columns, rows), table(["", "ratios", f"within {LOWEST} to {HIGHEST}"], summary)],
          "ratios": ratios}, options)


if __name__ == "__main__":
    main()
