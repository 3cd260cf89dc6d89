#!/usr/bin/python3
"""Extracts the columns that features use from the output of gearpod simulate.

signals.py SIMULATED.csv with-te|without-te > SIGNAL.csv
"""
import csv
import sys

with open(sys.argv[1], newline="") as file:
    rows = list(csv.reader(file))
names = [name.split(" [")[0] for name in rows[0]]
te = sys.argv[2] == "with-te"
print("mesh_phase [mesh periods],sensor [m/s^2]" + (",te [rad]" if te else ""))
for row in rows[1:]:
    value = dict(zip(names, map(float, row)))
    print(f"{value['mesh_phase']:.12g},{value['sensor_noise_1']:.8g}" +
          (f",{value['te']:.12g}" if te else ""))
