"""Synthetic sweeps in the format of gearpod sweep --json and gearpod sweep --lives --json."""

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
    """One point: every seventh feature is without a curve, every fourth fault is a tested size."""
    of = {"results": f"sweep/{number}.h5", "values": dict(zip(names, values)), "gearboxes": 9000,
          "failed": number % 2, "false_alarm_rate": 0.05, "confidence": 0.95,
          "shortage": None, "size_name": "fault_depth_m", "size_unit": "mm", "sizes": [1, 2, 3, 4.28],
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


def findings(varied, points, *more):
    """Findings with a sentence, a table with a row for each point, and further statements."""
    names = [name.rpartition(".")[2] for name, _ in varied]
    table = {"title": "All points", "columns": [*names, "size"],
             "rows": [[*p["values"].values(), "1.06 [0.98, > 4.28]"] for p in points]}
    return [{"key": "headline", "title": "", "blocks": [
        {"key": "headline", "text": "Smallest fault found <b> at noise x 1."},
        {"key": "differences", "text": "No point differs."}, *more,
        *({"key": key, **table} for key in ("points", "features", "records", "files")),
        {"key": "varied", "text": f"Varied: {names[0]}."}]}]


def sweep(varied, nothing=False):
    names = [name for name, _ in varied]
    grid = itertools.product(*(values for _, values in varied))
    points = [point(names, values, k, nothing) for k, values in enumerate(grid)]
    return {"kind": "sweep", "title": "Ideal gearbox <b> & \"sons\"", "order": FEATURES,
            "varied": [{"key": name, "values": values} for name, values in varied],
            "findings": findings(varied, points), "points": points}


LIVES = {
    "lives_sweep_one": [("life.interval_h", ["1", "5", "20", "100"])],
    "lives_sweep_two": [("life.torque_scatter", ["0", "0.02", "0.1"]),
                        ("gearbox.tooth_quality", ["4", "6", "8"])]}


def life_results(feature, detector, found, threshold=True):
    """Results of 30 lives; without a threshold nothing is known."""
    if not threshold:
        return {"feature": feature, "detector": detector, "threshold": None, "threshold_hours": 500,
                "false_alarms": {"count": 0, "hours": 500, "per_1000_h": None,
                                 "bounds": [None, None], "dispersion": 1, "expected": [None, None]},
                "ended": 0, "found": 0, "share": None, "share_bounds": [None, None],
                "net_share": None, "unranked": "no threshold",
                **{key: None for key in ("depth_50_m", "depth_50_bound_m", "depth_90_m",
                                         "depth_90_bound_m", "warning_50_h", "warning_90_h")}}
    share, deep = found / 30, 4e-3 - 1e-4 * found
    return {"feature": feature, "detector": detector, "threshold": 3.2, "threshold_hours": 5000,
            "false_alarms": {"count": 6, "hours": 6000, "per_1000_h": 1,
                             "bounds": [0.4 + 0.01 * found, 2.1], "dispersion": 1.2,
                             "expected": [0.5, 1.8]},
            "ended": 30, "found": found, "share": share,
            "share_bounds": [max(0, share - 0.1), min(1, share + 0.1)],
            "net_share": share - 0.05,
            "unranked": None if found > 5 else "no significantly larger share found than by chance",
            "depth_50_m": deep / 2 if found > 15 else None, "depth_50_bound_m": deep / 1.8,
            "depth_90_m": deep if found > 27 else None,
            "depth_90_bound_m": 1.1 * deep if found > 28 else None,
            "warning_50_h": 20.0 * found if found else None,
            "warning_90_h": 4.0 * found if found else None}


def lives_sweep(varied, threshold=True):
    names = [name for name, _ in varied]
    points = []
    for k, values in enumerate(itertools.product(*(values for _, values in varied))):
        points.append({
            "results": f"sweep/{k}.h5", "values": dict(zip(names, values)), "lives": 32,
            "failed": k % 2, "confidence": 0.95, "false_alarms_per_1000_h": 1,
            "last_depth_m": 4e-3, "record": "81 turns of 31 mesh periods",
            "interpolation": {"first": 0.2, "last": 0.05, "load": None if k else 0.01},
            "monitored": [life_results(feature, detector, max(0, 30 - (d + 2 * k + 9 * f)), threshold)
                          for f, feature in enumerate(("change_window_ratio", "window_z", "fused"))
                          for d, detector in enumerate(("single", "cusum 0.5"))]})
        monitored = points[-1]["monitored"]
        points[-1]["ranking"] = sorted((i for i, one in enumerate(monitored) if one["unranked"] is None),
                                       key=lambda i: -monitored[i]["net_share"])
    return {"kind": "lives-sweep", "title": "Lives <b> & \"sons\"",
            "varied": [{"key": name, "values": values} for name, values in varied],
            "order": [{"feature": feature, "detector": "single"}
                      for feature in ("change_window_ratio", "window_z", "fused")] if threshold else [],
            "findings": findings(varied, points), "points": points}


def all_of():
    made = {name: sweep(varied) for name, varied in VARIED.items()}
    made["sweep_nothing"] = sweep(VARIED["sweep_one"], nothing=True)
    unknown = sweep(VARIED["sweep_one"], nothing=True)
    unknown["findings"] = findings(VARIED["sweep_one"], unknown["points"], {
        "key": "shortage.0", "text": "Too few healthy gearboxes for a false-alarm rate of 0.001."})
    for at in unknown["points"]:
        for level in at["smallest_fault"]:
            level["has_threshold"] = False
    made["sweep_unknown"] = unknown
    silent = sweep(VARIED["sweep_one"])
    for at in silent["points"]:
        at.update(features=[], smallest_fault=[], shown_level=None)
    silent["order"] = []
    made["sweep_silent"] = silent
    for name, varied in LIVES.items():
        made[name] = lives_sweep(varied)
    made["lives_sweep_blind"] = lives_sweep(LIVES["lives_sweep_one"], threshold=False)
    return made
