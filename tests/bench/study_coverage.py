#!/usr/bin/python3
"""Coverage of the intervals of whole studies, found by simulation of known truth.

    tests/bench/study_coverage.py [--case CASE] [--studies 500] [--large 1000] [--jobs 2] [--table]
                                  [--program build/gearpod] [--folder FOLDER]

Each case is a small study that runs with many seeds, as a user would run it, and once with many
gearboxes per fault size (--large) and another seed. Intervals of the small studies, as `report
--json` states them, are counted against the large one:

- false-alarm rate of a study's own threshold: share of the large study's healthy gearboxes beyond it;
- Pd of a fault size: share of the large study's gearboxes of this size beyond it;
- a90 of a study's own threshold: size whose 10 % quantile (alarm side high) equals the threshold;
- a90 at the requested false-alarm rate: the same at the large study's own threshold;
- AUC: that of the large study at the sizes of the small ones.

--folder keeps what was computed; a further call continues there. --table prints Markdown.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

STUDY = "studies/planet-crack-ideal.toml"
SIZES = [0, 0.5, 1, 1.5, 2, 2.5, 3, 4]                  # mm
FINE = [0.5 + 0.25 * i for i in range(15)]              # mm, of the large study, which has 0 too
HEALTHY, OF_SIZE, RATE = 100, 20, 0.05
COMMON = ["sensor.sampling_Hz=1000", "sensor.low_pass_Hz=400", "sensor.encoder_sampling_Hz=500",
          "sensor.noise_levels=[1]", 'numerics.integrator="central-difference"', 'numerics.precision="single"',
          "numerics.settle_tolerance=1e-4", 'sensor.noise_m_s2={distribution="lognormal", median=0.3, cv=0.2}',
          f"detection.false_alarm_rate={RATE}"]
WINDOW = 'features.use=["window_ratio"]'
SHORT = "sensor.record_turns=2"
REASSEMBLED = [
    "features.baseline_torque_scatter=0.02", "gearbox.pin_tangential_rms_um=20", 'features.baseline_redraws=["pins"]',
    'sensor.path_exponent={distribution="uniform", low=-0.1, high=0.1, per="assembly"}',
    'gearbox.planet.bearing_stiffness_N_m={distribution="lognormal", median=1e8, cv=0.2, per="assembly"}']
CASES = {
    "short": ("short records", [WINDOW, SHORT]),
    "reassembled": ("re-assembled baselines", ['features.use=["own_window_ratio"]'] + REASSEMBLED),
    "combined": ("combined noise", [WINDOW, "sensor.noise_density_m_s2_per_sqrt_Hz=0.02", "sensor.quantisation_m_s2=1"]),
    "records": ("short records, four of each healthy gearbox",
                [WINDOW, SHORT, "ensemble.threshold_records=4"]),
}
LARGE_SEED = 1_000_000


def run(program: str, keys: list[str], seed: int, sizes: list[float], healthy: int, graded: int, out: pathlib.Path,
        threads: int) -> None:
    levels = f'fault.depth_mm={{distribution="levels", values={sizes}}}'
    more = COMMON + keys + [levels, f"ensemble.threshold_instances={healthy}", f"ensemble.instances={graded}"]
    command = [program, "run", STUDY, "--quiet", "--force", "--seed", str(seed), "--out", str(out)]
    for key in more:
        command += ["--set", key]
    done = subprocess.run(command, capture_output=True, text=True, check=False,
                          env=os.environ | {"OMP_NUM_THREADS": str(threads)})
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stderr}")


def intervals(program: str, keys: list[str], seed: int) -> dict:
    """Runs a small study and returns the parts of its report that are counted."""
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "r.h5"
        run(program, keys, seed, SIZES, HEALTHY, OF_SIZE * len(SIZES), out, 1)
        text = subprocess.run([program, "report", str(out), "--json", "-"], capture_output=True, text=True,
                              check=True).stdout
    report = json.loads(text)
    level = report["detection"]["features"][0]["levels"][0]
    reliability = report["reliability"]["features"][0]["levels"][0]
    at_rate = [p["a90"] for p in reliability["by_false_alarm_rate"]["points"] if p["false_alarm_rate"] == RATE]
    return {"seed": seed, "threshold": level["threshold"], "threshold_rate": level["threshold_rate"],
            "healthy_rate": level["healthy_rate_bounds"], "a90": reliability["hit_miss"]["a90"],
            "a90_line": reliability["signal_response"]["a90"],
            "pd": [[1e3 * s["size_low"], s["lower"], s["upper"], *s["exact"]] for s in level["sizes"]],
            "a90_at_rate": at_rate[0] if at_rate else None, "auc": reliability["auc"],
            "smallest": report["smallest_fault"][0]}


class Truth:
    """Values of the large study: healthy ones, and by fault size in mm. Alarms are high."""

    def __init__(self, path: pathlib.Path) -> None:
        with h5py.File(path) as file:
            values = next(iter(file["features"].values()))[:, 0]
            size = np.round(1e3 * file["instances/fault_depth_m"][:], 6)
            graded = file["instances/group"][:] == 1
        self.of_size = {s: np.sort(values[graded & (size == s)]) for s in [0, *FINE]}
        self.healthy = np.sort(np.concatenate([values[~graded], self.of_size[0]]))
        self.tenth = np.maximum.accumulate([np.quantile(self.of_size[s], 0.1) for s in FINE])
        self.threshold = float(np.quantile(self.healthy, 1 - RATE))
        faulty = np.concatenate([self.of_size[s] for s in SIZES if s > 0])
        self.auc = float(np.mean(np.searchsorted(self.healthy, faulty) / len(self.healthy)))

    @staticmethod
    def beyond(values: np.ndarray, threshold: float) -> float:
        return 1 - np.searchsorted(values, threshold, side="right") / len(values)

    def pd(self, size: float, threshold: float) -> float:
        """At any size between the tested ones, by linear interpolation."""
        shares = [self.beyond(self.of_size[s], threshold) for s in [0, *FINE]]
        return float(np.interp(size, [0, *FINE], shares))

    def a90(self, threshold: float) -> float:
        """In mm; infinite beyond the tested sizes."""
        if threshold > self.tenth[-1]:
            return math.inf
        return float(np.interp(threshold, self.tenth, FINE)) if threshold >= self.tenth[0] else -math.inf


def place(estimate: dict) -> float:
    """Size in mm; not reached lies above all sizes, below the tested ones below."""
    return {"reached": 1e3 * (estimate["size"] or 0), "not_reached": math.inf,
            "below_tested": -math.inf}[estimate["where"]]


def counted(truth: Truth, studies: list[dict]) -> dict[str, list[bool]]:
    """For each statement whether it holds, for the studies that make it."""
    held: dict[str, list[bool]] = {}

    def count(name: str, holds: bool) -> None:
        held.setdefault(name, []).append(bool(holds))

    for study in studies:
        threshold = study["threshold"]
        rate = truth.beyond(truth.healthy, threshold)
        for name, key in (("false-alarm rate of the threshold", "threshold_rate"),
                          ("the same, with healthy test gearboxes", "healthy_rate")):
            count(name, study[key][0] <= rate <= study[key][1])
        for size, lower, upper, least, most in study["pd"]:
            pd = truth.beyond(truth.of_size[size], threshold)
            count(f"Pd of {size:g} mm (true: {{pd:.2f}})", lower <= pd <= upper)
            held.setdefault(f"true {size:g}", []).append(pd)
            count("Pd of all sizes", lower <= pd <= upper)
            count("Pd of all sizes, Clopper-Pearson", least <= pd <= most)
        for name, key, a90 in (("a90", "a90", truth.a90(threshold)), ("a90 of a line", "a90_line", truth.a90(threshold))):
            if study[key] is not None:
                count(f"{name}: upper bound (a90/95)", a90 <= place(study[key]["upper"]))
                count(f"{name}: lower bound", place(study[key]["lower"]) <= a90)
        if (at_rate := study["a90_at_rate"]) is not None:
            a90 = truth.a90(truth.threshold)
            count("a90 at the requested false-alarm rate", place(at_rate["lower"]) <= a90 <= place(at_rate["upper"]))
        if study["smallest"] is not None and study["smallest"]["size"] is not None:
            count("headline: Pd of the size is 90 % or more",
                  truth.pd(1e3 * study["smallest"]["size"], threshold) >= 0.9)
        count("area under the ROC curve", study["auc"]["lower"] <= truth.auc <= study["auc"]["upper"])
    for size in SIZES:
        name = f"Pd of {size:g} mm (true: {{pd:.2f}})"
        held[name.format(pd=np.mean(held.pop(f"true {size:g}")))] = held.pop(name)
    return held


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", choices=CASES, action="append")
    parser.add_argument("--studies", type=int, default=500)
    parser.add_argument("--large", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--program", default="build/gearpod")
    parser.add_argument("--folder", type=pathlib.Path)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.folder or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for case in options.case or CASES:
            title, keys = CASES[case]
            done = folder / f"{case}.jsonl"
            studies = [json.loads(line) for line in done.read_text().splitlines()] if done.exists() else []
            known = {study["seed"] for study in studies}
            left = [seed for seed in range(1, options.studies + 1) if seed not in known]
            with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, done.open("a", encoding="utf-8") as file:
                for study in pool.map(lambda seed: intervals(options.program, keys, seed), left):
                    studies.append(study)
                    file.write(json.dumps(study) + "\n")
                    file.flush()
            large = folder / f"{case}-large.h5"
            if not large.exists():
                partial = large.with_suffix(".part.h5")
                # One record of each gearbox: the truth is the rate of a random record.
                run(options.program, [k for k in keys if "threshold_records" not in k], LARGE_SEED, [0, *FINE],
                    8 * options.large, options.large * (1 + len(FINE)), partial, options.jobs)
                partial.rename(large)
            for name, holds in counted(Truth(large), studies[:options.studies]).items():
                share, n = np.mean(holds), min(len(holds), len(studies))
                error = math.sqrt(share * (1 - share) / n)  # several sizes of a study count as one
                print(f"| {title} | {name} | {100 * share:.1f} ± {100 * error:.1f} | {len(holds)} |" if options.table
                      else f"{title:30} {name:50} {100 * share:5.1f} +- {100 * error:.1f} % of {len(holds)}", flush=True)


if __name__ == "__main__":
    main()
