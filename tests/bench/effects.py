#!/usr/bin/python3
"""Time of one step of rk4 per gearbox with each effect, relative to none: runs bench_effects.

    tests/bench/effects.py [--rounds 7] [--build build] [--json FILE]

Every case is measured several times in random order. Times are medians. A ratio is that of one
repetition to the same repetition without effects.
"""
import statistics

from measuring import arguments, benchmark_runs, parsed, ratio, show, table

SCENES = {"translational": "x, y, rotation", "rotations": "rotations",
          "rotations-unbalanced": "rotations, planets out of balance", "fixed-shaft": "fixed-shaft"}
EFFECTS = ["none", "inertial-terms", "transmission-error", "mesh-error", "separation", "torque-sine", "torque-noise", "gravity",
           "torque-sine+gravity", "speed-sine", "speed-noise", "all"]
# Cases that bench_effects measures although the scene lacks some of their effects.
PARTIAL = {("rotations", "torque-sine+gravity"), ("rotations-unbalanced", "torque-sine+gravity"),
           ("rotations-unbalanced", "all")}


def main() -> None:
    options = parsed(arguments(__doc__, 7))
    times = {tuple(name.split("/")[:2]): [1e9 * run["a_step"] for run in runs]
             for name, runs in benchmark_runs(options.build, "bench_effects", options.rounds, 0.2).items()}
    times = {case: own for case, own in times.items() if case not in PARTIAL}
    ratios = {}
    for (scene, effect), own in times.items():
        if effect != "none":
            ratios[f"{SCENES[scene]}: {effect}"] = ratio([a / b for a, b in zip(own, times[scene, "none"])])
    columns = ["effects"] + [text for words in SCENES.values() for text in (words + ", ns", "over none")]
    rows = []
    for effect in EFFECTS:
        row: list[str | float] = [effect]
        for scene, words in SCENES.items():
            own = times.get((scene, effect))
            row.append(statistics.median(own) if own else "-")
            row.append(ratios.get(f"{words}: {effect}", ""))
        rows.append(row)
    show({"tables": [table(columns, rows)], "ratios": ratios}, options)


if __name__ == "__main__":
    main()
