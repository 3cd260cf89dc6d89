"""Reference numbers for the POD of inspections, from statsmodels and scipy.

    cd tests/analysis/reference && /usr/bin/python3 make_inspection_reference.py > inspection_py.txt

The tables were generated once: hit/miss of 120 flaws, each inspected twice (inspections_hits.csv);
and 40 flaws measured three times (inspections_responses.csv).
"""
import os

import numpy as np
import pandas as pd
import statsmodels.api as sm
import statsmodels.formula.api as smf
from scipy import optimize, stats


def say(name, *values):
    print(name, *(f"{v:.8g}" for v in values))


if not os.path.exists("inspections_hits.csv"):
    rng = np.random.default_rng(11)
    size = np.round(rng.uniform(0.2, 4.0, 120), 3)
    shared = 0.6 * rng.standard_normal(120)
    rows = [(i, s, int(rng.uniform() < -np.expm1(-np.exp(-1.6 + 1.1 * s + b))))
            for i, (s, b) in enumerate(zip(size, shared)) for _ in range(2)]
    pd.DataFrame(rows, columns=["specimen", "size [mm]", "hit"]).to_csv("inspections_hits.csv", index=False)
    size = np.round(rng.uniform(1.0, 9.0, 40), 2)
    between = 0.25 * rng.standard_normal(40)
    table = {"specimen": np.arange(40), "size [mm]": size}
    for name in "ABC":
        table[name] = np.round(np.exp(0.4 + 1.2 * np.log(size) + between + 0.3 * rng.standard_normal(40)), 3)
    pd.DataFrame(table).to_csv("inspections_responses.csv", index=False)

hits = pd.read_csv("inspections_hits.csv")
size, hit = hits["size [mm]"].to_numpy(), hits["hit"].to_numpy()
links = sm.families.links
for log_size in (False, True):
    x = np.log(size) if log_size else size
    design = sm.add_constant(x)
    scale = "log" if log_size else "linear"
    for name, link in (("logit", links.logit), ("probit", links.probit), ("cloglog", links.cloglog)):
        fit = sm.GLM(hit, design, family=sm.families.Binomial(link())).fit(tol=1e-12)
        say(f"{name} {scale} intercept slope loglikelihood", *fit.params, fit.llf)
    mirrored = sm.GLM(1 - hit, sm.add_constant(-x),
                      family=sm.families.Binomial(links.cloglog())).fit(tol=1e-12)
    say(f"loglog {scale} intercept slope loglikelihood", -mirrored.params[0], mirrored.params[1],
        mirrored.llf)
# Likelihood-ratio bounds of a90 by the logit of size, by a root search of the profile.
design = sm.add_constant(size)
fit = sm.GLM(hit, design, family=sm.families.Binomial()).fit(tol=1e-12)
eta = np.log(9.0)


def profile(at):
    def miss(slope):
        return np.logaddexp(0.0, -(2 * hit - 1) * (eta + slope * (size - at))).sum()
    return 2.0 * (optimize.minimize_scalar(miss, bracket=(fit.params[1], 0.8 * fit.params[1]),
                                           tol=1e-14).fun + fit.llf)


a90 = (eta - fit.params[0]) / fit.params[1]
for name, chi in (("one-sided", stats.norm.ppf(0.95)**2), ("two-sided", stats.chi2.ppf(0.95, 1)),
                  ("joint", stats.chi2.ppf(0.95, 2))):
    say(f"logit linear a90 {name} upper", a90,
        optimize.brentq(lambda at: profile(at) - chi, a90, a90 + 3.0, xtol=1e-12))
# Robust covariance of clusters, without statsmodels' correction for the number of parameters.
clustered = sm.GLM(hit, design, family=sm.families.Binomial()).fit(
    tol=1e-12, cov_type="cluster", cov_kwds={"groups": hits["specimen"], "use_correction": False})
grown = clustered.cov_params() * 120.0 / 119.0
say("logit linear cluster covariance", grown[0, 0], grown[0, 1], grown[1, 1])
by = np.array([-1 / fit.params[1], -a90 / fit.params[1]])
say("logit linear cluster wald a90 upper", a90 + stats.norm.ppf(0.95) * np.sqrt(by @ grown @ by))
# Firth's penalty on separated outcomes: 10 misses below 10 hits.
x = np.arange(1.0, 21.0)
y = (x > 10.5).astype(float)
design = sm.add_constant(x)


def penalised(b, hold=None):
    p = 1 / (1 + np.exp(-design @ b))
    information = design.T @ ((p * (1 - p))[:, None] * design)
    return -(np.log(np.where(y > 0, p, 1 - p)).sum() + 0.5 * np.log(np.linalg.det(information)))


firth = optimize.minimize(penalised, [-10.0, 1.0], method="Nelder-Mead",
                          options={"xatol": 1e-11, "fatol": 1e-13, "maxiter": 10000})
say("firth intercept slope", *firth.x)
a90 = (eta - firth.x[0]) / firth.x[1]


def held(at):
    return 2.0 * (optimize.minimize_scalar(lambda s: penalised(np.array([eta - s * at, s])),
                                           bracket=(firth.x[1], 0.8 * firth.x[1]), tol=1e-14).fun - firth.fun)


say("firth a90 upper", a90, optimize.brentq(lambda at: held(at) - stats.chi2.ppf(0.95, 1), a90, a90 + 9.0,
                                            xtol=1e-11))
# Random specimen effects: statsmodels' mixed model by maximum likelihood.
wide = pd.read_csv("inspections_responses.csv")
long = wide.melt(id_vars=["specimen", "size [mm]"], value_name="value")
long["x"], long["y"] = np.log(long["size [mm]"]), np.log(long["value"])
mixed = smf.mixedlm("y ~ x", long, groups="specimen").fit(reml=False, method=["bfgs", "lbfgs"], gtol=1e-10)
say("mixed intercept slope between within loglikelihood", *mixed.fe_params, np.sqrt(mixed.cov_re.iloc[0, 0]),
    np.sqrt(mixed.scale), mixed.llf)
say("mixed covariance of intercept and slope", *mixed.cov_params().iloc[:2, :2].to_numpy()[[0, 0, 1], [0, 1, 1]])
# Censored below 3 and above 20: the first measurement alone, by scipy.
x, y = np.log(wide["size [mm]"].to_numpy()), np.log(wide["A"].to_numpy())
low, high = np.log(3.0), np.log(20.0)


def tobit(p, through=None):
    mean, sigma = p[0] + p[1] * x, np.exp(p[2])
    return -np.where(y <= low, stats.norm.logcdf((low - mean) / sigma),
                     np.where(y >= high, stats.norm.logsf((high - mean) / sigma),
                              stats.norm.logpdf(y, mean, sigma))).sum()


best = optimize.minimize(tobit, [0.4, 1.2, -1.0], method="Nelder-Mead",
                         options={"xatol": 1e-11, "fatol": 1e-13, "maxiter": 10000})
say("censored intercept slope sigma", best.x[0], best.x[1], np.exp(best.x[2]))
threshold, z = np.log(6.0), stats.norm.ppf(0.9)


def response_profile(at):
    def miss(p):
        return tobit([threshold + z * np.exp(p[1]) - p[0] * at, p[0], p[1]])
    return 2.0 * (optimize.minimize(miss, best.x[1:], method="Nelder-Mead",
                                    options={"xatol": 1e-11, "fatol": 1e-13}).fun - best.fun)


a90 = (threshold + z * np.exp(best.x[2]) - best.x[0]) / best.x[1]
say("censored a90 likelihood-ratio upper", np.exp(a90), np.exp(optimize.brentq(
    lambda at: response_profile(at) - stats.norm.ppf(0.95)**2, a90, a90 + 1.0, xtol=1e-11)))
# Exact bounds of a50 and a90 from the first 12 of the same measurements, uncensored.
few_x, few_y = x[:12], np.log(wide["A"].to_numpy()[:12])
slope, intercept = np.polyfit(few_x, few_y, 1)
sigma = np.sqrt(((few_y - intercept - slope * few_x)**2).sum() / 10)


def exact_bound(pod, confidence):
    u = stats.norm.ppf(pod)

    def beyond(size):
        spread = np.sqrt(1 / 12 + (np.log(size) - few_x.mean())**2 / ((few_x - few_x.mean())**2).sum())
        return stats.nct.cdf((intercept + slope * np.log(size) - np.log(6.0)) / sigma / spread, 10, u / spread) - confidence
    return optimize.brentq(beyond, 2.0, 8.6, xtol=1e-12)


say("exact bounds", *(exact_bound(pod, confidence) for pod in (0.5, 0.9) for confidence in (0.05, 0.95)))
# Box and Cox's power of the same measurements uncensored, by scipy on the residuals of least squares.
value, design = wide["A"].to_numpy(), sm.add_constant(x)


def negative_log_likelihood(power):
    y = np.log(value) if power == 0 else (value**power - 1) / power
    return 0.5 * len(y) * np.log(sm.OLS(y, design).fit().ssr) - (power - 1) * np.log(value).sum()


say("box-cox power", optimize.minimize_scalar(negative_log_likelihood, bounds=(-2, 2), method="bounded",
                                              options={"xatol": 1e-10}).x)
# Noise laws.
noise = np.array([1.1, 0.4, 2.3, 0.9, 1.7, 0.6, 3.1, 1.3, 0.8, 2.0, 1.5, 0.5])
shape, _, scale = stats.weibull_min.fit(noise, floc=0)
say("weibull scale shape loglikelihood", scale, shape, stats.weibull_min.logpdf(noise, shape, 0, scale).sum())
say("lognormal loglikelihood", stats.lognorm.logpdf(noise, np.log(noise).std(), 0,
                                                    np.exp(np.log(noise).mean())).sum())
