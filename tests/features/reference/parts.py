"""Gearbox of small.toml, and parts of an averaged turn."""
import numpy as np

ZS, ZP, ZR, PLANETS = 13, 11, 35, 3
P, P_TE = 8, 4
TAPER, TE_HARMONICS = 0.1, 8


def tukey(points, taper):
    """Window as printed in Liang (2016), section 5.3.1."""
    n = np.arange(points)
    last = points - 1
    w = np.ones(points)
    rise = n < taper * last / 2
    fall = n > last * (1 - taper / 2)
    w[rise] = 0.5 * (1 + np.cos(np.pi * (2 * n[rise] / (taper * last) - 1)))
    w[fall] = 0.5 * (1 + np.cos(np.pi * (2 * n[fall] / (taper * last) - 2 / taper + 1)))
    return w


def moment(x, power):
    d = x - np.mean(x)
    return np.mean(d**power) / np.mean(d**2) ** (power / 2)


def separate(turn, teeth):
    """Parts of an averaged turn, by complex spectra with bins left out."""
    n = len(turn)
    order = np.abs(np.round(np.fft.fftfreq(n) * n)).astype(int)
    spectrum = np.fft.fft(turn)
    harmonic = (order > 0) & (order % teeth == 0)
    sideband = np.zeros(n, bool)
    for k in range(teeth, n, teeth):
        sideband |= (order == k - 1) | (order == k + 1)
    sideband &= ~harmonic

    def part(keep):
        return np.fft.ifft(np.where(keep, spectrum, 0)).real

    signed = np.round(np.fft.fftfreq(n) * n).astype(int)
    half = (teeth - 1) // 2
    band = (signed >= teeth - half) & (signed <= teeth + half)
    amplitude = np.abs(np.fft.rfft(turn)) / n
    amplitude[1 : (n + 1) // 2] *= 2
    return {
        "turn": turn,
        "regular": part(harmonic | sideband),
        "residual": part(~harmonic & (order > 0)),
        "difference": part(~harmonic & ~sideband & (order > 0)),
        "envelope": np.abs(np.fft.ifft(np.where(band, 2 * spectrum, 0))),
        "amplitude": amplitude,
    }


def rms(x):
    return np.sqrt(np.mean(x**2))


def averaged(y):
    return np.mean(y[: ZP * ZR * P].reshape(ZR, ZP * P), axis=0)
