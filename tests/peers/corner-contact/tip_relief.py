#!/usr/bin/env python3
"""Long and short tip relief against transmission error (relief.h5): the classical rules (Munro; Smith, Gear Noise
and Vibration) with abrupt and with corner contact, teeth without and with index errors."""
import csv

import numpy as np

from corner_contact import pairs, table_file
from gear_mesh import MeshTable, Relief

PERIODS, PHASES, SEEDS = 20, 100, 4


def peak_to_peak(mesh, force, error):
    """Median over mesh periods (and drawn gears) of the peak to peak within a period, and the largest."""
    if error == 0:
        d, _ = mesh.deflection((np.arange(PHASES) + 0.5) / PHASES, force)
        return np.ptp(d), np.ptp(d)
    found = []
    for seed in range(SEEDS):
        errors = np.random.default_rng(seed).normal(0, error, (2, PERIODS)).sum(0)
        d, _ = mesh.deflection((np.arange(PERIODS * PHASES) + 0.5) / PHASES, force, errors)
        found.append(np.ptp(d.reshape(PERIODS, PHASES), axis=1))
    return np.median(found), np.max(found)


def main():
    rows = []
    for name, torque in (("19/31 external", 3000.0), ("31/81 internal", 3000.0), ("17/43 shifted", None)):
        pair = pairs()[name]
        # Design force: of the planetary set at 3 kN m; of the single pair 300 N per mm of face width.
        force = torque / 4 / pairs()["19/31 external"].one.base if torque else 300e3 * pair.face_width
        alone = force / pair.pair_stiffness(pair.contact_ratio / 2)  # deflection of one pair, at mid-path
        overlap = (pair.contact_ratio - 1) * pair.base_pitch  # from the end of the path to single contact
        for onset in ("abrupt", "extended"):
            for kind, length in (("none", 1.0), ("short", overlap / 2), ("long", overlap), ("very long", 1.5 * overlap)):
                for share in ((0.0,) if kind == "none" else (0.5, 0.75, 1.0, 1.25, 1.5)):
                    amount = share * alone
                    mesh = MeshTable(pair, onset, Relief(amount, length, amount, length))
                    for load in (0.25, 1.0):
                        for error in (0.0, 2e-6):
                            if error and share not in (0.0, 0.75, 1.0):
                                continue
                            median, most = peak_to_peak(mesh, load * force, error)
                            rows.append([name, onset, kind, f"{1e3 * length:.4f}", f"{1e6 * amount:.4f}", share, load,
                                         1e6 * error, f"{1e6 * median:.4f}", f"{1e6 * most:.4f}"])
    with table_file("relief.h5") as file:
        table = csv.writer(file)
        table.writerow(["pair", "onset", "relief", "length_mm", "amount_um", "amount_over_deflection_of_one_pair",
                        "load_over_design", "index_error_um_rms_per_flank", "median_peak_to_peak_um", "largest_um"])
        table.writerows(rows)
    for row in rows:
        if row[5] in (0.0, 1.0):
            print(f"{row[0]:15} {row[1]:8} {row[2]:9} {row[4]:>8} um over {row[3]:>7} mm, load {row[6]:.2f}, errors "
                  f"{row[7]:.0f} um: {row[8]:>8} um (largest {row[9]})")


if __name__ == "__main__":
    main()
