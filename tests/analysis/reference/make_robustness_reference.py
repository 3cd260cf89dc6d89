"""Reference numbers for detection against inputs, from statsmodels and scipy (python3-statsmodels).

    cd tests/analysis/reference && python3 make_robustness_reference.py > robustness_py.txt

inputs_300.h5 (size, input, hit) was generated once by this script.
"""
import os
import pathlib
import sys

import numpy as np
import statsmodels.api as sm
from scipy import optimize, stats

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))
from reference_tables import TableFile, read_table


def say(name, *values):
    print(name, *(f"{v:.10g}" for v in values))


rng = np.random.default_rng(12)
if not os.path.exists("inputs_300.h5"):
    size, z = rng.uniform(0.5, 4.0, 300), rng.normal(10.0, 2.0, 300)
    p = 1 / (1 + np.exp(-(-4.0 + 2.0 * size + 0.4 * (z - 10))))
    with TableFile("inputs_300.h5", "drawn once by numpy", " ".join(sys.argv)) as table:
        np.savetxt(table, np.column_stack([size, z, rng.random(300) < p]), delimiter=",", fmt="%.6g",
                   header="size,input,hit", comments="")

# Likelihood ratio of a quadratic in the input in addition to the size, and a90 with Fieller's
# bounds.
size, z, hit = read_table("inputs_300.h5").values()
full = sm.GLM(hit, np.column_stack([np.ones(300), size, z, z * z]), family=sm.families.Binomial()).fit(tol=1e-13)
less = sm.GLM(hit, np.column_stack([np.ones(300), size]), family=sm.families.Binomial()).fit(tol=1e-13)
ratio = 2 * (full.llf - less.llf)
say("inputs logit likelihood ratio", ratio, stats.chi2.sf(ratio, 2))
b, cov, q = full.params, full.cov_params(), stats.norm.ppf(0.95)
for value in np.quantile(z, [0.05, 0.25, 0.5, 0.75, 0.95]):
    def beyond(at, sign):
        row = np.array([1.0, at, value, value * value])
        return row @ b - np.log(9.0) + sign * q * np.sqrt(row @ cov @ row)
    say("inputs a90 at value: lower, estimate, upper", value,
        *(optimize.brentq(beyond, 0.0, 20.0, args=(sign,), xtol=1e-12) for sign in (1, 0, -1)))
