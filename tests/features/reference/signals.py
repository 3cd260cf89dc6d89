#!/usr/bin/python3
"""Extracts the columns that features use from the output of gearpod simulate.

signals.py SIMULATED.csv with-te|without-te SIGNAL.h5 COMMAND
"""
import csv
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
from reference_tables import TableFile

simulated, te, out, command = sys.argv[1:]
with open(simulated, newline="") as file:
    rows = list(csv.reader(file))
names = [name.split(" [")[0] for name in rows[0]]
sensor = [float(row[names.index("sensor_noise_1")]) for row in rows[1:]]
mean = sum(sensor) / len(sensor)
te = te == "with-te"
with TableFile(out, "gearpod simulate of small.toml, and signals.py: README.md", command) as table:
    table.write("mesh_phase [mesh periods],sensor [m/s^2]" + (",te [rad]" if te else "") + "\n")
    for row in rows[1:]:
        value = dict(zip(names, map(float, row)))
        table.write(f"{value['mesh_phase']:.12g},{value['sensor_noise_1'] - mean:.17g}" +
                    (f",{value['te']:.12g}" if te else "") + "\n")
