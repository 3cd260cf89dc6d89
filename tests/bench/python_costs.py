#!/usr/bin/python3
"""What a feature in Python costs next to the same feature of the program: whole runs on one thread.

    tests/bench/python_costs.py [--rounds 1] [--instances 800] [--healthy 200]
                                [--study studies/planet-crack-ideal.toml] [--build build]
                                [--json FILE]

A round runs the study with a feature of the program and then with the same function in Python:
crest_factor, which needs the samples of the sensor, and te_kurtosis, which does not (the attribute
`samples`). Processor time is that of all processes; the ratio is without the time in the function
itself. All values must have the same bits. Times are medians over the rounds.
"""
import argparse
import pathlib
import statistics
import sys
import tempfile

import h5py
import numpy as np

from measuring import arguments, parsed, processor_s, ratio, show, table

SOURCE = '''
import os, time
import numpy as np

file = os.open(os.path.join(os.path.dirname(__file__), f"time-{os.getpid()}"), os.O_CREAT | os.O_WRONLY)
spent_s = 0.0


def total(x):
    return np.cumsum(x)[-1]  # from the first sample to the last, as in the program


def _crest_factor(record):
    x = record.sensor_average
    x = x - total(x) / x.size
    return np.abs(x).max() / np.sqrt(total(x * x) / x.size)


def _te_kurtosis(record):
    square = (record.te - total(record.te) / record.te.size) ** 2
    return total(square * square) * square.size / (total(square) * total(square))


def own(record):
    global spent_s
    start_s = time.process_time()
    value = FEATURE(record)
    spent_s += time.process_time() - start_s
    os.pwrite(file, b"%.9f" % spent_s, 0)
    return value


own.samples = FEATURE is _crest_factor
'''


def values(path: pathlib.Path, name: str) -> np.ndarray:
    with h5py.File(path) as file:
        return np.ravel(file["features"][name][:])


def compare(feature: str, options: argparse.Namespace) -> tuple[list, list[float]]:
    """A row of the table, and the ratios of the rounds. Exits if a value has other bits."""
    built_in, python, inside = [], [], []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "own.py").write_text(SOURCE.replace("FEATURE", "_" + feature))
        command = [options.program, "run", options.study, "--quiet", "--force",
                   "--instances", str(options.instances), "--set",
                   f"ensemble.threshold_instances={options.healthy}", "numerics.threads=1",
                   "sensor.noise_levels=[1]"]
        for _ in range(options.rounds):
            built_in.append(processor_s(command + [f'features.use=["te_rms", "{feature}"]',
                                                   "--out", name + "/built-in.h5"]))
            python.append(processor_s(command + ['features.use=["te_rms"]',
                                                 f'features.python=["{name}/own.py"]',
                                                 "--out", name + "/python.h5"]))
            times = list(folder.glob("time-*"))
            inside.append(sum(float(file.read_text() or 0) for file in times))
            for file in times:
                file.unlink()
        one = values(folder / "built-in.h5", feature)
        other = values(folder / "python.h5", "own")
    if np.any(one != other):
        sys.exit(f"{feature}: {np.sum(one != other)} of {one.size} gearboxes have other bits in Python")
    ratios = [(total - own) / alone for total, own, alone in zip(python, inside, built_in)]
    seconds = [statistics.median(times) for times in (built_in, python, inside)]
    return [f"`{feature}`" + (", of the samples" if feature == "crest_factor" else ""), *seconds], ratios


def main() -> None:
    parser = arguments(__doc__, 1)
    parser.add_argument("--instances", type=int, default=800)
    parser.add_argument("--healthy", type=int, default=200)
    parser.add_argument("--study", default="studies/planet-crack-ideal.toml")
    options = parsed(parser)
    rows, ratios = [], {}
    for feature in ("crest_factor", "te_kurtosis"):
        row, values_ = compare(feature, options)
        ratios[feature] = ratio(values_)
        rows.append([*row, ratios[feature]])
    show({"tables": [table(["feature", "in the program, s", "in Python, s", "of these in the function, s",
                            "ratio without them"], rows)], "ratios": ratios}, options)


if __name__ == "__main__":
    main()
