#!/usr/bin/env python3
"""Compares the loaded transmission error of `gearpod stiffness --te` with the tables of this folder.
Usage: compare.py GEARPOD [SET ...]. Sets of three external and internal pairs, two loads, both onsets, with and without relief."""
import csv
import io
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from corner_contact import LIANG, bell_pairs
from gear_mesh import MeshTable, Relief

STUDY = """[gearbox]
kind = "planetary"
planets = 4
{teeth}
module_mm = 3.175
pressure_angle_deg = 20
face_width_mm = 38.1
young_modulus_Pa = 2.068e11
poisson_ratio = 0.3
tooth_profile = "root-circle"
{relief}
sun.mass_kg = 0.7
planet.mass_kg = 1.822
ring.mass_kg = 5.982
carrier.mass_kg = 10
sun.bearing_stiffness_N_m = 1e8
planet.bearing_stiffness_N_m = 1e8
ring.bearing_stiffness_N_m = 1e8
carrier.bearing_stiffness_N_m = 1e8
support_stiffness_N_m = 1e8
mesh_damping_ratio = 0.07
[operation]
torque_N_m = {torque}
carrier_speed_rpm = 8.87
[effects]
contact_onset = "{onset}"
[fault]
kind = "none"
[sensor]
sampling_Hz = 5000
low_pass_Hz = 800
noise_m_s2 = 0
encoder_sampling_Hz = 1250
noise_levels = [0]
[ensemble]
instances = 1
threshold_instances = 1
seed = 1
"""


def program_table(program, text, error):
    with tempfile.TemporaryDirectory() as folder:
        study = pathlib.Path(folder) / "study.toml"
        study.write_text(text)
        command = [program, "stiffness", str(study), "--csv", "-"] + (["--te"] if error else [])
        done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr + done.stdout)
    rows = list(csv.DictReader(io.StringIO(done.stdout[done.stdout.index("phase"):])))
    return {key: np.array([float(row[key]) for row in rows if row[key]]) for key in rows[0]}


def main():
    program = sys.argv[1]
    columns = sys.argv[2:]
    sets = {"19/31/81": ("sun.teeth = 19\nplanet.teeth = 31\nring.teeth = 81", LIANG),
            "27/35/99": ("sun.teeth = 27\nplanet.teeth = 35\nring.teeth = 99\nsun.shift = 0.3\n"
                         "centre_distance_mm = 100.0125", bell_pairs())}
    for name, (teeth, pairs) in sets.items():
        if columns and name not in columns:
            continue
        for amount in (0.0, 10.0):
            for onset in ("abrupt", "extended"):
                for torque in (429.0, 3000.0):
                    relief = "\n".join(f"{m}_tip_relief_um = {amount}\n{m}_tip_relief_length_mm = 3.0"
                                       for m in ("sun", "planet", "ring")) if amount else ""
                    text = STUDY.format(teeth=teeth, relief=relief, torque=torque, onset=onset)
                    table = program_table(program, text, True)
                    for column, pair in zip(("sp1_te_um", "rp1_te_um"), pairs):
                        mesh = MeshTable(pair, onset, Relief(1e-6 * amount, 3e-3, 1e-6 * amount, 3e-3))
                        theirs = table[column]
                        phase = table["phase"] - pair.start / pair.base_pitch
                        if column[0] == "r":  # a planet's tooth turns from the sun's to the ring's pitch point
                            half = [float(g.half_angle(g.base / np.cos(p.working_angle)))
                                    for g, p in zip((pair.one,) * 2, pairs)]
                            phase -= (np.pi - sum(half)) * pair.one.teeth / (2 * np.pi)
                        ours = 1e6 * mesh.deflection(phase, torque / 4 / pairs[0].one.base)[0]
                        span = np.ptp(ours)
                        off = np.abs(ours - theirs)
                        print(f"{name} {column[:3]} relief {amount:4.0f} um, {onset:8} {torque:6.0f} N m: mean {ours.mean():.4f} here, "
                              f"{theirs.mean():.4f}; peak to peak {span:.4f}, {np.ptp(theirs):.4f}; difference rms "
                              f"{100 * np.sqrt((off**2).mean()) / span:.2f} %, largest {100 * off.max() / span:.2f} % of the peak to peak",
                              flush=True)


if __name__ == "__main__":
    main()
