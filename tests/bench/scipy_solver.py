#!/usr/bin/python3
"""The default study's gearbox integrated by scipy's solve_ivp, next to gearpod.

    tests/bench/scipy_solver.py [--rounds 3] [--meshes 2] [--build build] [--json FILE]

The study is planet-crack-ideal.toml with nominal values and no fault. The equations are written as a user
of scipy would: Liang (2016), Eqs. 4.2.1-4.2.4, as y' = A(t) y + b with 42 displacements and velocities,
the mesh stiffness interpolated in the curves of `gearpod stiffness`. They start in the state of `gearpod
simulate` and have no low-pass of the sensor. The error is that of the mesh forces relative to the mean
force, after the integrated mesh periods. gearpod's times are whole commands on one thread, with noise,
features and detection: 16 gearboxes with every mesh period integrated, 512 with periodic ones. Ratios are
those within a round.
"""
import argparse
import csv
import io
import math
import re
import statistics
import tempfile
import time
import tomllib

import numpy as np
from scipy.integrate import solve_ivp

from measuring import arguments, finished, parsed, processor_s, ratio, show, table

STUDY = "studies/planet-crack-ideal.toml"
METHODS = {"RK45": {"method": "RK45"}, "LSODA": {"method": "LSODA"}}
TOLERANCE = 1e-3
BODIES = ("carrier", "ring", "sun", "planet")
MESHES = 2511  # of a record
GEARBOXES = {"full": 16, "periodic": 512}


class Gearbox:
    """Matrices of y' = A(t) y + b. Rotations are in metres on base circles (carrier: circle of pins)."""

    def __init__(self, study: dict) -> None:
        gearbox, operation = study["gearbox"], study["operation"]
        gearbox |= {f"{body}_{key}": value for body in BODIES for key, value in gearbox[body].items()}
        planets, alpha = gearbox["planets"], math.radians(gearbox["pressure_angle_deg"])
        base = {b: gearbox["module_mm"] * gearbox[b + "_teeth"] / 2e3 * math.cos(alpha) for b in ("sun", "planet", "ring")}
        pins = gearbox["module_mm"] * (gearbox["sun_teeth"] + gearbox["planet_teeth"]) / 2e3
        base["carrier"] = pins
        speed = operation["carrier_speed_rpm"] * 2 * math.pi / 60
        self.mesh_s = 2 * math.pi / speed / gearbox["ring_teeth"]
        size = 9 + 3 * planets
        mass, stiffness, damping, force = np.zeros(size), np.zeros((size, size)), np.zeros((size, size)), np.zeros(size)
        coriolis, centrifugal = np.zeros((size, size)), np.zeros((size, size))
        for i in range(3 + planets):
            body = BODIES[min(i, 3)]
            pitch = pins if body == "carrier" else base[body] / math.cos(alpha)
            m = gearbox[body + "_mass_kg"]
            mass[3 * i:3 * i + 3] = m, m, m * pitch**2 / 2 / base[body]**2  # solid discs on the pitch circles
            x, y = 3 * i, 3 * i + 1
            coriolis[x, y], coriolis[y, x] = 2 * speed, -2 * speed
            centrifugal[x, x] = centrifugal[y, y] = speed**2
            if body != "planet":
                for j in (x, y):
                    stiffness[j, j] += gearbox[body + "_bearing_stiffness_N_m"]
                    damping[j, j] += gearbox[body + "_bearing_damping_N_s_m"]
        stiffness[5, 5] += gearbox["support_stiffness_N_m"]
        damping[5, 5] += gearbox["support_damping_N_s_m"]
        force[8] = operation["torque_N_m"] / base["sun"]
        force[2] = -operation["torque_N_m"] * (1 + gearbox["ring_teeth"] / gearbox["sun_teeth"]) / pins
        pairs = np.zeros((2 * planets, size))  # deformation of sp1..spN, rp1..rpN
        for n in range(planets):
            psi, p = 2 * math.pi * n / planets, 9 + 3 * n
            for row, angle, body, own in ((n, psi + math.pi / 2 - alpha, 6, 1), (planets + n, psi + math.pi / 2 + alpha, 3, -1)):
                direction = np.array([math.cos(angle), math.sin(angle)])
                pairs[row, body:body + 2], pairs[row, p:p + 2] = direction, -direction
                pairs[row, body + 2], pairs[row, p + 2] = 1, own
            pin = np.zeros((2, size))
            pin[0, [p, 0, 2]] = 1, -1, math.sin(psi)
            pin[1, [p + 1, 1, 2]] = 1, -1, -math.cos(psi)
            stiffness += gearbox["planet_bearing_stiffness_N_m"] * pin.T @ pin
            damping += gearbox["planet_bearing_damping_N_s_m"] * pin.T @ pin
            force[p:p + 2] += mass[p] * pins * speed**2 * np.array([math.cos(psi), math.sin(psi)])
        zero, one = np.zeros((size, size)), np.eye(size)
        self.constant = np.block([[zero, one], [centrifugal - stiffness / mass[:, None], coriolis - damping / mass[:, None]]])
        self.load = np.concatenate([np.zeros(size), force / mass])
        self.pairs, self.to_rates = pairs, -(pairs / mass).T
        # Damping ratio of a pair: 2 zeta sqrt(k m), with the equivalent mass of the two gears' rotations.
        rotation = mass[2::3]
        pair_mass = [1 / (1 / rotation[b] + 1 / rotation[3]) for b in (2, 1) for _ in range(planets)]
        self.damping = 2 * gearbox["mesh_damping_ratio"] * np.sqrt(pair_mass)


def columns(text: str) -> dict[str, np.ndarray]:
    rows = list(csv.reader(io.StringIO(text)))
    values = np.array(rows[1:], dtype=float)
    return {name.partition(" [")[0]: values[:, i] for i, name in enumerate(rows[0])}


class Problem:
    """Equations, initial state, and the mesh forces of gearpod at the end."""

    def __init__(self, options: argparse.Namespace, folder: str) -> None:
        with open(STUDY, encoding="utf-8") as file:
            text = file.read()
        self.gearbox = Gearbox(tomllib.loads(text))
        curves = columns(finished([options.program, "stiffness", STUDY, "--csv", "-"]).output)
        names = [f"{side}{n}" for side in ("sp", "rp") for n in range(1, 5)]
        self.curves = np.array([curves[name] for name in names])
        out = folder + "/signals.csv"
        with open(folder + "/nominal.toml", "w", encoding="utf-8") as file:
            file.write(re.sub(r"\[random\].*?(?=\n\[)", "", text, flags=re.DOTALL))
        finished([options.program, "simulate", folder + "/nominal.toml", "--instance", "0", "--meshes",
                  str(options.meshes + 1), "--out", out])
        with open(out, encoding="utf-8") as file:
            signals = columns(file.read())
        motions = [f"{body}_{d}" for body in BODIES[:3] + tuple(f"planet{n}" for n in range(1, 5)) for d in "xyu"]
        positions = np.array([signals[name] for name in motions])
        times = signals["time"]
        ends = [int(np.searchsorted(signals["mesh_phase"], mesh - 1e-9)) for mesh in (0.5, 0.5 + options.meshes)]
        speeds = (positions[:, ends[0] + 1] - positions[:, ends[0] - 1]) / (times[ends[0] + 1] - times[ends[0] - 1])
        self.start = np.concatenate([positions[:, ends[0]], speeds])
        self.span = times[ends[0]], times[ends[1]]
        self.forces = np.array([signals[name + "_force"][ends[1]] for name in names])

    def springs(self, t: float) -> tuple[np.ndarray, np.ndarray]:
        """Stiffness and damping of the pairs, linear between points of the curves."""
        place = t / self.gearbox.mesh_s % 1.0 * self.curves.shape[1]
        i = int(place)
        before = self.curves[:, i]
        k = before + (place - i) * (self.curves[:, (i + 1) % self.curves.shape[1]] - before)
        return k, self.gearbox.damping * np.sqrt(k)

    def pair_forces(self, t: float, y: np.ndarray) -> np.ndarray:
        k, c = self.springs(t)
        half = len(y) // 2
        return k * (self.gearbox.pairs @ y[:half]) + c * (self.gearbox.pairs @ y[half:])

    def rates(self, t: float, y: np.ndarray) -> np.ndarray:
        rates = self.gearbox.constant @ y + self.gearbox.load
        rates[len(y) // 2:] += self.gearbox.to_rates @ self.pair_forces(t, y)
        return rates

    def solve(self, **method: str) -> tuple[float, float, int]:
        """Processor seconds, largest relative error of a mesh force, and evaluations."""
        scale = np.repeat([np.abs(half).max() for half in np.split(self.start, 2)], len(self.start) // 2)
        began = time.process_time()
        done = solve_ivp(self.rates, self.span, self.start, rtol=TOLERANCE, atol=TOLERANCE * scale, t_eval=self.span, **method)
        seconds = time.process_time() - began
        error = np.abs(self.pair_forces(self.span[1], done.y[:, -1]) - self.forces).max() / self.forces.mean()
        return seconds, error, done.nfev


def gearpod_s(program: str, folder: str, horizon: str) -> float:
    """Processor seconds of a whole command per gearbox, on one thread."""
    half = GEARBOXES[horizon] // 2
    return processor_s([program, "run", STUDY, "--out", folder + "/r.h5", "--force", "--quiet", "--instances", str(half),
                        "--set", f"ensemble.threshold_instances={half}", f'numerics.horizon="{horizon}"',
                        "numerics.threads=1"]) / GEARBOXES[horizon]


def main() -> None:
    parser = arguments(__doc__, 3)
    parser.add_argument("--meshes", type=int, default=2)
    options = parsed(parser)
    own: dict[str, list[float]] = {"full": [], "periodic": []}
    times: dict[str, list[float]] = {name: [] for name in METHODS}
    rest = {}
    with tempfile.TemporaryDirectory() as folder:
        problem = Problem(options, folder)
        for _ in range(options.rounds):
            for horizon, seconds in own.items():
                seconds.append(gearpod_s(options.program, folder, horizon))
            for name, method in METHODS.items():
                seconds, *rest[name] = problem.solve(**method)
                times[name].append(seconds / options.meshes)
    ratios, rows = {}, []
    for name, seconds in times.items():
        mesh = ratios[f"{name}, mesh period"] = ratio([s * MESHES / o for s, o in zip(seconds, own["full"])])
        whole = ratios[f"{name}, gearbox"] = ratio([s * MESHES / o for s, o in zip(seconds, own["periodic"])])
        rows.append([f"scipy {name}", round(rest[name][1] / options.meshes), statistics.median(seconds), mesh, whole,
                     f"{rest[name][0]:.1e}"])
    show({"tables": [table(["solver", "evaluations per mesh period", "s per mesh period", "over gearpod's mesh period",
                            "gearbox, over gearpod's", "error of mesh forces"], rows)], "ratios": ratios}, options)


if __name__ == "__main__":
    main()
