#!/usr/bin/env python3
"""Writes the case files: three planetary gear sets with fixed index errors of every flank."""
import json
import math
import pathlib

import numpy as np

CASES = pathlib.Path(__file__).resolve().parent / "cases"


def disc(mass, radius_mm):
    return mass * (1e-3 * radius_mm)**2 / 2


def case(name, title, teeth, planets, module, width, torque, errors_um, seed, speed=8.87, waves_um=0.0, **more):
    zs, zp, zr = teeth
    helix = math.radians(more.get("helix_angle_deg", 0.0))
    transverse = module / math.cos(helix)
    draw = np.random.default_rng(seed)

    def flank(z):
        turn = 2 * np.pi * np.arange(z) / z
        wave = waves_um * math.sqrt(2) * np.sin(turn + draw.uniform(0, 2 * np.pi))
        return [round(v, 2) for v in (draw.normal(0, errors_um, z) + wave).tolist()]

    spacing = 360 / (zs + zr)
    positions = [spacing * round((zs + zr) * p / planets) for p in range(planets)]
    mass = dict(carrier=10.0, ring=5.982, sun=0.7, planet=1.822)
    radius = dict(carrier=transverse * (zs + zp) / 2, ring=transverse * zr / 2, sun=transverse * zs / 2,
                  planet=transverse * zp / 2)
    values = dict(
        title=title, planets=planets, teeth=teeth, module_mm=module, pressure_angle_deg=20.0, face_width_mm=width,
        young_modulus_Pa=2.068e11, poisson_ratio=0.3, planet_positions_deg=positions, torque_N_m=torque,
        carrier_speed_rpm=speed, mesh_damping_ratio=0.07, mass_kg=mass,
        inertia_kg_m2={b: disc(m, radius[b]) for b, m in mass.items()},
        bearing_N_m=dict(carrier=1e8, ring=1e8, sun=1e8, planet=1e8),
        bearing_N_s_m=dict(carrier=1.5e3, ring=1.5e3, sun=1.5e3, planet=1.5e3), support_N_m=1e8, support_N_s_m=1.5e3,
        run_in=8, meshes=12, steps=32000, samples_per_mesh=2000)
    values.update(more)
    values.update(sun_index_um=flank(zs), planet_index_um=[flank(zp) for _ in range(planets)],
                  planet_ring_side_index_um=[flank(zp) for _ in range(planets)], ring_index_um=flank(zr))
    CASES.mkdir(exist_ok=True)
    lines = [f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in values.items()]
    (CASES / f"{name}.json").write_text("{\n" + ",\n".join(lines) + "\n}\n")


case("relief", "23/29/81 with relief, index errors and pin errors", [23, 29, 81], 3, 3.175, 38.1, 600.0, 4.0, 1,
     tip_relief_um=[8, 8, 6], tip_relief_length_mm=[2.4, 2.4, 2.4], pin_tangential_um=[15, -10, 0])
case("helical", "Helical 21/39/99, 8 degrees", [21, 39, 99], 3, 3.0, 40.0, 900.0, 2.0, 2, helix_angle_deg=8.0,
     slices=256)
case("heavy", "19/31/81 at 3 kN m, small index errors", [19, 31, 81], 4, 3.175, 38.1, 3000.0, 1.2, 3, waves_um=1.0)
