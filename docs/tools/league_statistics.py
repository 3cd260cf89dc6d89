"""Statistics of the league: areas under the ROC curves of many indicators in the same gearboxes, their
differences, thresholds and detected shares."""

import math

import numpy as np
import scipy.stats


class Areas:
    """Areas under the ROC curves and their covariance (DeLong, DeLong and Clarke-Pearson 1988)."""

    def __init__(self, area, covariance, pairs):
        self.area, self.covariance, self.pairs = area, covariance, pairs  # pairs: disjoint ones of healthy and faulty

    def differences(self, index):
        """Differences of an indicator from all, and their standard errors."""
        variance = np.diag(self.covariance) + self.covariance[index, index] - 2 * self.covariance[index]
        return self.area[index] - self.area, np.sqrt(np.maximum(variance, 0.0))

    def only(self, chosen):
        """The chosen indicators alone."""
        return Areas(self.area[chosen], self.covariance[np.ix_(chosen, chosen)], self.pairs)

    def intervals(self, confidence=0.95):
        """Intervals on the logit scale; of complete separation that of as many successes as there are pairs, as
        in the program's report."""
        z, tail = scipy.stats.norm.ppf(0.5 + confidence / 2), ((1 - confidence) / 2) ** (1 / self.pairs)
        inner = np.clip(self.area, 1e-12, 1 - 1e-12)
        half = z * np.sqrt(np.diag(self.covariance)) / (inner * (1 - inner))
        low, high = (scipy.special.expit(scipy.special.logit(inner) + side * half) for side in (-1, 1))
        low = np.where(self.area == 1, tail, np.where(self.area == 0, 0.0, low))
        return low, np.where(self.area == 0, 1 - tail, np.where(self.area == 1, 1.0, high))

    def indistinguishable_from_best(self, error=0.05):
        """True for the indicators that DeLong's test does not tell from the best, with Holm's correction
        for all pairs of indicators."""
        count = len(self.area)
        p = np.ones((count, count))
        for index in range(count):
            difference, deviation = self.differences(index)
            same = deviation == 0
            z = np.abs(difference) / np.where(same, 1.0, deviation)
            p[index] = np.where(same, np.where(difference == 0, 1.0, 0.0), 2 * scipy.stats.norm.sf(z))
        upper = np.triu_indices(count, 1)
        corrected = holm(p[upper])
        p[upper] = corrected
        p.T[upper] = corrected
        best = int(np.argmax(self.area))
        alike = p[best] >= error
        alike[best] = True
        return alike


def delong(healthy, faulty):
    """Areas of indicators from their values, gearboxes x indicators, larger towards the alarm."""
    m, n = len(faulty), len(healthy)
    both = scipy.stats.rankdata(np.concatenate([faulty, healthy]), axis=0)
    of_faulty = (both[:m] - scipy.stats.rankdata(faulty, axis=0)) / n
    of_healthy = 1 - (both[m:] - scipy.stats.rankdata(healthy, axis=0)) / m
    return Areas(of_faulty.mean(axis=0),
                 np.atleast_2d(np.cov(of_faulty.T)) / m + np.atleast_2d(np.cov(of_healthy.T)) / n, min(m, n))


def holm(p):
    """p-values corrected by Holm (1979)."""
    order = np.argsort(p)
    scaled = np.maximum.accumulate(p[order] * np.arange(len(p), 0, -1))
    corrected = np.empty(len(p))
    corrected[order] = np.minimum(scaled, 1.0)
    return corrected


def threshold_rank(count, rate):
    """Rank of the threshold among the healthy values in ascending order, from 1; None if they are too few
    (docs/methods/detection-statistics.md)."""
    rank = math.ceil((count + 1) * (1 - rate) - 1e-9)
    return rank if rank <= count else None


def rate_interval(count, rank, confidence=0.95):
    """Interval of the false-alarm rate of the threshold of a rank (Wilks 1941)."""
    tail = (1 - confidence) / 2
    return scipy.stats.beta.ppf([tail, 1 - tail], count + 1 - rank, rank)


def detected_share(healthy, faulty, rate):
    """Shares of the faulty gearboxes beyond the threshold, by indicator; None if the healthy ones are too few."""
    rank = threshold_rank(len(healthy), rate)
    return None if rank is None else (faulty > np.sort(healthy, axis=0)[rank - 1]).mean(axis=0)


def share_interval(healthy, faulty, rate, resamples=400, seed=1):
    """95 % intervals of detected_share(), by indicator, from resampled healthy and faulty gearboxes."""
    random = np.random.default_rng(seed)
    shares = [detected_share(healthy[random.integers(0, len(healthy), len(healthy))],
                             faulty[random.integers(0, len(faulty), len(faulty))], rate) for _ in range(resamples)]
    return np.percentile(np.array(shares), [2.5, 97.5], axis=0)
