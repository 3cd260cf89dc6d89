#!/usr/bin/python3
"""Speed of two threads, and of two ranks, relative to one: interleaved rounds, medians.

    tests/bench/scaling.py [--rounds 3] [--instances 8000] [--study studies/reference-10k.toml]
                           [--program build/gearpod]

A round runs the study with one thread and with two, and under mpirun with one rank and with two of
one thread each. Prints the wall time of every run and the medians of the ratios within a round.
"""
import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time

MPIRUN = ["mpirun", "--bind-to", "none", "-n"]


def seconds(command: list[str], environment: dict[str, str]) -> float:
    start = time.perf_counter()
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return time.perf_counter() - start


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--instances", type=int, default=8000)
    parser.add_argument("--study", default="studies/reference-10k.toml")
    parser.add_argument("--program", default="build/gearpod")
    options = parser.parse_args()

    environment = dict(os.environ)
    if os.geteuid() == 0:  # as in a container
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    with tempfile.TemporaryDirectory() as folder:

        def run(launcher: list[str], threads: int) -> float:
            return seconds(
                launcher
                + [options.program, "run", options.study, "--quiet", "--out", folder + "/r.h5"]
                + ["--instances", str(options.instances)]
                + ["--set", f"numerics.threads={threads}"],
                environment,
            )

        threads, ranks = [], []
        for i in range(options.rounds):
            one, two = run([], 1), run([], 2)
            one_rank, two_ranks = run(MPIRUN + ["1"], 1), run(MPIRUN + ["2"], 1)
            threads.append(one / two)
            ranks.append(one_rank / two_ranks)
            print(
                f"round {i + 1}: 1 thread {one:.2f} s, 2 threads {two:.2f} s ({threads[-1]:.3f});"
                f" 1 rank {one_rank:.2f} s, 2 ranks {two_ranks:.2f} s ({ranks[-1]:.3f})",
                flush=True,
            )
    for name, ratios in (("two threads", threads), ("two ranks", ranks)):
        print(
            f"{name}: {statistics.median(ratios):.3f} times one"
            f" ({min(ratios):.3f} to {max(ratios):.3f})"
        )


if __name__ == "__main__":
    main()
