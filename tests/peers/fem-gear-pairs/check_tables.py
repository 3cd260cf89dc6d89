#!/usr/bin/env python3
"""Recomputes some rows of the tables and compares them with the stored ones (ctest fem-gear-pairs
of -C long). Exits with 77 if gmsh, CalculiX, numpy, scipy or h5py are missing."""
import pathlib
import shutil
import sys

if not shutil.which("gmsh") or not shutil.which("ccx"):
    print("gmsh or CalculiX not there")
    sys.exit(77)
try:
    import numpy as np

    import cracks_fem
    import helical_fem
    import pairs_fem
    import spatial_fem
    import strip_fem
    from plane_fem import read_table
except ImportError as missing:
    print(missing)
    sys.exit(77)

FOLDER = pathlib.Path(__file__).resolve().parent
FAILED = []


def stored(table, **keys):
    columns = read_table(FOLDER / table)
    row = np.flatnonzero(np.all([columns[column] == value for column, value in keys.items()], axis=0))[0]
    return {name: column[row] for name, column in columns.items()}


def compare(what, found, row, columns, tolerance):
    for column, value in zip(columns, found):
        off = value / row[column] - 1
        print(f"{what}, {column}: {value:.6g}, stored {row[column]:.6g} ({off:+.1e})", flush=True)
        if not abs(off) < tolerance:
            FAILED.append(f"{what}, {column}")


def row_of(name, index):
    """Returns case, positions of the pairs in contact, and phase as printed in the tables."""
    pair = pairs_fem.CASES[name][0]()
    pairs, phase = pairs_fem.phases(pair.contact_ratio)[index]
    return pair, tuple(phase + i for i in range(pairs)), round(phase, 6)


def main():
    for name, index in (("bell-sun", 2), ("bell-ring", 7)):
        pair, taus, phase = row_of(name, index)
        flank, centre, gears = pairs_fem.mesh_row(1.0, pair, taus)
        compare(name, (flank, centre), stored("mesh.h5", case=name, phase=phase),
                ("flank_N_m", "centre_N_m"), 1e-3)
        tooth = stored("teeth.h5", case=name, gear=1, tau=phase)
        compare(name + ", tooth", [1e-3 * m[0, 0] for m in gears[0]], tooth,
                ("flank_m_N", "centre_m_N"), 1e-3)
    name = "liang-ring-4.28"
    pair, taus, phase = row_of(name, 7)
    compare(name, pairs_fem.mesh_row(1.0, pair, taus, 4.28, 0)[:2],
            stored("mesh.h5", case=name, phase=phase, cracked=0),
            ("flank_N_m", "centre_N_m"), 1e-3)
    compare("drop", pairs_fem.drop_row(1.0, pair, taus), stored("drop.h5", phase=phase),
            ("root_N_m", "root_centre_N_m", "base_N_m", "base_centre_N_m"), 1e-3)
    for phase, _, cracked, whole, left in cracks_fem.rows(1.0, "planet-sun", "fillet", 0.25):
        row = stored("cracks.h5", tooth="planet-sun", profile="fillet", share=0.25,
                     phase=round(phase, 6), cracked=cracked)
        compare(f"planet-sun, 25 %, at {phase + cracked:.3f}", (whole, left), row,
                ("healthy_N_m", "cracked_N_m"), 1e-3)
    plane = spatial_fem.Model(spatial_fem.SIZE, 1, "sun", plane=True)
    for (taus, cracked), found in zip(plane.groups, plane.rows("through", 0.25)):
        row = stored("cracks.h5", tooth="sun", profile="fillet", share=0.25,
                     phase=round(taus[0], 6), cracked=cracked)
        compare(f"section of spatial cracks, sun, 25 %, at {taus[0] + cracked:.3f}", found[:2], row,
                ("healthy_N_m", "cracked_N_m"), 0.02)
    compare("strip", strip_fem.factors(1.0, 0.3), stored("strip.h5", share=0.3),
            ("tension", "bending"), 1e-3)
    for what, tau, solid, slices in helical_fem.rows("helix-20", 1.5, 4):  # coarse
        if what == "mesh":
            row = stored("helical.h5", case="helix-20", what=what, tau=round(tau, 6))
            compare(f"helix-20 at {tau:.1f}", (*solid, *slices), row,
                    ("solid_N_m", "solid_weber_N_m", "slices_N_m", "slices_weber_N_m"), 0.015)
    print(f"{len(FAILED)} differ" if FAILED else "all as stored")
    return 1 if FAILED else 0


if __name__ == "__main__":
    sys.exit(main())
