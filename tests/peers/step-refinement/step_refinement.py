#!/usr/bin/env python3
"""Error of each integrator against the number of time steps in a mesh period, and its order, with abrupt and with
extended contact: root mean square of the difference from the finest steps over that of the variation.

Usage: step_refinement.py GEARPOD STUDY [--meshes N] [--coarsest N] [--finest N] [--methods NAMES] [--set key=value ...]

The reference is rk4 with the finest steps. Steps are doubled from the coarsest until a quarter of the finest."""
import argparse
import math
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np

METHODS = ("rk4", "central-difference", "newmark", "sdirk3")


def simulate(given, onset, method, steps, folder):
    """Sensor signal and transmission error, or None where the method is unstable with these steps."""
    out = pathlib.Path(folder) / "signals.h5"
    settings = [f"effects.contact_onset={onset}", f"numerics.integrator={method}", f"numerics.steps_per_mesh={steps}",
                "numerics.precision=double", "numerics.settle_tolerance=1e-9", "numerics.horizon=full",
                "sensor.noise_levels=[0]"] + given.set
    command = [given.gearpod, "simulate", given.study, "--instance", "0", "--meshes", str(given.meshes), "--out", str(out),
               "--force"]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return None
    with h5py.File(out) as file:
        return [file["signals"][name][:] for name in ("sensor", "te")]


def errors(signals, reference):
    return [float(np.std(a - b) / np.std(b)) for a, b in zip(signals, reference)]


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("gearpod")
    options.add_argument("study")
    options.add_argument("--meshes", type=int, default=6)
    options.add_argument("--coarsest", type=int, default=432)
    options.add_argument("--finest", type=int, default=110592)
    options.add_argument("--methods", default=",".join(METHODS), help="names, separated by commas")
    options.add_argument("--set", action="append", default=[])
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for onset in ("abrupt", "extended"):
            reference = simulate(given, onset, "rk4", given.finest, folder)
            if reference is None:
                raise SystemExit("the reference failed")
            print(f"{onset}: steps, error of the sensor signal and of the transmission error, their orders")
            for method in given.methods.split(","):
                before, steps = None, given.coarsest
                while 4 * steps <= given.finest:
                    signals = simulate(given, onset, method, steps, folder)
                    now = errors(signals, reference) if signals else None
                    order = "" if not now or not before else " ".join(f"{math.log2(a / b):.2f}" for a, b in zip(before, now))
                    text = " ".join(f"{error:.1e}" for error in now) if now else "refused or unstable"
                    print(f"  {method} {steps}: {text} {order}", flush=True)
                    before, steps = now, 2 * steps


if __name__ == "__main__":
    main()
