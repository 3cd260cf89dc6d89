#!/usr/bin/env python3
"""Reads the recordings of written_recordings.py with `gearpod features`. Usage: test_written_recordings.py GEARPOD [CASE]"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from written_recordings import CASES, X

STUDY = pathlib.Path(__file__).with_name("rig.toml")


def features(program, folder, name, arguments):
    """The process that reads a file, and its features if it could."""
    (folder / "features.json").unlink(missing_ok=True)
    done = subprocess.run([program, "features", name, "--study", str(STUDY), *arguments, "--json", "features.json"],
                          cwd=folder, capture_output=True, text=True, errors="replace", timeout=120)
    values = {}
    if done.returncode == 0:
        values = json.loads((folder / "features.json").read_text())["features"]
    return done, values


def problem(expected, done, values, reference):
    """What is wrong with an answer; None if nothing is."""
    text = " ".join((done.stdout + done.stderr).split())
    if isinstance(expected, str):
        if done.returncode != 2:
            return f"exit code {done.returncode} instead of 2: {text[:300]}"
        return None if expected in text else f"the refusal does not name {expected!r}: {text[:300]}"
    factor, mention = expected if isinstance(expected, tuple) else (expected, "")
    if done.returncode == 2 and mention and mention in text:
        return None  # the statement may be refused by name instead
    if done.returncode != 0:
        return f"exit code {done.returncode}: {text[:300]}"
    for name, right in (("sensor_rms", reference["sensor_rms"] * factor), ("window_ratio", reference["window_ratio"])):
        if abs(values[name] / right - 1) > 2e-4:
            return f"{name} is {values[name]} instead of {right}"
    return None


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    selected = sys.argv[2] if len(sys.argv) > 2 else ""
    failures = total = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "reference.csv").write_text("sensor [m/s^2]\n" + "".join(f"{v!r}\n" for v in X.tolist()))
        done, reference = features(program, folder, "reference.csv", ["--sampling-Hz", "5120"])
        assert done.returncode == 0, done.stderr
        # The features are those of whole mesh periods, a little less than the recording.
        assert abs(reference["sensor_rms"] / np.sqrt(np.mean(X**2)) - 1) < 0.02
        for make in CASES:
            for file, arguments, expected in make(folder):
                if selected and selected not in f"{make.__name__} {file}":
                    continue
                total += 1
                wrong = problem(expected, *features(program, folder, file, arguments), reference)
                if wrong:
                    failures += 1
                    print(f"{make.__name__}: {file}: {wrong}")
    print(f"{total - failures} of {total} recordings are read or refused as they should be")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
