"""Reference numbers for tests/analysis from numpy, scipy and statsmodels.

    cd tests/analysis/reference && python3 make_reference.py > reference_py.txt

ahat_92.h5: Example 1 of MIL-HDBK-1823A (a-hat against a), from the US Air Force Research
Laboratory's POD 4.5 (github.com/AFRL-Material-State-Awareness/POD4.5,
ahat_vs_a_1823_Example1_LogY.csv); sizes in 1e-3 inch.
"""
import os
import pathlib
import sys

import numpy as np
import statsmodels.api as sm
from scipy import stats
from statsmodels.stats.diagnostic import het_breuschpagan, normal_ad

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
from reference_tables import TableFile, read_table

size, ahat = read_table("ahat_92.h5").values()


def say(name, *values):
    print(name, *(f"{v:.10g}" for v in values))


def bounds(fit, x, threshold, pod, back):
    """POD bound by the delta method on (intercept, slope, log sigma), root by bisection on x."""
    n, sigma = len(x), np.sqrt(fit.mse_resid)
    cov = np.asarray(fit.cov_params())
    def lower(at, sign):
        row = np.array([1.0, at])
        u = (row @ fit.params - threshold) / sigma
        return u + sign * stats.norm.ppf(0.95) * np.sqrt(row @ cov @ row / sigma**2 + u**2 / (2 * (n - 2)))
    found = []
    for sign in (1, 0, -1):
        low, high = x.min(), x.max()
        for _ in range(200):
            mid = 0.5 * (low + high)
            low, high = (low, mid) if lower(mid, sign) > stats.norm.ppf(pod) else (mid, high)
        found.append(back(mid))
    return found


for log_size in (False, True):
    for log_response in (False, True):
        x = np.log(size) if log_size else size
        y = np.log(ahat) if log_response else ahat
        name = f"ahat {'log' if log_size else 'lin'} size {'log' if log_response else 'lin'} response"
        design = sm.add_constant(x)
        fit = sm.OLS(y, design).fit()
        say(f"{name} intercept slope sigma", *fit.params, np.sqrt(fit.mse_resid))
        groups = [y[x == v] for v in np.unique(x)]
        pure = sum(((g - g.mean()) ** 2).sum() for g in groups)
        f = ((fit.ssr - pure) / (len(groups) - 2)) / (pure / (len(x) - len(groups)))
        say(f"{name} lack of fit", f, stats.f.sf(f, len(groups) - 2, len(x) - len(groups)))
        quadratic = sm.OLS(y, np.column_stack([design, x**2])).fit()
        say(f"{name} quadratic term", quadratic.tvalues[2] ** 2, quadratic.pvalues[2])
        lm, p, _, _ = het_breuschpagan(fit.resid, design)
        say(f"{name} breusch-pagan", lm, p)
        a2, p = normal_ad(np.asarray(fit.resid))
        say(f"{name} anderson-darling", a2, p)
        say(f"{name} aic with jacobian", -2 * fit.llf + 6 + (2 * np.log(ahat).sum() if log_response else 0))

# The standard's own example is curved on all scales according to these tests. Bounds are therefore
# compared on line_60.h5, generated once: log response on log size.
if not os.path.exists("line_60.h5"):
    rng = np.random.default_rng(4)
    drawn = rng.uniform(0.5, 4.0, 60)
    response = np.exp(0.3 + 1.1 * np.log(drawn) + 0.25 * rng.standard_normal(60))
    with TableFile("line_60.h5", "drawn once by numpy: log response on log size", " ".join(sys.argv)) as table:
        np.savetxt(table, np.column_stack([drawn, response]), delimiter=",", fmt="%.6g", header="size,response", comments="")
size, ahat = read_table("line_60.h5").values()
x, y = np.log(size), np.log(ahat)
fit = sm.OLS(y, sm.add_constant(x)).fit()
say("line threshold 2 a50", *bounds(fit, x, np.log(2.0), 0.5, np.exp))
say("line threshold 2 a90", *bounds(fit, x, np.log(2.0), 0.9, np.exp))
