"""Computes a user-defined feature over some gearboxes: python3 own_feature.py RESULTS"""

import sys

import gearpod
import numpy as np

results = gearpod.open(sys.argv[1])
graded = results.rows("graded")
healthy = graded[results.size[graded] == 0.0][:2]
cracked = graded[results.size[graded] == results.size.max()][:2]
for name, rows in (("healthy", healthy), ("cracked", cracked)):
    for row in rows:
        x = results.signals(int(row))["sensor"]
        print(f"row {row}, {name}: crest factor {np.max(np.abs(x)) / np.sqrt(np.mean(x**2)):.3f}")
