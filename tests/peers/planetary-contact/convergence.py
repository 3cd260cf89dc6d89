#!/usr/bin/env python3
"""Difference that twice the steps and twice the settling periods make to planetary.py (README.md)."""
import json
import pathlib

import numpy as np

from planetary import Planetary

CASES = pathlib.Path(__file__).resolve().parent / "cases"
MESHES, SAMPLES = 10, 200


def main():
    for path in sorted(CASES.glob("*.json")):
        case = json.loads(path.read_text())
        for onset in ("abrupt", "extended"):
            gearbox = Planetary(case, onset)
            runs = [gearbox.run(run_in, MESHES, steps, SAMPLES) for run_in, steps in
                    ((case["run_in"], case["steps"]), (case["run_in"], 2 * case["steps"]),
                     (2 * case["run_in"], case["steps"]))]
            for name, other in (("steps", runs[1]), ("settling periods", runs[2])):
                scale = [np.sqrt(np.mean((runs[0][key] - runs[0][key].mean(0))**2)) for key in ("q", "force")]
                parts = [np.sqrt(np.mean((runs[0][key] - other[key])**2)) / s for key, s in zip(("q", "force"), scale)]
                share = np.abs(runs[0]["out_of_contact"] - other["out_of_contact"]).max()
                print(f"{path.stem:8} {onset:8} twice the {name:16}: motions {parts[0]:.1e}, mesh forces {parts[1]:.1e}, "
                      f"shares {share:.1e}", flush=True)


if __name__ == "__main__":
    main()
