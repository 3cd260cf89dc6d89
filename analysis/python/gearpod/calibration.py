"""Finds the inputs with which simulated healthy gearboxes resemble measured ones (docs/methods/calibration.md).

The program contains this file and starts it for each step of `gearpod calibrate`. Standard input is a line of JSON, the
request of mc/recordings/calibration/calibrate.cpp, and doubles: a row per simulated set with the quantile of each input
in its prior, the number of its integration, and the features of one record after the other, which are NaN if a gearbox
failed. The reply is JSON, with `problem` where there is no result.
"""

# mypy: ignore-errors

import json
import os
import sys
import textwrap

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # threads would change the order of sums

FOLDS = 5
ACCEPTED_SHARE = 0.2  # of the simulated sets
SAMPLES = 200  # joint samples of the posterior that the study holds
INFORMED_RATIO = 0.8  # width of the interval relative to that of the prior
CORRELATED = 0.7
STRONGEST, WEAK = 3, 0.3
SETS_PER_INPUT = 50
FEWEST_FOR_SPREAD = 3


class Refusal(Exception):
    """Reason why there is no result."""


def ridge_fit(design, response, weight, ridge):
    normal = (design.T * weight) @ design
    normal[range(1, len(normal)), range(1, len(normal))] += ridge * weight.sum()
    return np.linalg.solve(normal, (design.T * weight) @ response)


def scaled(summaries, observed):
    """Summaries with robust centre 0 and scale 1. Outliers are clipped: their squares would dominate the regression."""
    middle = len(summaries) // 2
    centre = np.sort(summaries, axis=0)[middle]
    deviation = 1.4826 * np.sort(abs(summaries - centre), axis=0)[middle]
    scale = np.divide(1.0, deviation, out=np.zeros_like(deviation), where=deviation > 0)
    return [np.clip((values - centre) * scale, -5.0, 5.0) for values in (summaries, observed[None])]


def conditional_means(unit, group, summaries, observed):
    """Mean of each parameter given the summaries: for the samples, without their fold of simulations, and for the observation."""
    rows, seen = scaled(summaries, observed)
    squares = min(group.max() + 1, len(unit)) > 5 * (2 * summaries.shape[1] + 1)
    design, centre = (np.hstack([np.ones((len(x), 1)), x, *([x**2] if squares else [])]) for x in (rows, seen))
    means, at_observation = np.zeros_like(unit), np.zeros(unit.shape[1])
    for fold in range(FOLDS):
        held_out = group % FOLDS == fold
        fit = ridge_fit(design, unit, 1.0 - held_out, 1e-3)
        means[held_out] = design[held_out] @ fit
        at_observation += (centre @ fit)[0] / FOLDS
    return means, at_observation


def regression_abc(unit, group, summaries, observed, share=ACCEPTED_SHARE):
    """Indices of the samples kept, their weights of sum 1, and their parameters adjusted to the observation.

    `unit`: a row of parameters, uniform from 0 to 1, per sample; `group`: equal for samples that share a simulation.
    Sources: Beaumont et al. 2002, Blum and Francois 2010, Fearnhead and Prangle 2012."""
    means, centre = conditional_means(unit, group, summaries, observed)
    distance = np.linalg.norm(means - centre, axis=1)
    order = np.argsort(distance, kind="stable")
    count = min(max(int(share * len(order)), 1), len(order) - 1)
    reach = distance[order[count]]
    weight = 1.0 - (distance[order[:count]] / reach) ** 2 if reach > 0 else np.ones(count)
    kept, weight = order[:count][weight > 0], weight[weight > 0]
    weight = weight / weight.sum()
    design = np.hstack([np.ones((len(kept), 1)), means[kept] - centre])
    inside = np.clip(unit[kept], 1e-6, 1 - 1e-6)
    logits = np.log(inside / (1 - inside))
    line = ridge_fit(design, logits, weight, 1e-6)
    residual = logits - design @ line
    spread = ridge_fit(design, np.log(residual**2 + 1e-12), weight, 1e-6)
    # Half of the difference of log squares is the log ratio of the spreads, limited to a safe extrapolation.
    scale = np.exp(np.clip(0.5 * (spread[0] - design @ spread), -1.0, 1.0))
    return kept, weight, 1 / (1 + np.exp(-(line[0] + scale * residual)))


def weighted_quantile(values, weight, probability):
    """Value at which the cumulative weight, with half of each value's own, reaches the probability."""
    order = np.argsort(values, kind="stable")
    middle = np.cumsum(weight[order]) - 0.5 * weight[order]
    return float(np.interp(probability, middle, values[order]))


def rank_correlations(a, b):
    """Spearman's rank correlation of each column of a with each column of b."""
    def normalised(columns):
        ranks = []
        for column in columns.T:
            _, places, counts = np.unique(column, return_inverse=True, return_counts=True)
            ranks.append((np.cumsum(counts) - 0.5 * counts)[places])
        centred = np.array(ranks) - len(columns) / 2
        return centred / np.maximum(np.linalg.norm(centred, axis=1, keepdims=True), 1e-300)
    return normalised(a) @ normalised(b).T


def spread(squares, count):
    """Logarithm of the standard deviation, so that its order of magnitude does not depend on the unit."""
    return 0.5 * np.log(squares / count + 1e-30)


def summaries_of(values, gearboxes, logarithmic):
    """Summary statistics of sets, from [set][record][feature], by the ends of their names: for each feature the mean over the
    gearboxes, and the spread between gearboxes and between the records of one gearbox where there are at least three."""
    values = np.array(values, dtype=float)
    with np.errstate(all="ignore"):
        values[..., logarithmic] = np.log(values[..., logarithmic])
        _, first, sizes = np.unique(gearboxes, return_index=True, return_counts=True)
        means = np.add.reduceat(values, first, axis=1) / sizes[:, None]
        centre, within = means.mean(axis=1, keepdims=True), values - means[:, gearboxes]
        parts = {"": centre[:, 0]}
        if len(sizes) >= FEWEST_FOR_SPREAD:
            parts[" between gearboxes"] = spread(((means - centre) ** 2).sum(axis=1), len(sizes) - 1)
        if sizes.max() >= FEWEST_FOR_SPREAD:
            parts[" between records"] = spread((within**2).sum(axis=1), (sizes - 1).sum())
    return parts


class Sets:
    """Simulated sets with summaries in a region of the prior, with their parameters relative to it."""

    def __init__(self, request, data, region):
        inputs, self.low = len(request["inputs"]), np.array(region["low"])
        self.width = np.array(region["high"]) - self.low
        measured, gearboxes = np.array([request["observed"]]), np.array(request["gearboxes"])
        self.logarithmic = (measured[0] > 0).all(axis=0)
        rows = data.reshape(-1, inputs + 1 + measured.size)
        observed, simulated = (summaries_of(values, gearboxes, self.logarithmic) for values in (
            measured, rows[:, inputs + 1:].reshape(-1, *measured.shape[1:])))
        self.observed, summaries = np.hstack([*observed.values()])[0], np.hstack([*simulated.values()])
        self.names = [name + end for end in observed for name in request["features"]]
        finite = np.isfinite(summaries).all(axis=1)
        self.count, self.failed = len(rows), int((~finite).sum())
        unit = (rows[:, :inputs] - self.low) / self.width
        self.inside = finite & ((unit >= 0) & (unit <= 1)).all(axis=1)
        if self.inside.sum() < SETS_PER_INPUT * inputs:
            raise Refusal(f"only {self.inside.sum()} of {self.count} simulated sets have all features, but at least "
                          f"{SETS_PER_INPUT * inputs} are needed; raise --draws, or use a prior for which the gearboxes work")
        self.unit, self.group = unit[self.inside], rows[self.inside, inputs].astype(int)
        self.summaries = summaries[self.inside]
        self.kept, self.weight, posterior = regression_abc(self.unit, self.group, self.summaries, self.observed)
        self.posterior = self.low + posterior * self.width  # quantiles of the prior

    def quantile(self, column, probability):
        return weighted_quantile(self.posterior[:, column], self.weight, probability)


def region(request, data):
    """Range of the posterior, extended by half its width on both sides."""
    inputs = range(len(request["inputs"]))
    sets = Sets(request, data, {"low": [0.0] * len(inputs), "high": [1.0] * len(inputs)})
    low, high = (np.array([sets.quantile(p, tail) for p in inputs]) for tail in (0.005, 0.995))
    margin = 0.5 * (high - low) + 0.01
    return {"low": np.maximum(0.0, low - margin).tolist(), "high": np.minimum(1.0, high + margin).tolist()}


def at(prior, quantile):
    """Value at a quantile of the prior, in the unit of the key."""
    low, high = prior["low"], prior["high"]
    return low * (high / low) ** quantile if prior["logarithmic"] else low + quantile * (high - low)


def found_input(prior, sets, column, correlation, names):
    low, high = sets.quantile(column, 0.05), sets.quantile(column, 0.95)
    order = np.argsort(-abs(correlation), kind="stable")[:STRONGEST]
    left = (high - low) / 0.9
    return {"key": prior["key"], "prior_low": prior["low"], "prior_high": prior["high"], "logarithmic": prior["logarithmic"],
            "median": at(prior, sets.quantile(column, 0.5)), "low": at(prior, low), "high": at(prior, high), "left": left,
            "is_informed": left < INFORMED_RATIO,
            "informed_by": [f"{names[k]} ({correlation[k]:+.2f})" for k in order if abs(correlation[k]) >= WEAK]}


def feature_check(name, sets, k):
    unit = np.exp if sets.logarithmic[k] else float
    low, high = (weighted_quantile(sets.summaries[sets.kept, k], sets.weight, tail) for tail in (0.01, 0.99))
    seen, low, high = (float(unit(value)) for value in (sets.observed[k], low, high))
    return {"name": name, "measured": seen, "low": low, "high": high, "reproduced": low <= seen <= high}


def posterior(request, data):
    """The result as JSON and as text, and the study with the posterior sample."""
    sets = Sets(request, data, request["region"])
    correlation = rank_correlations(sets.unit[sets.kept], sets.summaries[sets.kept])
    found = [found_input(prior, sets, p, correlation[p], sets.names) for p, prior in enumerate(request["inputs"])]
    between = rank_correlations(sets.posterior, sets.posterior)
    pairs = [{"first": found[a]["key"], "second": found[b]["key"], "correlation": float(between[a, b])}
             for a in range(len(found)) for b in range(a + 1, len(found)) if abs(between[a, b]) > CORRELATED]
    checks = [feature_check(name, sets, k) for k, name in enumerate(request["features"])]
    # Equally likely members: those at equidistant values of the cumulative weight.
    members = np.searchsorted(np.cumsum(sets.weight), (np.arange(SAMPLES) + 0.5) / SAMPLES).clip(max=len(sets.weight) - 1)
    samples = [at(prior, np.clip(sets.posterior[members, p], 0.0, 1.0)) for p, prior in enumerate(request["inputs"])]
    result = {**request["counts"], "simulated_sets": sets.count, "failed_sets": sets.failed, "inputs": found, "together": pairs,
              "features": checks}
    return {"json": result, "text": table(result), "study": calibrated_study(request, result, samples)}


def wrapped(text, indent):
    return textwrap.fill(text, 80 - indent, break_long_words=False, break_on_hyphens=False).replace("\n", "\n" + " " * indent)


def table(result):
    text = f"{'input':<36}{'median':>11}{'5 %':>11}{'95 %':>11}{'width':>8}\n"
    for one in result["inputs"]:
        source = ("determined by " + ", ".join(one["informed_by"]) if one["is_informed"]
                  else "NOT DETERMINED by the recordings: this is the prior")
        text += (f"{one['key']:<36}{one['median']:>11.4g}{one['low']:>11.4g}{one['high']:>11.4g}{100 * one['left']:>6.0f} %\n"
                 f"    {wrapped(source, 4)}\n")
    for pair in result["together"]:
        text += wrapped(f"{pair['first']} and {pair['second']} are only determined jointly, rank correlation "
                        f"{pair['correlation']:+.2f}", 2) + "\n"
    text += ("width: width of the 90 % interval divided by that of the prior\n"
             "determined by: features that determine the input, with their rank correlations\n\n"
             f"{'feature':<22}{'measured':>12}{'simulated, 98 %':>26}\n")
    for check in result["features"]:
        text += (f"{check['name']:<22}{check['measured']:>12.5g}{check['low']:>13.5g} to{check['high']:>10.5g}  "
                 f"{'' if check['reproduced'] else 'NOT REPRODUCED'}\n")
    if result["failed_sets"]:
        text += f"{result['failed_sets']} of {result['simulated_sets']} simulated sets have no features and were ignored\n"
    return text


def comments(one, pairs):
    informed = one["is_informed"]
    yield (f"median {one['median']:.4g}, 90 % interval {one['low']:.4g} to {one['high']:.4g} (prior {one['prior_low']:g} to "
           f"{one['prior_high']:g}{', log' if one['logarithmic'] else ''})"
           f"{'' if informed else ': THE RECORDINGS DO NOT DETERMINE IT, this is the prior'}")
    if informed and one["informed_by"]:
        yield "most correlated with " + ", ".join(one["informed_by"])
    for pair in pairs:
        if one["key"] in (pair["first"], pair["second"]):
            other = pair["second"] if one["key"] == pair["first"] else pair["first"]
            yield f"determined only together with {other}, rank correlation {pair['correlation']:+.2f}: sampled in rows"


def calibrated_study(request, result, samples):
    """The study with the posterior sample in [random]. The inputs are drawn jointly, row by row, which keeps their correlations."""
    intro = [f"Calibrated to {result['records']} record(s) of {result['gearboxes']} healthy gearbox(es) by approximate",
             f"Bayesian computation: {result['simulated_sets']} simulated sets ({result['failed_sets']} failed), seed "
             f"{request['seed']}.",
             "Each distribution is the uncertainty of one value, the same for all gearboxes.",
             "A run with this study includes that uncertainty."]
    intro += [f"NOT REPRODUCED: {c['name']} {c['measured']:.4g}, simulated {c['low']:.4g} to {c['high']:.4g}"
              for c in result["features"] if not c["reproduced"]]
    lines = []
    for one, values in zip(result["inputs"], samples):
        lines += ["# " + comment for comment in comments(one, result["together"])]
        lines.append(f"{one['key']} = {{ distribution = \"empirical\", rows = 1, values = "
                     f"[{', '.join(f'{v:.5g}' for v in values)}] }}")
    random = "\n[random]\n" + "".join(line + "\n" for line in lines)
    before, section, after = request["study"].partition("\n[random]\n")
    if not section:
        before, section, after = request["study"].partition("\n[features]")
        after = section + after
    return "".join(f"# {line}\n" for line in intro) + before + random + after


def main():
    global np
    try:
        import numpy as np
    except ImportError as error:
        return {"problem": f"calibrate: {sys.executable}: {error}; install python3-numpy, or name a Python 3 with numpy in "
                           "GEARPOD_PYTHON"}
    request = json.loads(sys.stdin.buffer.readline())
    data = np.frombuffer(sys.stdin.buffer.read())
    try:
        return {"check": lambda *_: {}, "region": region, "posterior": posterior}[request["step"]](request, data)
    except Refusal as refusal:
        return {"problem": str(refusal)}


if __name__ == "__main__":
    print(json.dumps(main()))
