#!/usr/bin/env python3
"""Liang (2016), chapter 4: the planetary gearbox with a 4.28 mm ring-side planet crack by BDF of
variable order and step, ode15s' family, at several tolerances, against gearpod's converged signal.
README.md has the commands; writes table.csv.

The model is written out again from the equations (PHYSICS of the thesis' section 4.2 as spring rows,
without inertial terms); only the stiffness curves and the reference signal come from gearpod."""
import csv
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp
from scipy.signal import butter, lfilter

N, ZS, ZP, ZR, MODULE, ALPHA = 4, 19, 31, 81, 3.175e-3, np.radians(20)
CARRIER_SPEED = 8.87 * np.pi / 30
PERIOD = 2 * np.pi / (CARRIER_SPEED * ZR)
TORQUE, PATH_EXPONENT, LOW_PASS_HZ = 429.0, 0.1, 800.0
RUN_IN, PASSAGE = 10, 3                       # mesh periods
SUN, PLANET, RING, CARRIER = 0.7, 1.822, 5.982, 10.0
C, R, S = 0, 3, 6                             # x, y, u of carrier, ring, sun; then the planets


def at(planet):
    return 9 + 3 * planet


def row(*entries):
    v = np.zeros(9 + 3 * N)
    for place, value in entries:
        v[place] += value
    return v


PSI = 2 * np.pi * np.arange(N) / N
DISC = 0.5 / np.cos(ALPHA) ** 2               # J / r_b^2 of a disc on the pitch circle, per mass
MASS = np.concatenate([[CARRIER, CARRIER, 0.5 * CARRIER], [RING, RING, DISC * RING],
                       [SUN, SUN, DISC * SUN], N * [PLANET, PLANET, DISC * PLANET]])
PS, PR = np.pi / 2 - ALPHA + PSI, np.pi / 2 + ALPHA + PSI
SUN_ROWS = [row((S, np.cos(PS[n])), (S + 1, np.sin(PS[n])), (S + 2, 1), (at(n), -np.cos(PS[n])),
                (at(n) + 1, -np.sin(PS[n])), (at(n) + 2, 1)) for n in range(N)]
RING_ROWS = [row((R, np.cos(PR[n])), (R + 1, np.sin(PR[n])), (R + 2, 1), (at(n), -np.cos(PR[n])),
                 (at(n) + 1, -np.sin(PR[n])), (at(n) + 2, -1)) for n in range(N)]
MESHES = np.array(SUN_ROWS + RING_ROWS)
BEARINGS = [row((i, 1)) for i in (C, C + 1, R, R + 1, S, S + 1, R + 2)]
for n in range(N):
    BEARINGS += [row((at(n), 1), (C, -1), (C + 2, np.sin(PSI[n]))),
                 row((at(n) + 1, 1), (C + 1, -1), (C + 2, -np.cos(PSI[n])))]
BEARINGS = np.array(BEARINGS)
K0, C0 = (value * BEARINGS.T @ BEARINGS for value in (1e8, 1.5e3))
ZETA = 2 * 0.07 * np.sqrt(np.array(N * [SUN * PLANET / (SUN + PLANET)]
                                   + N * [RING * PLANET / (RING + PLANET)]))
R_SUN = 0.5 * ZS * MODULE * np.cos(ALPHA)
R_CENTRE = 0.5 * (ZS + ZP) * MODULE
LOAD = row((S + 2, TORQUE / R_SUN), (C + 2, -TORQUE * (1 + ZR / ZS) / R_CENTRE))
TE = row((S + 2, 1 / R_SUN), (C + 2, -(ZR + ZS) / ZS / R_CENTRE))


def read_stiffness(path):
    """Healthy curves [phase][pair], and rp1 in the three mesh periods of the faulty tooth."""
    with open(path) as file:
        names = next(csv.reader(file))
        table = np.loadtxt(file, delimiter=",")
    healthy = table[:, 1:1 + 2 * N]
    faulty = [table[:, i] for i, name in enumerate(names) if name.startswith("rp1_crack_4.28mm")]
    assert len(faulty) == PASSAGE
    return healthy, faulty


def solve(healthy, faulty, relative, absolute, per_mesh):
    count = len(healthy)
    curves = [healthy.copy() for _ in range(1 + PASSAGE)]
    for k in range(PASSAGE):
        curves[1 + k][:, N] = faulty[k]

    def system(t):
        mesh = int(t // PERIOD)
        turn = mesh - RUN_IN
        curve = curves[1 + turn if 0 <= turn < PASSAGE else 0]
        place = t / PERIOD % 1 * count
        i = int(place) % count
        k = curve[i] + (place - int(place)) * (curve[(i + 1) % count] - curve[i])
        return K0 + (MESHES.T * k) @ MESHES, C0 + (MESHES.T * (ZETA * np.sqrt(k))) @ MESHES

    def acceleration(t, s):
        k, c = system(t)
        half = len(MASS)
        return (LOAD - k @ s[:half] - c @ s[half:]) / MASS

    def rate(t, s):
        return np.concatenate([s[len(MASS):], acceleration(t, s)])

    def jacobian(t, _):
        k, c = system(t)
        return np.block([[np.zeros_like(K0), np.eye(len(MASS))],
                         [-k / MASS[:, None], -c / MASS[:, None]]])

    rest = np.linalg.pinv(system(0)[0]) @ LOAD
    end = (RUN_IN + ZP) * PERIOD
    start = time.process_time()
    run = solve_ivp(rate, (0, end), np.concatenate([rest, np.zeros(len(MASS))]), method="BDF",
                    rtol=relative, atol=absolute, jac=jacobian)
    seconds = time.process_time() - start
    assert run.success, run.message
    # What the solver's steps say, joined by lines and filtered like the sensor.
    accelerations = np.array([acceleration(t, s) for t, s in zip(run.t, run.y.T)])
    fine = 64 * per_mesh
    t = np.arange(0, (RUN_IN + ZP) * fine) * PERIOD / fine
    b, a = butter(4, LOW_PASS_HZ, fs=fine / PERIOD)
    kept = slice(RUN_IN * fine, None, 64)
    places = [at(n) + i for n in range(N) for i in (0, 1)]
    planets = np.array([lfilter(b, a, np.interp(t, run.t, accelerations[:, i]))[kept]
                        for i in places])
    te = np.interp(t[kept], run.t, TE @ run.y[:len(MASS)])
    return planets, te - te.mean(), len(run.t) / (RUN_IN + ZP), seconds


def sensor(planets, per_mesh, meshes):
    """The path of section 4.3 over the first mesh periods; motion repeats every planet turn."""
    k = np.arange(meshes * per_mesh)
    angle = CARRIER_SPEED * PERIOD * k / per_mesh
    signal = np.zeros(len(k))
    for n in range(N):
        x = np.mod(angle + PSI[n], 2 * np.pi)
        weight = np.exp(PATH_EXPONENT * (x - np.pi) ** 2) * (0.54 - 0.46 * np.cos(x))
        ax, ay = (planets[2 * n + i][k % planets.shape[1]] for i in (0, 1))
        signal += weight * (np.sin(angle) * ax + np.cos(angle) * ay)
    return signal


def relative_l2(a, b):
    return np.sqrt(np.sum((a - b) ** 2) / np.sum(b ** 2))


def kurtosis(x):
    d = x - x.mean()
    return np.mean(d ** 4) / np.mean(d ** 2) ** 2


def main():
    healthy, faulty = read_stiffness(sys.argv[1])
    with open(sys.argv[2]) as file:
        names = [name.split()[0] for name in next(csv.reader(file))]
        data = np.loadtxt(file, delimiter=",")
    meshes = 2 * ZP
    per_mesh = len(data) // meshes
    reference = data[:, names.index("sensor")]
    te_reference = data[:ZP * per_mesh, names.index("te")]
    te_reference = te_reference - te_reference.mean()
    rows = []
    for relative, absolute in ((1e-3, 1e-6), (1e-5, 1e-8), (1e-7, 1e-10)):
        planets, te, steps, seconds = solve(healthy, faulty, relative, absolute, per_mesh)
        # The reference's faulty tooth passes at another mesh of the planet turn.
        shift = min(range(ZP), key=lambda k: relative_l2(np.roll(te, k * per_mesh), te_reference))
        te = np.roll(te, shift * per_mesh)
        signal = sensor(np.roll(planets, shift * per_mesh, axis=1), per_mesh, meshes)
        rms = [np.sqrt(np.mean(s ** 2)) for s in (signal, reference)]
        features = (np.std(te) / np.std(te_reference) - 1,
                    kurtosis(te) / kurtosis(te_reference) - 1, rms[0] / rms[1] - 1)
        rows.append([f"BDF (scipy) {relative:g} / {absolute:g}",
                     "tests/peers/bdf-liang/solve.py, 4.28 mm crack alone", f"{seconds:.3g}",
                     f"{seconds / (RUN_IN + ZP):.3g}", f"{relative_l2(signal, reference):.3g}",
                     f"{relative_l2(te, te_reference):.3g}"] + [f"{abs(f):.3g}" for f in features])
        print(f"{relative:g}, {absolute:g}: {steps:.0f} steps a mesh period, passage at mesh {shift},",
              f"sensor {rows[-1][4]}, te {rows[-1][5]}, features", *rows[-1][6:], flush=True)
        with open(sys.argv[3], "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["name", "command", "march_s", "mesh_s", "sensor", "te", "te_rms",
                             "te_kurtosis", "sensor_rms"])
            writer.writerows(rows)


main()
