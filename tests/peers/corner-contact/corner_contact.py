#!/usr/bin/env python3
"""Corner contact of involute pairs by geometry alone: gap outside the path of contact (gap.h5), and loaded
transmission error and load share through the change-over (loaded.h5). Tables of README.md."""
import csv
import math
import pathlib
import sys

import numpy as np

from gear_mesh import Gear, GearPair, MeshTable, planetary_pairs

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1]))
from reference_tables import TableFile
LIANG = planetary_pairs(3.175e-3, (19, 31, 81))


def without_backlash(module, teeth, sun_shift, distance):
    """Shifts of sun, planet and ring without backlash at a given centre distance (ISO 21771)."""
    alpha = math.radians(20)
    inv = lambda a: math.tan(a) - a
    zs, zp, zr = teeth
    shifts = [sun_shift]
    for a, b, sign in ((zs, zp, 1), (zp, zr, -1)):
        working = math.acos(module * (b + sign * a) / 2 * math.cos(alpha) / distance)
        total = (inv(working) - inv(alpha)) * (b + sign * a) / (2 * math.tan(alpha))
        shifts.append(sign * total - shifts[-1])
    return tuple(shifts)


def shifted_pair():
    """17/43, module 4 mm, both shifted by 0.3, with the usual tip shortening (tip clearance 0.25 modules)."""
    module, one, two = 4e-3, 17, 43
    distance = GearPair(Gear(one, module, 0.3), Gear(two, module, 0.3)).distance
    shortening = module * ((one + two) / 2 + 0.6) - distance
    tips = [module * (z / 2 + 1.3) - shortening for z in (one, two)]
    return GearPair(Gear(one, module, 0.3, tip=tips[0]), Gear(two, module, 0.3, tip=tips[1]), face_width=0.02)


def bell_pairs():
    """27/35/99 of studies/bell-206b.toml; sun and planet with the usual tip shortening."""
    module, distance = 3.175e-3, 0.1000125
    shifts = without_backlash(module, (27, 35, 99), 0.3, distance)
    shortening = module * ((27 + 35) / 2 + shifts[0] + shifts[1]) - distance
    tips = [module * (z / 2 + 1 + x) - shortening for z, x in zip((27, 35), shifts)]
    return planetary_pairs(module, (27, 35, 99), shifts, distance, (*tips, 0.0))


def pairs():
    bell = bell_pairs()
    return {"19/31 external": LIANG[0], "31/81 internal": LIANG[1], "17/43 shifted": shifted_pair(),
            "27/35 external": bell[0], "35/99 internal": bell[1]}


def table_file(name):
    return TableFile(HERE / name, "geometry and quadrature (gear_mesh.py) of tests/peers/corner-contact, see its README.md",
                     " ".join(sys.argv))


def write_gaps(name):
    with table_file(name) as file:
        table = csv.writer(file)
        table.writerow(["pair", "base_pitches_outside", "gap_before_start_um", "gap_after_end_um",
                        "before_um_at_one_path", "after_um_at_one_path"])
        for label, pair in pairs().items():
            for t in (0.005, 0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5):
                outside = t * pair.base_pitch
                before, after = pair.gap(pair.start - outside), pair.gap(pair.end + outside)
                path_share = (outside / pair.path_length)**2
                table.writerow([label, t] + [f"{1e6 * v:.5f}" for v in (before, after)]
                               + [f"{1e6 * v / path_share:.1f}" for v in (before, after)])


def write_loaded(name, phases=400):
    rb = LIANG[0].one.base
    phase = (np.arange(phases) + 0.5) / phases
    with table_file(name) as file:
        table = csv.writer(file)
        table.writerow(["pair", "onset", "torque_N_m", "phase", "deflection_um", "share_tau_is_phase_minus_1",
                        "share_tau_is_phase", "share_tau_is_phase_plus_1", "share_tau_is_phase_plus_2"])
        for pair in ("19/31 external", "31/81 internal"):
            for onset in ("abrupt", "extended"):
                mesh = MeshTable(pairs()[pair], onset)
                for torque in (429.0, 3000.0):
                    d, force = mesh.deflection(phase, torque / 4 / rb)
                    share = force / force.sum(1, keepdims=True)
                    for row in zip(phase, d, *share.T):
                        table.writerow([pair, onset, torque] + [f"{row[0]:.5f}", f"{1e6 * row[1]:.6f}"]
                                       + [f"{v:.6f}" for v in row[2:]])
                    print(f"{pair:15} {onset:8} {torque:6.0f} N m: mean {1e6 * d.mean():.4f} um, peak to peak "
                          f"{1e6 * np.ptp(d):.4f} um, steepest {1e6 * np.abs(np.diff(d)).max() * phases:.2f} um a period, "
                          f"one pair alone {(share.max(1) > 1 - 1e-9).mean():.3f} of the time")


if __name__ == "__main__":
    for name, pair in pairs().items():
        t = 0.003 * pair.base_pitch
        limit = [1e6 * pair.gap(s) / (t / pair.path_length)**2 for s in (pair.start - t, pair.end + t)]
        closed = [1e6 * c * pair.path_length**2 for c in pair.gap_curvature()]
        print(f"{name:15} contact ratio {pair.contact_ratio:.4f}, path {1e3 * pair.path_length:.4f} mm, working angle "
              f"{math.degrees(pair.working_angle):.4f} deg; gap at one path length {limit[0]:.0f} before, {limit[1]:.0f} um after "
              f"(closed form, in the limit: {closed[0]:.0f}, {closed[1]:.0f})")
    write_gaps("gap.h5")
    write_loaded("loaded.h5")
