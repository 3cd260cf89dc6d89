#!/usr/bin/python3
"""Speed of two threads, and of two ranks, relative to one: interleaved rounds, medians.

    tests/bench/scaling.py [--rounds 3] [--instances 8000] [--study studies/reference-10k.toml]
                           [--build build] [--json FILE]

A round runs the study with one thread and with two, and under mpirun with one rank and with two of
one thread each. The ratios are those within a round.
"""
import os
import statistics
import tempfile

from measuring import arguments, finished, parsed, ratio, show, table

MPIRUN = ["mpirun", "--bind-to", "none", "-n"]
CASES = {"1 thread": ([], 1), "2 threads": ([], 2), "1 rank": (MPIRUN + ["1"], 1), "2 ranks": (MPIRUN + ["2"], 1)}


def main() -> None:
    parser = arguments(__doc__, 3)
    parser.add_argument("--instances", type=int, default=8000)
    parser.add_argument("--study", default="studies/reference-10k.toml")
    options = parsed(parser)
    environment = dict(os.environ)
    if os.geteuid() == 0:  # as in a container
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    times: dict[str, list[float]] = {name: [] for name in CASES}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for name, (launcher, threads) in CASES.items():
                command = [options.program, "run", options.study, "--quiet", "--out", folder + "/r.h5", "--force",
                           "--instances", str(options.instances), "--set", f"numerics.threads={threads}"]
                times[name].append(finished(launcher + command, environment).wall_s)
    ratios = {f"speed of two {what}": ratio([a / b for a, b in zip(times[f"1 {what[:-1]}"], times[f"2 {what}"])])
              for what in ("threads", "ranks")}
    rows = [[f"two {what}", statistics.median(times[f"1 {what[:-1]}"]), statistics.median(times[f"2 {what}"]),
             ratios[f"speed of two {what}"]]
            for what in ("threads", "ranks")]
    show({"tables": [table(["parallel", "one, s", "two, s", "speed"], rows)], "ratios": ratios}, options)


if __name__ == "__main__":
    main()
