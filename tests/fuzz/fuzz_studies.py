#!/usr/bin/env python3
"""Reads mutated study files in child processes: no crash, no hang, no accepted file with invalid values.

    fuzz_studies.py READER SEED SECONDS

READER is the program check_studies, which checks one file after another."""
import collections
import concurrent.futures
import os
import select
import subprocess
import sys
import time

from mutation import mutated

LONGEST_S = 25  # for one file; 10 s on an idle machine
PROMISES = ("refused", "accepted", "set up")  # answers of the reader that are no failure


def answer(reader, data, until):
    """Statement of the reader about one file; None if the time ended before."""
    try:
        reader.stdin.write(b"%d\n%b" % (len(data), data))
        reader.stdin.flush()
    except BrokenPipeError:
        return "ends the program"
    left_s = max(0.0, until - time.monotonic())
    if not select.select([reader.stdout], [], [], min(left_s, LONGEST_S))[0]:
        return "is not done with" if left_s > LONGEST_S else None
    return reader.stdout.readline().decode().strip() or "ends the program"


def try_files(program, first, step, until):
    """Tries files first, first + step, ... until the time is over or one fails; returns how often each answer was given."""
    counts = collections.Counter()
    with subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as reader:
        number = first
        while time.monotonic() < until:
            found = answer(reader, mutated(number), until)
            if found is None:
                break
            counts[found] += 1
            if found not in PROMISES:
                print(f"file {number}: {found}\n{mutated(number).decode('utf-8', 'replace')}", file=sys.stderr, flush=True)
                break
            number += step
        reader.kill()
    return counts


def main():
    program, seed, seconds = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    count, until = os.cpu_count() or 1, time.monotonic() + seconds
    with concurrent.futures.ThreadPoolExecutor(count) as pool:
        tasks = [pool.submit(try_files, program, seed * 10**9 + i, count, until) for i in range(count)]
    counts = sum((task.result() for task in tasks), collections.Counter())
    print(f"{counts.total()} study files tried: " + ", ".join(f"{number} {found}" for found, number in counts.items()))
    return 0 if set(counts) <= set(PROMISES) and counts["accepted"] else 1


if __name__ == "__main__":
    sys.exit(main())
