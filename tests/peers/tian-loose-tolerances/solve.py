#!/usr/bin/env python3
"""Tian (2004), Eqs. 4.3-4.8 with Table 4.1 by BDF of variable order and step at several tolerances:
the largest harmonics of 570 Hz in the pinion's acceleration. README.md has the command and results.

The thesis used MATLAB's ode15s, a method of the same family, with default tolerances 1e-3
(relative) and 1e-6 (absolute). Rotations include the rigid rotation, as in the thesis.
"""
import sys

import numpy as np
from scipy.integrate import solve_ivp

MESH_PERIOD = 1 / 570
MESHES, KEPT = 24, 12
R1, R2 = (0.5 * n * 3.175e-3 * np.cos(np.radians(20)) for n in (19, 48))
# y1 y2 and the angles of motor, pinion, gear, load
MASS = np.array([0.96, 2.88, 0.0021, 4.3659e-4, 8.3602e-3, 0.0105])
LOAD = np.array([0, 0, 11.9, 0, 0, -48.8])
MESH = np.array([-1, 1, 0, R1, -R2, 0])


def matrix(bearing, coupling):
    m = np.diag([bearing, bearing] + 4 * [coupling])
    for i in (2, 4):
        m[i, i + 1] = m[i + 1, i] = -coupling
    return m


STIFFNESS, DAMPING = matrix(6.56e7, 4.4e4), matrix(1.8e5, 5e5)
TIES = np.outer(MESH, MESH)
MESH_DAMPING_TIME = 3.99e-6


def harmonics(mesh_stiffness, relative, absolute):
    def system(t):
        k = mesh_stiffness[int(t / MESH_PERIOD % 1 * len(mesh_stiffness))]
        return STIFFNESS + k * TIES, DAMPING + MESH_DAMPING_TIME * k * TIES

    def rate(t, s):
        k, c = system(t)
        return np.concatenate([s[6:], (LOAD - k @ s[:6] - c @ s[6:]) / MASS])

    def jacobian(t, _):
        k, c = system(t)
        return np.block([[np.zeros((6, 6)), np.eye(6)],
                         [-k / MASS[:, None], -c / MASS[:, None]]])

    turning = np.array([0, 0, 1, 1, R1 / R2, R1 / R2])
    speeding_up = turning * (turning @ LOAD) / (turning @ (MASS * turning))
    rest = np.linalg.pinv(system(0)[0]) @ (LOAD - MASS * speeding_up)
    start = np.concatenate([rest, 2 * np.pi * 30 * turning])
    end = MESHES * MESH_PERIOD
    run = solve_ivp(rate, (0, end), start, method="BDF", rtol=relative, atol=absolute, jac=jacobian)
    acceleration = [rate(t, s)[6] for t, s in zip(run.t, run.y.T)]
    t = np.linspace(end - KEPT * MESH_PERIOD, end, 600 * KEPT, endpoint=False)
    lines = np.abs(np.fft.rfft(np.interp(t, run.t, acceleration))) * 2 / len(t)
    return len(run.t) / MESHES, lines[KEPT::KEPT][:20]


for path in sys.argv[1:]:
    stiffness = np.loadtxt(path, delimiter=",", skiprows=1)[:, 1]
    for relative, absolute in ((1e-2, 1e-5), (1e-3, 1e-6), (1e-4, 1e-7), (1e-5, 1e-8)):
        steps, lines = harmonics(stiffness, relative, absolute)
        largest = np.argsort(lines)[::-1][:3] + 1
        print(f"{path}: {relative:g}, {absolute:g}: {steps:.0f} steps a mesh period, largest",
              ", ".join(f"{n} ({lines[n - 1]:.2f})" for n in largest), flush=True)
