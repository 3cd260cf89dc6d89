#!/usr/bin/python3
"""What longer steps save where every mesh period is integrated: reference-10k.toml with real teeth.

    tests/bench/longer_steps.py [--instances 640] [--healthy 160] [--rounds 1]
                                [--tolerances 0.2 0.05] [--program build/gearpod] [--set KEY=VALUE ...]

A round runs the study with the steps of the integrator's own rule, then with each
numerics.scatter_tolerance. Prints the chosen setting, processor time without the set-up per
gearbox, its ratio to the same round's own rule, that of the whole command for 10,000 gearboxes (the
set-up once), and the largest rms difference of a feature of healthy gearboxes over its scatter.
"""
import argparse
import statistics
import tempfile

import h5py
import numpy as np

from measuring import processor_s

WHOLE = 10_000
TEETH = ["gearbox.tooth_quality=6", "gearbox.pin_tangential_rms_um=20",
         "gearbox.sun.tip_relief_um=15", "gearbox.sun.tip_relief_length_mm=2.4",
         "gearbox.planet.tip_relief_um=15", "gearbox.planet.tip_relief_length_mm=2.4",
         "gearbox.sun.bore_mm=26", "gearbox.planet.bore_mm=40", "gearbox.ring.outer_mm=310",
         'effects.foundation="elastic-ring"', 'effects.contact_onset="extended"',
         'numerics.integrator="central-difference"', 'numerics.precision="single"',
         "numerics.settle_tolerance=1e-4"]


def features(path: str) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    with h5py.File(path) as file:
        healthy = file["instances/group"][:] == 0
        return healthy, {name: file["features/" + name][:] for name in file["features"]}


def largest_error(own: str, other: str) -> str:
    healthy, before = features(own)
    _, after = features(other)
    errors = {name: float(np.max(np.sqrt(np.mean((after[name] - values)[healthy] ** 2, axis=0))
                                 / np.std(values[healthy], axis=0)))
              for name, values in before.items()}
    worst = max(errors, key=lambda name: errors[name])
    return f"{errors[worst]:.3f} ({worst})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--instances", type=int, default=640)
    parser.add_argument("--healthy", type=int, default=160)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--tolerances", type=float, nargs="+", default=[0.2, 0.05])
    parser.add_argument("--program", default="build/gearpod")
    parser.add_argument("--study", default="studies/reference-10k.toml")
    parser.add_argument("--set", action="append", default=[], help="further settings")
    options = parser.parse_args()
    settings = {0.0: "own rule"} | {t: f"scatter_tolerance {t:g}" for t in options.tolerances}
    gearboxes = options.instances + options.healthy
    each: dict[float, list[float]] = {t: [] for t in settings}
    setup: dict[float, list[float]] = {t: [] for t in settings}
    with tempfile.TemporaryDirectory() as folder:
        def command(tolerance: float, instances: int, healthy: int) -> list[str]:
            sets = TEETH + options.set + [f"ensemble.threshold_instances={healthy}"]
            if tolerance > 0.0:
                sets.append(f"numerics.scatter_tolerance={tolerance}")
            out = f"{folder}/{tolerance}-{instances}.h5"
            return [options.program, "run", options.study, "--force", "--quiet", "--out", out,
                    "--instances", str(instances)] + [x for s in sets for x in ("--set", s)]
        for _ in range(options.rounds):
            for tolerance in settings:
                few = processor_s(command(tolerance, 16, 16))
                many = processor_s(command(tolerance, options.instances, options.healthy))
                each[tolerance].append((many - few) / (gearboxes - 32))
                setup[tolerance].append(max(0.0, few - 32 * each[tolerance][-1]))
        own_out = f"{folder}/0.0-{options.instances}.h5"
        for tolerance, name in settings.items():
            out = f"{folder}/{tolerance}-{options.instances}.h5"
            with h5py.File(out) as file:
                chosen = file.attrs.get("numerics_choice", "own rule")
            def whole(t: float, i: int) -> float:
                return setup[t][i] + WHOLE * each[t][i]
            rounds = range(options.rounds)
            print(f"{name}: {chosen}")
            print(f"  {statistics.median(each[tolerance]):.4f} s a gearbox after {statistics.median(setup[tolerance]):.1f} s, "
                  f"own rule over it {statistics.median(each[0.0][i] / each[tolerance][i] for i in rounds):.2f} a gearbox, "
                  f"{statistics.median(whole(0.0, i) / whole(tolerance, i) for i in rounds):.2f} "
                  f"for {WHOLE:,} gearboxes")
            if tolerance > 0.0:
                print(f"  largest rms error over the scatter of healthy gearboxes: "
                      f"{largest_error(own_out, out)}")


if __name__ == "__main__":
    main()
