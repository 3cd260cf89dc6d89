#!/usr/bin/env python3
"""Runs `gearpod simulate` and planetary.py on the same gearboxes and prints relative differences of motions, mesh
deflections, mesh forces and shares of time out of contact.

Usage: compare.py GEARPOD [CASE ...] [--onset abrupt|extended] [--slices N] [--set key=value ...]

--slices: slices of helical teeth in planetary.py (the case has 256)."""
import argparse
import json
import pathlib
import re
import subprocess
import tempfile

import h5py
import numpy as np

from planetary import Planetary

HERE = pathlib.Path(__file__).resolve().parent
SAMPLES = 100  # compared points in a mesh period
BODIES = ("carrier", "ring", "sun")


def study_text(case, onset, samples):
    """The same gearbox as a study file."""
    c, gears, g = case, ("sun", "planet", "ring"), ["[gearbox]", 'kind = "planetary"']
    helical = c.get("helix_angle_deg", 0.0) > 0
    g += [f"planets = {c['planets']}", f"planet_positions_deg = {[round(p, 12) for p in c['planet_positions_deg']]}"]
    g += [f"{m}.teeth = {z}" for m, z in zip(gears, c["teeth"])]
    g += [f"{'normal_module' if helical else 'module'}_mm = {c['module_mm']}"]
    if helical:
        g.append(f"helix_angle_deg = {c['helix_angle_deg']}")
    g += [f"{key} = {c[key]}" for key in ("pressure_angle_deg", "face_width_mm", "young_modulus_Pa", "poisson_ratio",
                                          "mesh_damping_ratio")]
    g += ['tooth_profile = "root-circle"', f"support_stiffness_N_m = {c['support_N_m']}",
          f"support_damping_N_s_m = {c['support_N_s_m']}"]
    for body in ("carrier", "ring", "sun", "planet"):
        g += [f"{body}.mass_kg = {c['mass_kg'][body]}", f"{body}.inertia_kg_m2 = {c['inertia_kg_m2'][body]!r}",
              f"{body}.bearing_stiffness_N_m = {c['bearing_N_m'][body]}",
              f"{body}.bearing_damping_N_s_m = {c['bearing_N_s_m'][body]}"]
    for m, amount, length in zip(gears, c.get("tip_relief_um", (0, 0, 0)), c.get("tip_relief_length_mm", (1, 1, 1))):
        if amount:
            g += [f"{m}.tip_relief_um = {amount}", f"{m}.tip_relief_length_mm = {length}"]
    for key in ("pin_tangential_um", "pin_radial_um"):
        if key in c:
            g.append(f"{key} = {c[key]}")
    flat = lambda rows: [v for row in rows for v in row]
    g += [f"sun.index_um = {c['sun_index_um']}", f"planet.index_um = {flat(c['planet_index_um'])}",
          f"planet.ring_side_index_um = {flat(c['planet_ring_side_index_um'])}", f"ring.index_um = {c['ring_index_um']}"]
    mesh_Hz = c["carrier_speed_rpm"] / 60 * c["teeth"][2]
    rest = f"""
[operation]
fixed = "ring"
input = "sun"
torque_N_m = {c['torque_N_m']}
carrier_speed_rpm = {c['carrier_speed_rpm']}

[effects]
motion = "translational-torsional"
inertial_terms = true
mesh_damping = "ratio"
path = "rectangular"
{ONSET[onset]}

[fault]
kind = "none"

[sensor]
sampling_Hz = {samples * mesh_Hz!r}
low_pass_Hz = {0.2 * samples * mesh_Hz!r}
noise_m_s2 = 0
encoder_sampling_Hz = {samples * mesh_Hz / 4!r}
encoder_noise_arcsec = 0
noise_levels = [0]

[numerics]
horizon = "full"

[ensemble]
instances = 1
threshold_instances = 1
seed = 1
"""
    return "\n".join(g) + "\n" + rest


ONSET = {"abrupt": 'contact_onset = "abrupt"', "extended": 'contact_onset = "extended"'}


def gearpod_run(program, case, onset, settings, folder):
    """Motions by `gearpod simulate`, rows of samples, mesh forces, and contact loss of each mesh."""
    study, out = pathlib.Path(folder) / "case.toml", pathlib.Path(folder) / "case.h5"
    study.write_text(study_text(case, onset, SAMPLES))
    command = [program, "simulate", str(study), "--instance", "0", "--meshes", str(case["meshes"]), "--out", str(out)]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
    with h5py.File(out) as file:
        signals = {name: data[:] for name, data in file["signals"].items()}
        extra = {name: float(value[0]) for name, value in file["contact_loss"].items()}
    names = [f"{b}_{axis}" for b in list(BODIES) + [f"planet{p + 1}" for p in range(case["planets"])]
             for axis in "xyu"]
    if names[9] not in signals:
        names = [re.sub(r"planet(\d)_(.)", r"p\1_\2", name) for name in names]
    forces = [key for p in range(case["planets"]) for key in (f"sp{p + 1}_force", f"rp{p + 1}_force")]
    return (signals["mesh_phase"], np.column_stack([signals[name] for name in names]),
            np.column_stack([signals[f] for f in forces]) if forces[0] in signals else None, extra, signals)


def difference(ours, theirs):
    """Root mean square of the difference over that of the variation, and largest over the range."""
    scale = np.sqrt(np.mean((ours - ours.mean(0))**2))
    return np.sqrt(np.mean((ours - theirs)**2)) / scale, np.abs(ours - theirs).max() / np.ptp(ours)


def compare(program, name, onset, settings, slices=None):
    case = json.loads((HERE / "cases" / f"{name}.json").read_text())
    if slices and "slices" in case:
        case["slices"] = slices
    gearbox = Planetary(case, onset)
    with tempfile.TemporaryDirectory() as folder:
        phase, q, force, extra, signals = gearpod_run(program, case, onset, settings, folder)
    ours = gearbox.run(case["run_in"], case["meshes"], case["steps"], case["samples_per_mesh"])
    step = case["samples_per_mesh"] * (phase[1] - phase[0])
    rows = np.round(np.arange(len(phase)) * step).astype(int)
    q = gearbox.without_rotation(q)
    lines = np.array([line for _, _, line in gearbox.kind_lines])
    here = ours["q"][rows]
    print(f"{name}, {onset}: mean mesh deflections, um: {(1e6 * (here @ lines.T).mean(0)).round(4)} here, "
          f"{(1e6 * (q @ lines.T).mean(0)).round(4)} gearpod")
    report = {"motions, means included": (here, q), "motions about their means": (here - here.mean(0), q - q.mean(0)),
              "mesh deflections": (here @ lines.T, q @ lines.T)}
    if force is not None:
        report["mesh forces"] = (ours["force"][rows], force)
    for what, (a, b) in report.items():
        rms, most = difference(a, b)
        print(f"  {what}: rms difference {rms:.3e} of the variation, largest {most:.3e} of the range")
    print(f"  out of contact: sun {ours['out_of_contact'][0]:.4f}, ring {ours['out_of_contact'][1]:.4f} here; "
          f"gearpod {extra if extra else 'does not say'}")
    return gearbox, ours, rows, q, lines


def main():
    options = argparse.ArgumentParser()
    options.add_argument("gearpod")
    options.add_argument("cases", nargs="*", default=["relief", "helical", "heavy"])
    options.add_argument("--onset", choices=("abrupt", "extended"))
    options.add_argument("--slices", type=int)
    options.add_argument("--set", action="append", default=[])
    given = options.parse_args()
    for name in given.cases:
        for onset in (given.onset,) if given.onset else ("abrupt", "extended"):
            compare(given.gearpod, name, onset, given.set, given.slices)


if __name__ == "__main__":
    main()
