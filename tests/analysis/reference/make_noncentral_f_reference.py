"""Probabilities of the noncentral F law by adaptive integration in scipy (python3-scipy), for any
noncentrality. Writes noncentral_f.h5.

    cd tests/analysis/reference && /usr/bin/python3 make_noncentral_f_reference.py

The numerator is (root(noncentrality) + z)^2 + c with z normal and c chi-squared with one degree of
freedom less. Its probability for a denominator y is integrated over y through its normal-like root,
with scipy's own functions (Cephes and cdflib).
"""
import pathlib
import sys

import numpy as np
from scipy import integrate, special

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
from reference_tables import TableFile


def numerator_cdf(x, freedom, noncentrality):
    """P((root + z)^2 + c <= x), integrating over c."""
    root = np.sqrt(noncentrality)
    law = lambda c: np.exp((freedom / 2 - 1.5) * np.log(c / 2) - c / 2 - special.gammaln((freedom - 1) / 2)) / 2
    below = lambda c: special.ndtr(np.sqrt(x - c) - root) - special.ndtr(-np.sqrt(x - c) - root)
    end = min(x, freedom + 14 * np.sqrt(2 * freedom) + 80)
    return integrate.quad(lambda c: law(c) * below(c), 0, end, epsabs=1e-13, epsrel=1e-12, limit=400)[0]


def cdf(f, d1, d2, noncentrality):
    def slice_at(s):  # y = d2 s^2, s near 1
        y = d2 * s * s
        log_law = (d2 / 2 - 1) * np.log(y / 2) - y / 2 - special.gammaln(d2 / 2) - np.log(2)
        return np.exp(log_law) * 2 * d2 * s * numerator_cdf(d1 * f * s * s, d1, noncentrality)
    wide = 9 / np.sqrt(2 * d2)
    low, high = max(1 - wide, 1e-9), 1 + wide
    # The numerator's step, where the slice changes fastest, is a breakpoint.
    step = np.sqrt((noncentrality + d1) / (d1 * f))
    points = [p for p in step * (1 + np.array([-8, -2, 0, 2, 8]) / np.sqrt(noncentrality + d1)) if low < p < high]
    return integrate.quad(slice_at, low, high, points=points or None, epsabs=1e-12, epsrel=1e-11, limit=400)[0]


with TableFile("noncentral_f.h5", "adaptive integration in scipy", " ".join(sys.argv)) as table:
    table.write("f,numerator_degrees,denominator_degrees,noncentrality,probability\n")
    for d1, d2 in ((4, 15), (11, 188), (42, 9957)):
        for noncentrality in (50.0, 3e3, 9e4, 1.5e6, 1e7, 1e9, 1e10):
            for scale in (-1.5, 0.0, 1.0):
                spread = np.sqrt(2 / d2 + (4 * noncentrality + 2 * d1) / (noncentrality + d1) ** 2)
                f = float(f"{(noncentrality + d1) / d1 * np.exp(scale * spread):.10g}")
                table.write(f"{f!r},{d1},{d2},{noncentrality:g},{cdf(f, d1, d2, noncentrality):.10g}\n")
