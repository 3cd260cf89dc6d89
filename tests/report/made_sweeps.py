"""Sweeps that nobody ran, as gearpod sweep --json would say them."""

import itertools

FEATURES = ["window_ratio", "te_rms", "te_fc", "te_fm0", "te_kurtosis", "window_kurtosis",
            "change_window_ratio"]
UNIFORM = '{ distribution = "uniform", low = 300, high = 500 }'
NORMAL = '{ distribution = "normal", mean = 400, sd = 20 }'
VARIED = {
    "sweep_one": [("sensor.noise_m_s2", ["0.5", "1", "2", "5", "20"])],
    "sweep_two": [("sensor.sampling_Hz", ["2500", "5000", "20000"]),
                  ("numerics.integrator", ['"rk4"', '"newmark"', '"sdirk3"'])],
    "sweep_words": [("operation.torque_N_m", [UNIFORM, NORMAL, "429"])],
    "sweep_three": [("sensor.gain", [str(n) for n in range(1, 12)]),
                    ("sensor.path_exponent", ["0.1", "0.2"]), ("effects.gravity", ["true", "false"])],
    "sweep_single": [("sensor.gain", ["1"])]}


def point(names, values, number, nothing):
    """Every seventh feature is without a curve, every fourth fault is a tested size."""
    of = {"results": f"sweep/{number}.h5", "values": dict(zip(names, values)), "gearboxes": 9000,
          "failed": number % 2, "false_alarm_rate": 0.05, "confidence": 0.95,
          "size_name": "fault_depth_m", "size_unit": "mm", "sizes": [1, 2, 3, 4.28],
          "shown_level": 1, "smallest_fault": [], "features": []}
    for n, level in enumerate((0, 1, 3)):
        size = 1.2 + 0.11 * (number % 5) + 0.4 * n
        missing = nothing or (number + 3 * n) % 7 == 6
        of["smallest_fault"].append({"noise_level": level, "has_threshold": True, "size": None}
                                    if missing else {
            "noise_level": level, "has_threshold": True, "size": size,
            "feature": FEATURES[number % 3], "from_curve": (number + n) % 4 != 0})
        for f, feature in enumerate(FEATURES):
            curve = (number + f + n) % 7 != 0 and not nothing
            a90, area = size + 0.2 * f, 0.99 - 0.05 * f
            of["features"].append({
                "feature": feature, "noise_level": level, "auc": area, "auc_lower": area - 0.02,
                "auc_upper": area + 0.008, "a50": 0.8 * a90 if curve else None,
                "a90": a90 if curve else None, "a90_lower": 0.95 * a90 if curve else None,
                "a90_bound": 1.07 * a90 if curve and f != 4 else None, "pd": [0.1, 0.5, 0.9, 1]})
    return of


def sweep(varied, nothing=False):
    names = [name for name, _ in varied]
    grid = itertools.product(*(values for _, values in varied))
    return {"kind": "sweep", "title": "Ideal gearbox <b> & \"sons\"",
            "varied": [{"key": name, "values": values} for name, values in varied],
            "points": [point(names, values, k, nothing) for k, values in enumerate(grid)]}


def all_of():
    made = {name: sweep(varied) for name, varied in VARIED.items()}
    made["sweep_nothing"] = sweep(VARIED["sweep_one"], nothing=True)
    silent = sweep(VARIED["sweep_one"])
    for at in silent["points"]:
        at.update(features=[], smallest_fault=[], shown_level=None)
    made["sweep_silent"] = silent
    return made
