#!/usr/bin/env python3
"""Checks approximate Bayesian computation (analysis/python/gearpod/calibration.py) against closed forms. Usage:
test_calibration.py SOURCES

Two parameters, uniform from 0 to 1. The first is the mean of eight normal values, summarised by their mean and spread. The
second has no effect on the summaries."""

import math
import pathlib
import sys
import unittest

try:
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(sys.argv.pop(1)) / "analysis/python/gearpod"))
import calibration  # noqa: E402

calibration.np = np
SD, VALUES = 0.3, 8
OBSERVED_SPREAD = math.log(SD**2)


def summaries_at(mean, random):
    values = random.normal(mean[:, None], SD, (len(mean), VALUES))
    return np.stack([values.mean(axis=1), np.log(values.var(axis=1))], axis=1)


def simulated(count, seed):
    random = np.random.default_rng(seed)
    unit = random.random((count, 2))
    return unit, np.arange(count), summaries_at(unit[:, 0], random)


def normal_cdf(x):
    return 0.5 * math.erfc(-x / math.sqrt(2))


class RegressionAbc(unittest.TestCase):
    def test_the_posterior_of_a_mean_is_the_normal_one_cut_off_where_the_prior_ends(self):
        samples, sd = simulated(20000, 1), SD / math.sqrt(VALUES)
        for seen in (0.5, 0.1):
            _, weight, unit = calibration.regression_abc(*samples, np.array([seen, OBSERVED_SPREAD]))
            below, above = normal_cdf(-seen / sd), normal_cdf((1 - seen) / sd)
            for p in (0.05, 0.5, 0.95):
                quantile = calibration.weighted_quantile(unit[:, 0], weight, p)
                self.assertAlmostEqual((normal_cdf((quantile - seen) / sd) - below) / (above - below), p, delta=0.03)

    def test_a_parameter_without_effect_keeps_its_prior(self):
        unit, group, summaries = simulated(20000, 2)
        kept, weight, posterior = calibration.regression_abc(unit, group, summaries, np.array([0.4, OBSERVED_SPREAD]))
        for p in (0.05, 0.5, 0.95):
            self.assertAlmostEqual(calibration.weighted_quantile(posterior[:, 1], weight, p), p, delta=0.03)
        correlation = calibration.rank_correlations(unit[kept], summaries[kept])
        self.assertGreater(correlation[0, 0], 0.3)
        self.assertLess(abs(correlation[1, 0]), 0.1)
        self.assertAlmostEqual(weight.sum(), 1.0)

    def test_intervals_have_their_nominal_coverage_also_with_few_simulations(self):
        samples, random, held, sets = simulated(600, 3), np.random.default_rng(4), 0, 1000
        for truth in random.random(sets):
            _, weight, unit = calibration.regression_abc(*samples, summaries_at(np.array([truth]), random)[0])
            low, high = (calibration.weighted_quantile(unit[:, 0], weight, p) for p in (0.05, 0.95))
            held += low <= truth <= high
        # All sets share one set of simulations, so its error is common to them.
        self.assertAlmostEqual(held / sets, 0.9, delta=0.04)

    def test_quantiles_of_weighted_values_are_those_of_the_values_repeated(self):
        values, weight = np.array([3.0, 1.0, 2.0]), np.array([0.25, 0.5, 0.25])
        for p, quantile in ((0.0, 1.0), (0.25, 1.0), (0.625, 2.0), (1.0, 3.0)):
            self.assertAlmostEqual(calibration.weighted_quantile(values, weight, p), quantile)

    def test_rank_correlations_with_ties(self):
        columns = np.array([[1.0, 4.0, 7.0], [2.0, 3.0, 7.0], [2.0, 3.0, 7.0], [5.0, 0.0, 7.0]])
        self.assertTrue(np.allclose(calibration.rank_correlations(columns, columns), [[1, -1, 0], [-1, 1, 0], [0, 0, 0]]))

    def test_summaries_are_means_and_spreads_of_logarithms_of_positive_features(self):
        values = np.random.default_rng(5).uniform(1, 2, (1, 6, 2))
        values[0, 0, 1] = -1.0
        gearboxes = np.array([0, 0, 0, 1, 2, 2])
        parts = calibration.summaries_of(values, gearboxes, np.array([True, False]))
        used = np.stack([np.log(values[0, :, 0]), values[0, :, 1]])
        means = np.array([[row[gearboxes == g].mean() for g in range(3)] for row in used])
        inside = [sum(((row[gearboxes == g] - row[gearboxes == g].mean()) ** 2).sum() for g in range(3)) for row in used]
        for end, expected in (("", means.mean(axis=1)), (" between gearboxes", np.log(means.std(axis=1, ddof=1))),
                              (" between records", 0.5 * np.log(np.array(inside) / 3))):
            self.assertTrue(np.allclose(parts[end][0], expected), end)
        self.assertEqual(list(calibration.summaries_of(values[:, :2], gearboxes[:2], np.array([True, False]))), [""])


if __name__ == "__main__":
    unittest.main()
