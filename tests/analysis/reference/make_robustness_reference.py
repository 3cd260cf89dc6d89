"""Reference numbers for detection against inputs and for the combined detector, from statsmodels,
scikit-learn and scipy (python3-statsmodels, python3-sklearn).

    cd tests/analysis/reference && python3 make_robustness_reference.py > robustness_py.txt

inputs_300.h5 (size, input, hit) and combined_600.h5 (group 0: threshold sample, 1: graded; size;
three features) were generated once by this script.
"""
import os
import pathlib
import sys

import numpy as np
import statsmodels.api as sm
from scipy import optimize, stats
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import roc_auc_score

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
if not os.path.exists("combined_600.h5"):
    group = np.repeat([0, 1], [240, 360])
    a = np.where(group == 1, np.tile([0.0, 1.0, 2.0], 200), 0.0)
    common = rng.standard_normal(600)
    features = np.exp(np.column_stack([0.5 * a + 0.9 * common + 0.6 * rng.standard_normal(600),
                                       -common + 0.5 * rng.standard_normal(600) - 0.2 * a,
                                       rng.standard_normal(600)]))
    with TableFile("combined_600.h5", "drawn once by numpy", " ".join(sys.argv)) as table:
        np.savetxt(table, np.column_stack([group, a, features]), delimiter=",", fmt="%.6g",
                   header="group,size,f1,f2,f3", comments="")

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

# The combined detector: same split, scores, penalty.
group, a, *features = read_table("combined_600.h5").values()
features = np.column_stack(features)


def trains(i):
    mask = (1 << 64) - 1
    x = (i + 0x9E3779B97F4A7C15) & mask
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & mask
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & mask
    return (x ^ (x >> 31)) & 1 == 1


number = np.where(group == 1, np.arange(600) - 240, np.arange(600))
train = np.array([trains(int(i)) for i in number])
faulty = a > 0
scores = np.empty_like(features)
for j in range(3):
    healthy = np.sort(features[train & ~faulty, j])
    rank = 0.5 * (np.searchsorted(healthy, features[:, j], "left") + np.searchsorted(healthy, features[:, j], "right"))
    scores[:, j] = stats.norm.ppf((rank + 0.5) / (len(healthy) + 1))
scores = (scores - scores[train].mean(axis=0)) / scores[train].std(axis=0)
model = LogisticRegression(C=1.0, solver="newton-cg", tol=1e-9, max_iter=10000).fit(scores[train], faulty[train])
say("combined trained healthy, faulty", np.sum(train & ~faulty), np.sum(train & faulty))
say("combined intercept, weights", model.intercept_[0], *model.coef_[0])
say("combined area", roc_auc_score(faulty[~train], model.decision_function(scores[~train])))
say("single area f1", roc_auc_score(faulty[~train], features[~train, 0]))
held = model.decision_function(scores)
sample = np.sort(held[~train & (group == 0)])
threshold = sample[int(np.ceil((len(sample) + 1) * 0.9 - 1e-9)) - 1]
say("combined threshold at 10 % false alarms", threshold)
for value in (0.0, 1.0, 2.0):
    cell = ~train & (group == 1) & (a == value)
    say("combined detected, tested", np.sum(held[cell] > threshold), np.sum(cell))
