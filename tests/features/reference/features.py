#!/usr/bin/python3
"""Every feature of the gearbox of small.toml from its definition, with numpy alone.

    features.py SIGNAL.h5 HEALTHY.h5 ... > expected.json
    features.py --change SIGNAL.h5 BASELINE.h5 > expected-change.json

Columns mesh_phase, sensor (m/s^2) and te (rad); P samples per mesh period.
"""
import json
import pathlib
import sys

import numpy as np

from parts import (P, P_TE, PLANETS, TAPER, TE_HARMONICS, ZP, ZR, ZS, averaged, moment, rms,
                   separate, tukey)

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
from reference_tables import read_table


def tooth_signals(y, teeth, turns, offset):
    """Cuts, windows and assembles the signal tooth by tooth."""
    y = y[: teeth * turns * P]
    w = tukey(P, TAPER)
    at = np.arange(P) + offset
    return [
        np.concatenate([w * y[((i * teeth + j) * P + at) % len(y)] for i in range(turns)])
        for j in range(teeth)
    ]


def best_teeth(y, teeth, turns):
    """Tooth signals at the offset of maximum RMS; the first of equal offsets."""
    largest = [max(rms(s) for s in tooth_signals(y, teeth, turns, o)) for o in range(P)]
    offset = next(o for o in range(P) if largest[o] >= max(largest) * (1 - 1e-13))
    return tooth_signals(y, teeth, turns, offset)


def detrended(values):
    j = np.arange(len(values)) * 2 * np.pi / len(values)
    basis = [np.ones(len(values))]
    for k in range(1, PLANETS + 1):
        basis += [np.cos(k * j), np.sin(k * j)]
    basis = np.array(basis).T
    return values / (basis @ np.linalg.lstsq(basis, values, rcond=None)[0])


def windows(prefix, signals, held):
    stats = {
        "rms": np.array([np.mean(s**2) for s in signals]),
        "kurtosis": np.array([moment(s, 4) for s in signals]),
        "crest": np.array([np.max(np.abs(s)) / rms(s) for s in signals]),
        "m8a": np.array([moment(s, 8) for s in signals]),
    }
    if held:
        stats = {name: detrended(values) for name, values in stats.items()}
    root = np.sqrt(stats["rms"])
    others = np.delete(root, np.argmax(root))
    spread = max(np.median(np.abs(others - np.median(others))), 1e-6 * np.median(others))
    out = {
        "window_ratio": root.max() / np.median(root),
        "window_z": (root.max() - np.median(others)) / (1.4826 * spread),
    }
    for name in ("kurtosis", "crest", "m8a"):
        out["window_" + name] = stats[name].max() / np.median(stats[name])
    return {prefix + name: value for name, value in out.items()}


def derivative(turn):
    """Derivative of a periodic signal over an angle of 2 pi, without its Nyquist order."""
    n = len(turn)
    k = np.fft.fftfreq(n) * n
    return np.fft.ifft(np.where(2 * np.abs(k) < n, 1j * k, 0) * np.fft.fft(turn)).real


def speed_features(speed):
    """Lines of the planet turn over the strongest mesh line, and windows of a mesh period."""
    n = len(speed)
    amplitude = 2 * np.abs(np.fft.rfft(speed)) / n
    orders = np.arange(1, 6)
    windows = [rms(np.roll(speed, -i)[:P_TE]) for i in range(n)]
    return {
        "te_speed_fault_order": np.sum(amplitude[orders[2 * orders < ZP]])
        / np.max(amplitude[ZP : (n + 1) // 2 : ZP]),
        "te_speed_window_ratio": np.max(windows) / np.median(windows),
    }


def te_features(te):
    te = te[:: P // P_TE]
    turns = min(len(te) // (ZP * P_TE), ZR)
    turn = np.mean(te[: turns * ZP * P_TE].reshape(turns, -1), axis=0)
    turn = turn - np.mean(turn)
    parts = separate(turn, ZP)
    s = parts["amplitude"]
    mesh = [s[j * ZP] for j in range(1, TE_HARMONICS + 1) if 2 * j * ZP < len(turn)]
    k = np.arange(len(s))
    return {
        "te_rms": rms(turn),
        "te_kurtosis": moment(turn, 4),
        "te_fc": np.sum(k[1:] * s[1:]) / np.sum(s[1:]),
        "te_fm0": np.ptp(turn) / np.sum(mesh),
        "te_fm4": moment(parts["difference"], 4),
        "te_m6a": moment(parts["difference"], 6),
        "te_m8a": moment(parts["difference"], 8),
        "te_speed_kurtosis": moment(derivative(turn), 4),
    } | speed_features(derivative(turn))


def kurtogram(y):
    """Largest kurtosis over the bands of 1, 2, 3, 4, 6, ... per level."""
    n = len(y)
    spectrum = np.fft.fft(y)
    order = np.arange(n)
    peak = -np.inf
    for bands in (1, 2, 3, 4, 6, 8, 12, 16):
        for i in range(bands if bands <= P // 2 else 0):
            band = (2 * bands * order > i * n) & (2 * bands * order <= (i + 1) * n) & (2 * order < n)
            square = np.abs(np.fft.ifft(np.where(band, 2 * spectrum, 0))) ** 2
            peak = max(peak, np.mean(square**2) / np.mean(square) ** 2 - 2)
    return peak


def prewhitened(y):
    spectrum = np.fft.fft(y)
    magnitude = np.abs(spectrum)
    keep = magnitude > 1e-12 * np.max(magnitude)
    keep[0] = False
    return np.fft.ifft(np.where(keep, spectrum / magnitude, 0)).real


def sensor_features(y, healthy):
    turn = averaged(y)
    parts = separate(turn, ZP)
    d = parts["difference"]
    variance = np.mean([np.var(separate(averaged(h), ZP)["residual"]) for h in healthy])
    residual = parts["residual"]
    about_mean = turn - np.mean(turn)
    s = parts["amplitude"]
    sidebands = s[ZP - 1] + s[ZP + 1]
    span = y[: ZP * ZR * P]
    carrier = span.reshape(-1, ZR * P)
    white = np.array([rms(t) for t in best_teeth(prewhitened(span), ZP, ZR)])
    out = {
        "sensor_rms": rms(span),
        "crest_factor": np.max(np.abs(about_mean)) / rms(about_mean),
        "fm4": moment(d, 4),
        "m6a": moment(d, 6),
        "m8a": moment(d, 8),
        "energy_ratio": rms(d) / rms(parts["regular"]),
        "sideband_index": sidebands / 2,
        "sideband_level": sidebands / rms(about_mean),
        "frms": rms((carrier - np.mean(carrier, axis=0)).ravel()),
        "na4": np.mean((residual - np.mean(residual)) ** 4) / variance**2,
        "fm0": np.ptp(turn) / np.sum(s[ZP : (len(turn) + 1) // 2 : ZP]),
        "kurtogram_peak": kurtogram(span),
        "whitened_window_ratio": white.max() / np.median(white),
    }
    out |= windows("", best_teeth(y, ZP, ZR), False)
    out |= windows("sun_", best_teeth(y, ZS, ZR), False)
    out |= windows("ring_", best_teeth(y, ZR, ZP), True)
    return out


def shifted(x, shift):
    """The periodic signal x at i + shift, band-limited."""
    n = len(x)
    order = np.fft.rfftfreq(n) * n
    spectrum = np.fft.rfft(x) * np.exp(2j * np.pi * order * shift / n)
    if n % 2 == 0:
        spectrum[-1] = np.fft.rfft(x)[-1] * np.cos(np.pi * shift)
    return np.fft.irfft(spectrum, n)


def aligned(other, x):
    """`other` shifted to the largest circular correlation with x: by whole samples to the largest
    of these, then by bisection of the correlation's slope between its neighbours."""
    n = len(x)
    spectrum = np.conj(np.fft.rfft(x - np.mean(x)))
    start = int(np.argmax(np.fft.irfft(np.fft.rfft(other - np.mean(other)) * spectrum, n)))
    other = np.roll(other, -start)
    product = np.fft.rfft(other - np.mean(other)) * spectrum
    order = np.arange(len(product))
    inner = (order > 0) & (2 * order < n)

    def slope(shift):
        turned = product[inner] * np.exp(2j * np.pi * order[inner] * shift / n)
        return -np.sum(order[inner] * turned.imag)

    low, high = -1.0, 1.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slope(middle) > 0 else (low, middle)
    return shifted(other, 0.5 * (low + high))


def change_features(y, baseline):
    """Features of the change of a recording of the whole span since its baseline."""
    span = ZP * ZR * P
    now, before = y[:span], baseline[:span]
    before = aligned(before, now)
    change = now - before
    turn = averaged(change)
    parts = separate(turn, ZP)
    about_mean = turn - np.mean(turn)
    out = {
        "change_sensor_rms": rms(change),
        "change_kurtosis": moment(turn, 4),
        "change_crest_factor": np.max(np.abs(about_mean)) / rms(about_mean),
        "change_fm4": moment(parts["difference"], 4),
        "change_m6a": moment(parts["difference"], 6),
        "baseline_correlation": np.corrcoef(averaged(now), averaged(before))[0, 1],
    }
    teeth = windows("change_", best_teeth(change, ZP, ZR), False)
    return out | {name: teeth[name] for name in ("change_window_ratio", "change_window_z")}


def main(arguments):
    if arguments[0] == "--change":
        now, before = (read_table(path)["sensor"] for path in arguments[1:])
        print(json.dumps(change_features(now, before), indent=1))
        return
    signal, healthy = read_table(arguments[0]), [read_table(path)["sensor"] for path in arguments[1:]]
    out = te_features(signal["te"]) | sensor_features(signal["sensor"], healthy)
    print(json.dumps(out, indent=1))


main(sys.argv[1:])
