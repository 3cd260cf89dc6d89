"""Features of your own, as docs/guide/own-features.md explains: functions whose first parameter is record."""

import numpy as np


def band_kurtosis(record):
    """largest spectral kurtosis of the vibration between 0 and half the sampling rate, after the
    regular meshing is removed; Antoni (2006)"""
    frames = record.sensor.reshape(-1, record.samples_per_mesh)  # one mesh period each
    spectra = np.fft.rfft(frames * np.hanning(frames.shape[1]))
    power = np.abs(spectra - spectra.mean(axis=0)) ** 2          # without what all meshes share
    kurtosis = np.mean(power**2, axis=0) / np.mean(power, axis=0) ** 2 - 2
    return kurtosis[1:-1].max()


band_kurtosis.title = "largest spectral kurtosis of the irregular vibration"


def energy_kurtosis(record):
    """kurtosis of the Teager-Kaiser energy of the vibration, for all noise levels at once"""
    x = record.sensor  # noise levels x samples
    energy = x[:, 1:-1] ** 2 - x[:, :-2] * x[:, 2:]
    squares = (energy - energy.mean(axis=1, keepdims=True)) ** 2
    return np.mean(squares**2, axis=1) / np.mean(squares, axis=1) ** 2


energy_kurtosis.batch = True
energy_kurtosis.title = "kurtosis of the vibration's energy"
