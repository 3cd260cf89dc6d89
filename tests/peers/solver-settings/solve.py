#!/usr/bin/env python3
"""Integrates the gearboxes of a problem file (solver_settings write) by scipy's BDF and writes the
signals of sensor and encoders over the fault's pattern. README.md has the commands and the results.

    python3 solve.py PROBLEM.json RELATIVE ABSOLUTE SIGNALS.f64 [--stop-at-transitions]

scipy's BDF is the numerical differentiation formulas of Shampine and Reichelt (1997) with
quasi-constant steps: the algorithm of MATLAB's ode15s.
"""
import json
import sys
import time

import numpy as np
from scipy.integrate import BDF
from scipy.linalg import expm

RUN_IN = {"ratio": 4, "proportional": 24}  # mesh periods before the fault's passage
FILTER_STEPS = 8  # per sample
GAUSS = 0.5 + np.sqrt(0.15) * np.array([-1, 0, 1]), np.array([5, 8, 5]) / 18


class Gearbox:
    def __init__(self, problem, parameters):
        self.period, self.speed = parameters["mesh_period_s"], parameters["frame_speed_rad_s"]
        self.mass, self.c0, self.k0, self.force, self.rows, self.damping, self.sources, rigid = (
            np.array(parameters[key]) for key in ("mass", "damping", "stiffness", "force", "mesh_rows",
                                           "mesh_damping", "source_rows", "rigid_rotation"))
        self.proportional = problem["mesh_damping_law"] == "proportional"
        # Removes the rigid rotation of the whole train, as gearpod does after every mesh period.
        keep = np.eye(len(rigid)) - np.outer(rigid, rigid @ self.mass) / (rigid @ self.mass @ rigid)
        self.inverse = keep @ np.linalg.inv(self.mass)
        self.start = np.array(problem["transitions"])
        self.length = np.diff(np.append(self.start, 1.0))
        self.nodes, pairs = problem["nodes"], problem["pairs"]
        healthy = np.array(problem["stiffness"]).reshape(-1, self.nodes, pairs)
        self.tables = {None: healthy}
        for p in parameters.get("passages", []):
            table = self.tables.setdefault(p["mesh"], healthy.copy())
            values = np.reshape(p["stiffness"], (-1, self.nodes))
            table[p["first"]:p["first"] + len(values), :, p["pair"]] = values
        self.run_in = RUN_IN[problem["mesh_damping_law"]]
        self.inside = None  # mesh period and stretch between transitions, if integration stops there

    def meshes(self, mesh, phase, step=None):
        """Stiffness and damping of the pairs at some phases in [0, 1] of a mesh period."""
        table = self.tables.get(mesh - self.run_in, self.tables[None])
        if step is None:
            step = np.searchsorted(self.start, phase, side="right") - 1
        x = np.clip((phase - self.start[step]) / self.length[step], 0, 1) * (self.nodes - 1)
        i = np.clip(x.astype(int) - 1, 0, self.nodes - 4)
        x = x - i
        a, b, c, d = x, x - 1, x - 2, x - 3   # a cubic through four neighbours
        k = (table[step, i] * (b * c * d / -6)[:, None] + table[step, i + 1] * (a * c * d / 2)[:, None]
             + table[step, i + 2] * (a * b * d / -2)[:, None]
             + table[step, i + 3] * (a * b * c / 6)[:, None])
        shape = k if self.proportional else np.sqrt(np.maximum(k, 0.0))
        return k, self.damping * shape

    def accelerations(self, q, v, k, c):
        """Accelerations, one row per time."""
        mesh = (k * (q @ self.rows.T) + c * (v @ self.rows.T)) @ self.rows
        return (self.force - q @ self.k0.T - v @ self.c0.T - mesh) @ self.inverse.T

    def place(self, t):
        if self.inside is not None:
            mesh, step = self.inside
            return mesh, np.array([t / self.period - mesh]), step
        mesh = int(t / self.period)
        return mesh, np.array([t / self.period - mesh])

    def rate(self, t, y):
        n = len(self.force)
        k, c = self.meshes(*self.place(t))
        return np.concatenate([y[n:], self.accelerations(y[None, :n], y[None, n:], k, c)[0]])

    def jacobian(self, t, _):
        k, c = self.meshes(*self.place(t))
        stiffness = self.k0 + self.rows.T @ (k[0][:, None] * self.rows)
        damping = self.c0 + self.rows.T @ (c[0][:, None] * self.rows)
        n = len(self.force)
        return np.block([[np.zeros((n, n)), np.eye(n)],
                         [-self.inverse @ stiffness, -self.inverse @ damping]])

    def rest(self):
        k, _ = self.meshes(0, np.array([0.0]))
        stiffness = self.k0 + self.rows.T @ (k[0][:, None] * self.rows)
        return np.concatenate([np.linalg.pinv(stiffness, 1e-13) @ self.force,
                               np.zeros(len(self.force))])

    def source_accelerations(self, q, v, k, c):
        """Absolute accelerations of the sources along x, y, as in
        dynamics/effects/inertial_terms.hpp."""
        a = self.accelerations(q, v, k, c)
        out, w = a @ self.sources.T, self.speed
        x, vel = q @ self.sources.T, v @ self.sources.T
        out[:, 0::2] -= w * (w * x[:, 0::2] + 2 * vel[:, 1::2])
        out[:, 1::2] -= w * (w * x[:, 1::2] - 2 * vel[:, 0::2])
        return out


class Sensor:
    """Low-pass of lockstep/integrators/sensor_filter.hpp, exact except for the input between
    Gauss's points."""

    def __init__(self, problem, parameters):
        w = problem["low_pass_rad_s"]
        b1, b2 = 2 * np.cos(np.pi / 8), 2 * np.cos(3 * np.pi / 8)
        self.a = np.array([[0, 1, 0, 0], [-w * w, -b1 * w, 0, 0], [0, 0, 0, 1], [w * w, 0, -w * w, -b2 * w]])
        self.b = np.array([0, w * w, 0, 0])
        self.parameters, self.samples = parameters, problem["samples"]
        self.te = np.array(problem["te_weight"])
        self.z = np.zeros((4, len(parameters.sources)))
        grid = np.arange(self.samples * FILTER_STEPS + 1) / (self.samples * FILTER_STEPS)
        cuts = np.unique(np.concatenate([grid, parameters.start]))
        self.cuts = cuts[np.append(True, np.diff(cuts) > 1e-12)]
        self.length = np.diff(self.cuts)
        # Rounds lengths, so that the few that occur share their matrices.
        self.kinds, self.kind = np.unique(np.round(self.length, 13), return_inverse=True)
        self.maps = [self.step(h * parameters.period) for h in self.kinds]

    def step(self, h):
        return expm(h * self.a), [w * h * expm(h * (1 - g) * self.a) @ self.b for g, w in zip(*GAUSS)]

    def mesh(self, mesh, motion):
        """Samples of a mesh period: [sample][channel.., te]."""
        parameters, n = self.parameters, len(self.parameters.force)
        phase = (self.cuts[:-1, None] + self.length[:, None] * GAUSS[0]).ravel()
        y = motion((mesh + phase) * parameters.period)
        u = parameters.source_accelerations(y[:, :n], y[:, n:], *parameters.meshes(mesh, phase)).reshape(-1, 3, self.z.shape[1])
        at_samples = np.rint(self.cuts * self.samples)
        is_sample = np.abs(self.cuts * self.samples - at_samples) < 1e-9
        out = np.empty((self.samples, self.z.shape[1] + 1))
        for i, kind in enumerate(self.kind):
            if is_sample[i]:
                out[int(at_samples[i]), :-1] = self.z[2]
            transition, inputs = self.maps[kind]
            self.z = transition @ self.z + sum(np.outer(g, u[i, j]) for j, g in enumerate(inputs))
        times = (mesh + np.arange(self.samples) / self.samples) * parameters.period
        out[:, -1] = motion(times)[:, :n] @ self.te
        return out


def integrate_problem(problem, description, relative, absolute, stops):
    """Samples of all mesh periods of the pattern, the solver's seconds and steps per mesh
    period."""
    parameters = Gearbox(problem, description)
    sensor = Sensor(problem, parameters)
    meshes = parameters.run_in + problem["meshes"]
    phases = parameters.start if stops else [0.0]
    y, t, seconds, steps, solver, kept = parameters.rest(), 0.0, 0.0, 0, None, []
    out = []
    for mesh in range(meshes):
        for stretch, end in enumerate(list(phases[1:]) + [1.0]):
            until = (mesh + end) * parameters.period
            if solver is None or stops:
                parameters.inside = (mesh, stretch) if stops else None
                solver = BDF(parameters.rate, t, y, until if stops else meshes * parameters.period, rtol=relative,
                             atol=absolute, jac=parameters.jacobian)
            while solver.t < until:
                begin = time.process_time()
                solver.step()
                piece = solver.dense_output()
                seconds += time.process_time() - begin
                if solver.status == "failed":
                    sys.exit("the solver gave up")
                kept.append((solver.t, piece))
                steps += 1
            t, y = solver.t, solver.y
        ends = np.array([k[0] for k in kept])

        def motion(times):
            which = np.minimum(np.searchsorted(ends, times), len(kept) - 1)
            result = np.empty((len(times), len(parameters.force) * 2))
            for piece in np.unique(which):
                inside = which == piece
                result[inside] = kept[piece][1](times[inside]).T
            return result

        samples = sensor.mesh(mesh, motion)
        if mesh >= parameters.run_in:
            out.append(samples)
        kept = kept[-1:]   # it may reach into the next mesh period
    return np.array(out), seconds, steps / meshes


def main():
    problem = json.load(open(sys.argv[1]))
    relative, absolute = float(sys.argv[2]), float(sys.argv[3])
    stops = "--stop-at-transitions" in sys.argv
    seen, signals, seconds = {}, [], []
    for description in problem["gearboxes"]:
        key = json.dumps(description)
        if key not in seen:
            seen[key] = integrate_problem(problem, description, relative, absolute, stops)
            print(f"{seen[key][2]:.0f} steps a mesh period, {seen[key][1]:.1f} s", flush=True)
        signals.append(seen[key][0])
        seconds.append(seen[key][1])
    meshes = RUN_IN[problem["mesh_damping_law"]] + problem["meshes"]
    gearbox = np.mean(seconds)
    with open(sys.argv[4], "wb") as file:
        np.array([gearbox, gearbox / meshes]).tofile(file)
        np.array(signals).tofile(file)


main()
