#!/usr/bin/python3
"""Effect of a sampling plan on the scatter of thresholds, detection rates and a90 at equal cost.

    tests/bench/sampling_plans.py STUDY.toml [--plans plain,sobol] [--seeds 100] [--instances 210]
        [--healthy 120] [--feature NAME] [--jobs 2] [--program build/gearpod] [--set KEY=VALUE ...]

Runs the study once per seed and plan with equal numbers of gearboxes. For every noise level it
prints variances over the seeds: of the threshold, of its false-alarm rate among the healthy
gearboxes of all runs, of Pd at the size where the plain plan detects about half, of Pd of all sizes
together (mean of the variances), and of a90. The ratio of the first plan's variances to another's
is the factor in gearboxes that the first plan would need. A ratio of variances from n seeds each
has a 95 % interval of F(n - 1, n - 1), printed once. "Covered" is the frequency with which the
interval of Pd contains the share that the run's threshold detects among the gearboxes of all runs.
"""
import argparse
import concurrent.futures
import os
import tempfile

import h5py
import numpy as np

from measuring import finished


def command_line() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("study", metavar="STUDY.toml")
    parser.add_argument("--plans", default="plain,sobol")
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--instances", type=int, default=210)
    parser.add_argument("--healthy", type=int, default=120)
    parser.add_argument("--feature", help="by default each")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time, a thread each")
    parser.add_argument("--program", default="build/gearpod")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    return parser.parse_args()


def one_run(args: argparse.Namespace, plan: str, seed: int, folder: str) -> dict:
    """Results by (feature, level): threshold, pd by size, their bounds, a90, healthy values."""
    out = os.path.join(folder, f"{plan}-{seed}.h5")
    settings = [f"--set={setting}" for setting in args.set]
    finished(
        [args.program, "run", args.study, "--out", out, "--quiet", "--force", f"--seed={seed}"]
        + [f"--instances={args.instances}", "--set=numerics.threads=1"]
        + [f"--set=ensemble.threshold_instances={args.healthy}"]
        + [f"--set=ensemble.sampling={plan}"]
        + settings
    )
    with h5py.File(out) as file:
        healthy = file["/instances/group"][:] == 0
        sizes = file["/instances/" + file["/detection"].attrs["size_name"]][:][~healthy]
        tested = np.unique(sizes)
        found = {}
        for name, group in file["/detection"].items():
            for place, level in enumerate(file["/noise_levels"][:]):
                values = file["/features"][name][:, place]
                graded = [values[~healthy][sizes == size] for size in tested]
                threshold = group["threshold"][place]
                found[name, level] = {
                    "alarm": file["/features"][name].attrs["alarm"],
                    "threshold": threshold,
                    "sizes": tested,
                    "pd": group["pd"][place],
                    "lower": group["lower"][place],
                    "upper": group["upper"][place],
                    "a90": size_found(tested, group["tested"][place], group["detected"][place]),
                    "healthy": values[healthy],
                    "graded": graded,
                }
    os.remove(out)
    return found


def size_found(sizes: np.ndarray, tested: np.ndarray, detected: np.ndarray) -> float:
    """a90 of a logistic curve over the sizes, by maximum likelihood; NaN if they separate."""
    x = np.column_stack([np.ones(len(sizes)), sizes / np.max(sizes)])
    beta = np.zeros(2)
    for _ in range(50):
        rate = 1 / (1 + np.exp(-x @ beta))
        information = (x.T * (tested * rate * (1 - rate))) @ x
        if not np.linalg.cond(information) < 1e10:
            return np.nan
        beta = beta + np.linalg.solve(information, x.T @ (detected - tested * rate))
        if np.abs(beta).max() > 1e3:
            return np.nan
    return float((np.log(9) - beta[0]) / beta[1] * np.max(sizes))


def alarm_rates(runs: list[dict], key: tuple, pool: np.ndarray) -> np.ndarray:
    """False-alarm rates of every run's threshold among some gearboxes."""
    ordered = np.sort(pool[np.isfinite(pool)])
    below = np.searchsorted(ordered, [run[key]["threshold"] for run in runs]) / len(ordered)
    return below if runs[0][key]["alarm"] == "low" else 1 - below


def covered(runs: list[dict], key: tuple, pools: list[np.ndarray]) -> float:
    """Percentage of the intervals of Pd, where it is not 0 or 1, that contain the share which
    their run's threshold detects among the gearboxes of all runs."""
    held = []
    for size, pool in enumerate(pools):
        rates = alarm_rates(runs, key, pool)
        for run, rate in zip(runs, rates):
            if 0.02 < rate < 0.98:
                held.append(run[key]["lower"][size] <= rate <= run[key]["upper"][size])
    return 100 * float(np.mean(held)) if held else np.nan


def variance(values: np.ndarray) -> float:
    values = values[np.isfinite(values)]
    return float(np.var(values, ddof=1)) if len(values) > 2 else np.nan


def main() -> None:
    args = command_line()
    plans = args.plans.split(",")
    with tempfile.TemporaryDirectory() as folder:
        with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
            tasks = {
                plan: [
                    pool.submit(one_run, args, plan, 1000 + seed, folder)
                    for seed in range(args.seeds)
                ]
                for plan in plans
            }
            runs = {plan: [task.result() for task in tasks[plan]] for plan in plans}
    chance = np.random.default_rng(1).chisquare(args.seeds - 1, (2, 200_000))
    low, high = np.quantile(chance[0] / chance[1], [0.025, 0.975])
    print(
        f"{args.study}: {args.instances} graded and {args.healthy} healthy gearboxes, "
        f"{args.seeds} seeds; ratios of equal variances lie in {low:.2f} to {high:.2f}"
    )
    print("| feature, noise | plan | threshold | its rate | half found | Pd | Pd, all | a90 | covered |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for key in runs[plans[0]][0]:
        if args.feature and key[0] not in args.feature.split(","):
            continue
        everything = [run[key] for plan in plans for run in runs[plan]]
        truth = np.nanmean([run["pd"] for run in everything], axis=0)
        healthy = np.concatenate([run["healthy"] for run in everything])
        pools = [
            np.concatenate([run["graded"][size] for run in everything])
            for size in range(len(truth))
        ]
        half = int(np.argmin(np.abs(truth - 0.5)))
        first = None
        for plan in plans:
            own = [run[key] for run in runs[plan]]
            pd = np.array([run["pd"] for run in own])
            numbers = [
                variance(np.array([run["threshold"] for run in own])),
                variance(alarm_rates(runs[plan], key, healthy)),
                variance(pd[:, half]),
                float(np.nanmean(np.nanvar(pd, axis=0, ddof=1))),
                variance(np.array([run["a90"] for run in own])),
            ]
            if first is None:
                first = numbers
                cells = [f"{n:.3g}" for n in numbers]
            else:
                cells = [f"x {a / b:.2f}" if b > 0 else "-" for a, b in zip(first, numbers)]
            cells.insert(2, f"{own[0]['sizes'][half]:g} ({truth[half]:.2f})")
            held = covered(runs[plan], key, pools)
            print(f"| {key[0]}, {key[1]:g} | {plan} | {' | '.join(cells)} | {held:.0f} % |")


if __name__ == "__main__":
    main()
