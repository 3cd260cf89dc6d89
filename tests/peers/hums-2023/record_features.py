#!/usr/bin/python3
"""Features of the HUMS 2023 records by `gearpod features` with studies/bell-206b.toml itself.

usage: record_features.py RECORDS.h5 [--program build/gearpod] [--every K]

RECORDS.h5 holds `sensor` (records x 4095 samples: one planet turn, 35 tooth positions of 117) with an
attribute `scale`, and `day`. A record is an average over the planet's 99 turns, so it is repeated as
often for the windows, which look at all of them. Prints the features' quantiles day by day.
"""
import argparse
import collections
import json
import pathlib
import subprocess
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
FEATURES = ["window_ratio", "window_z", "fm4", "sensor_rms"]
CARRIER_HZ, RING_TEETH, SAMPLES_PER_TOOTH = 5.73, 99, 117


def features_of(program, record, folder):
    """What the program says of one record, turns repeated."""
    path = folder / "record.h5"
    rate = CARRIER_HZ * RING_TEETH * SAMPLES_PER_TOOTH
    with h5py.File(path, "w") as out:
        # One turn more: the last sample's successor is the first one's.
        out["sensor"] = np.tile(record, RING_TEETH + 1)
        out.attrs["sampling_Hz"] = rate
    command = [program, "features", path, "--study", ROOT / "studies/bell-206b.toml", "--json", "-"]
    done = subprocess.run(command + ["--sampling-Hz", str(rate)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)["features"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("records")
    parser.add_argument("--program", default=ROOT / "build/gearpod")
    parser.add_argument("--every", type=int, default=1, help="every so many records of a day")
    options = parser.parse_args()
    found = collections.defaultdict(list)
    with h5py.File(options.records) as records, tempfile.TemporaryDirectory() as folder:
        sensor, days = records["sensor"], records["day"][:]
        for day in sorted(set(days)):
            for i in np.flatnonzero(days == day)[:: options.every]:
                record = sensor[i] * sensor.attrs["scale"]
                found[day].append(features_of(options.program, record, pathlib.Path(folder)))
    print("day  records  " + "  ".join(f"{name:>22}" for name in FEATURES) + "   (5, 50, 95 %)")
    for day, rows in found.items():
        columns = [np.quantile([row[name] for row in rows], [0.05, 0.5, 0.95]) for name in FEATURES]
        print(f"{day:3}  {len(rows):7}  " + "  ".join("{:6.3g} {:7.3g} {:7.3g}".format(*c) for c in columns))


if __name__ == "__main__":
    main()
