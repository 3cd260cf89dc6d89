"""Checks the spectrogram of a page: python3 test_spectrogram.py CASES PROGRAM SOURCES"""

import sys
import unittest

import report_case  # noqa: F401

import numpy
from signal_figures import WINDOW, levels_over_time

SAMPLES, MESH_HZ, ORDER = 40, 100.0, 3


def rising(meshes):
    """A line at an order of the mesh frequency, while the speed rises from 0.8 times its mean."""
    part = numpy.arange(meshes * SAMPLES) / (meshes * SAMPLES)
    # Time is the integral of 1 / speed over the mesh phase; speed 0.8 (1 + 0.5 part).
    times = numpy.log(1 + 0.5 * part) / 0.4 * meshes / MESH_HZ
    return {"time_s": list(times), "samples_per_mesh": SAMPLES, "highest_Hz": 900.0,
            "sensor": list(numpy.sin(2 * numpy.pi * ORDER * numpy.arange(len(part)) / SAMPLES))}


class Spectrogram(unittest.TestCase):
    def test_the_largest_line_follows_the_mesh_frequency(self):
        meshes = 60
        levels, middle, mesh_Hz, frequency = levels_over_time(rising(meshes))
        self.assertEqual(levels.shape, (meshes - WINDOW + 1, len(frequency)))
        self.assertGreater(mesh_Hz[-1], 1.3 * mesh_Hz[0])
        loudest = frequency[levels.argmax(axis=1)]
        self.assertLess(max(abs(loudest - ORDER * mesh_Hz)), 1.5 * (frequency[1] - frequency[0]))
        self.assertGreater(levels.max(axis=1).min(), -6)
        self.assertLess(levels[:, -1].max(), -30)
        # The speed at the middle of each window, from the closed form.
        speed = 0.8 * numpy.exp(0.4 * middle * MESH_HZ / meshes)
        self.assertLess(max(abs(mesh_Hz / (speed * MESH_HZ) - 1)), 2e-3)

    def test_a_signal_shorter_than_a_window_has_no_levels(self):
        self.assertIsNone(levels_over_time(rising(4)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
