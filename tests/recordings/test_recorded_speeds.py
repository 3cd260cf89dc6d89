#!/usr/bin/env python3
"""Reads 200 recordings whose speed is wrong and 200 right ones with `gearpod features`: at most 2 wrong ones may give features without
a warning of the speed, and no right one may get any warning. Usage: test_recorded_speeds.py GEARPOD"""

import pathlib
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

RATE, MESH = 2560.0, 76.0  # Hz, of the study
STUDY = ["--set", f"sensor.sampling_Hz={RATE:g}", "--set", "sensor.low_pass_Hz=500", str(pathlib.Path(__file__).with_name("rig.toml"))]
WARNING = "times the stated speed|the speed varies|no mesh harmonic|pulse"
KINDS = ("ramp", "sine", "step", "walk")
TABLE = np.arange(0, 1500, 1 / 64)  # mesh phases at which a signal is known


def synthesised(seed):
    """Mesh harmonics with the sidebands of three planets that pass the sensor, at the phases of the table."""
    generator = np.random.default_rng(seed)
    lines = [(k + j / 76, generator.uniform(0.2, 1) / np.sqrt(k) / (1 + abs(j))) for k in range(1, 7) for j in range(-5, 6)
             if (76 * k + j) % 3 == 0]
    return sum(size * np.cos(2 * np.pi * order * TABLE + generator.uniform(0, 2 * np.pi)) for order, size in lines)


def simulated(program, folder):
    subprocess.run([program, "simulate", *STUDY, "--instance", "0", "--meshes", "1500", "--out", "rig.h5"], cwd=folder, check=True,
                   capture_output=True)
    with h5py.File(folder / "rig.h5") as file:
        return np.interp(TABLE, file["signals/mesh_phase"][()] - file["signals/mesh_phase"][0], file["signals/sensor"][()])


def recorded(generator, signals, meshes, noise, ratio=1.0, kind="constant", change=0.0):
    """Samples, mesh phase and speed over that of the study; the samples hold no frequency above half their rate."""
    n = int(meshes / MESH / ratio * RATE) // 2 * 2
    share, steps = np.arange(4 * n) / (4 * n), np.cumsum(generator.standard_normal(12))
    speed = ratio * (1 + change * {
        "constant": 0, "ramp": share - 0.5, "sine": np.sin(2 * np.pi * generator.uniform(0.5, 3) * share) / 2,
        "step": np.clip((share - generator.uniform(0.3, 0.7)) / 0.05, -0.5, 0.5),
        "walk": np.interp(share, np.linspace(0, 1, 12), (steps - np.mean(steps)) / np.ptp(steps))}[kind]) + 0 * share
    phase = generator.uniform(0, 76) + np.cumsum(speed) * MESH / (4 * RATE)
    fine = np.interp(phase, TABLE, signals[generator.integers(len(signals))])
    return np.fft.irfft(np.fft.rfft(fine)[:n // 2 + 1], n) / 4 + noise * generator.standard_normal(n), phase[::4], speed[::4]


def pulses(phase, per_mesh):
    return 5.0 * ((phase * per_mesh) % 1 < 0.3)


def wrong(generator, signals, i):
    """Columns of a recording and options that do not describe it: another speed, one that varies, pulses, shaft or machine."""
    kind, meshes, noise = i % 5, generator.choice([150, 300, 600, 1200]), generator.choice([0.1, 0.3, 0.6])
    ratio, n = 1.0, int(meshes / MESH * RATE)
    while kind == 0 and abs(ratio - 1) < 0.02 or kind == 1 and i % 3 == 0 and ratio == 1:
        ratio = np.exp(generator.uniform(np.log(0.3), np.log(5)))
    x, phase, speed = recorded(generator, signals, meshes, noise, ratio)
    while (kind == 1 or kind > 1 and i % 2) and np.ptp(phase - np.linspace(phase[0], phase[-1], phase.size)) < 0.4:  # mesh periods
        x, phase, speed = recorded(generator, signals, meshes, noise, ratio, generator.choice(KINDS),
                                   np.exp(generator.uniform(np.log(0.005), np.log(0.4))))
    true, stated = generator.permutation(np.arange(1, 9))[:2]
    shaft = generator.choice([4.8 / 76, 1 / 28])  # turns of the sun and of a planet per mesh period; the carrier has 1 / 76
    white, line = generator.standard_normal(n), 2 * np.pi * np.arange(n) / RATE * generator.uniform(20, 60)
    if kind == 4:
        x = (white, 0.3 * white + sum(np.cos(k * line + k) / k for k in (1, 2, 3)),
             np.convolve(white, 0.98 ** np.arange(300) * np.cos(generator.uniform(0.3, 2) * np.arange(300)), "same"))[i % 3]
    return ({"sensor": x, "tacho": pulses(phase, true / 76)}, ["--tachometer", "tacho", "--pulses-per-turn", str(stated)]) if kind == 2 \
        else ({"sensor": x, "tacho": pulses(phase, shaft)}, ["--tachometer", "tacho"]) if kind == 3 and i % 4 < 2 \
        else ({"sensor": x, "speed_rpm": speed * MESH * shaft * 60} if kind == 3 else {"sensor": x}, [])


def right(generator, signals, i):
    meshes, noise = ((32, 0.3), (60, 0.5), (100, 0.5), (300, 1.0), (600, 1.0), (1200, 1.0))[generator.integers(6)]
    x, phase, speed = recorded(generator, signals, max(meshes, 300 * (i % 5 == 2)), generator.uniform(0, noise), 1.0,
                               generator.choice(KINDS) if i % 5 < 3 else "constant", generator.uniform(0.01, 0.2))
    return (({"sensor": x, "speed_rpm": speed * 60}, []), ({"sensor": x, "angle": phase / 76 * 2 * np.pi}, ["--encoder", "angle"]),
            ({"sensor": x, "tacho": pulses(phase, 16 / 76)}, ["--tachometer", "tacho", "--pulses-per-turn", "16"]),
            ({"sensor": x}, []), ({"sensor": x}, []))[i % 5]


def main():
    program, failures = str(pathlib.Path(sys.argv[1]).resolve()), {wrong: 0, right: 0}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        signals = [x / np.std(x) for x in (*map(synthesised, range(3)), simulated(program, folder))]
        for make, i in ((make, i) for make in failures for i in range(200)):
            columns, options = make(np.random.default_rng([i, make is right]), signals, i)
            with h5py.File(folder / "a.h5", "w") as file:
                file.update(columns)
                file.attrs["sampling_Hz"] = RATE
            done = subprocess.run([program, "features", "a.h5", *options, *STUDY[:4], "--study", STUDY[4]], cwd=folder, text=True,
                                  capture_output=True)
            text = " ".join((done.stdout + done.stderr).split())
            silent = done.returncode == 0 and not re.search(WARNING, text.partition("mesh periods:")[2])
            if silent if make is wrong else done.returncode or "note:" in text:
                failures[make] += 1
                print(f"{make.__name__}{i}: exit code {done.returncode}: {text[:400]}", flush=True)
    print(f"{failures[wrong]} of 200 wrong recordings without a warning of the speed, {failures[right]} of 200 right ones with a warning")
    return 1 if failures[wrong] > 2 or failures[right] > 0 else 0


if __name__ == "__main__":
    sys.exit(main())
