"""Tables of a report as CSV: its numbers with all digits, one line for each entry of its lists."""

import csv
import io


class Number(float):
    """Number of the JSON that keeps its text, so that tables have the same digits."""

    def __new__(cls, text):
        number = super().__new__(cls, text)
        number.text = text
        return number

    def __str__(self):
        return self.text


def at(value, *path):
    """Value at keys and places of nested objects and lists; None without one."""
    for step in path:
        try:
            value = value[step]
        except (KeyError, IndexError, TypeError):
            return None
    return value


def lines(report, *lists):
    """Every combination of an element of the first list (keys from the report), an element of the
    next one (keys from the first element), and so on. An object counts as its values."""
    def walk(element, paths, found):
        if not paths:
            yield found
            return
        values = at(element, *paths[0].split()) or []
        for value in values.values() if isinstance(values, dict) else values:
            yield from walk(value, paths[1:], found + [value])
    return walk(report, lists, [])


def take(value, names, prefix=""):
    """Values of an object by name, in columns whose names begin with the prefix."""
    return {prefix + name: at(value, name) for name in names.split()}


def bounds(value, key, name):
    return {name + "_lower": at(value, key, 0), name + "_upper": at(value, key, 1)}


RATES = "tested detected failed pd lower upper"


def groups(cell, unit):
    return {f"size_low{unit}": cell["size_low"], f"size_high{unit}": cell["size_high"],
            **take(cell, RATES)}


def features(report, _unit):
    for feature, in lines(report, "features"):
        # Results have features; those of lives have the table in their evidence only.
        yield {"feature": feature["name"], **take(feature, "title unit alarm"),
               "definition": feature["doc"]}


def detection(report, unit):
    for feature, level, cell in lines(report, "detection features", "levels", "sizes"):
        yield {"feature": feature["name"], "alarm": feature["alarm"],
               **take(level, "noise_level threshold threshold_sample threshold_alarms healthy_rate"),
               **groups(cell, unit), **bounds(cell, "exact", "exact")}


def by_level(report, *lists):
    """Feature and noise level as columns, the level, and further elements, of every feature and
    level of the reliability."""
    for feature, level, *rest in lines(report, "reliability features", "levels", *lists):
        yield {"feature": feature["name"], "noise_level": level["noise_level"]}, level, *rest


def smallest_fault(report, unit):
    for place, found in enumerate(report.get("smallest_fault") or []):
        yield {"noise_level": report["noise"]["levels"][place], "feature": at(found, "feature"),
               "size" + unit: at(found, "size"), "from_curve": at(found, "from_curve"),
               "source_feature": at(found, "source", "feature"),
               "source_noise_level": at(found, "source", "noise_level")}


def pod(report, unit):
    for names, level in by_level(report):
        fit = level["hit_miss"]
        found = {**names, **take(fit, "tests hits")}
        for column, *path in (("a50", "a50", "estimate"), ("a90", "a90", "estimate"),
                              ("a90_upper", "a90", "upper")):
            found[column + unit], found[column + "_where"] = (at(fit, *path, end)
                                                              for end in ("size", "where"))
        yield {**found, **take(fit, "model intercept slope floor ceiling"),
               **take(at(fit, "fit"), "p_value", "fit_"), **take(fit, "doubtful"),
               **take(level["auc"], "auc"), **take(level["auc"], "lower upper", "auc_"),
               "no_curve": at(fit, "refusal")}


def pod_band(report, unit):
    for names, level in by_level(report):
        band = at(level, "hit_miss", "band") or {"size": []}
        for size, *values in zip(*(band[name] for name in ("size", "pod", "lower", "upper"))):
            yield {**names, "size" + unit: size, **dict(zip(("pod", "lower", "upper"), values))}


def roc(report, _unit):
    for names, level in by_level(report):
        curve = level["roc"]
        for alarms, found in zip(curve["false_alarm_rate"], curve["detection_rate"]):
            yield {**names, "false_alarm_rate": alarms, "detection_rate": found}


def ranking(report, _unit):
    for level, in lines(report, "reliability levels"):
        for place, rank in enumerate(at(level, "ranking", "ranks") or []):
            yield {"noise_level": level["noise_level"], "rank": place + 1, "feature": rank["name"],
                   **take(rank, "auc lower upper"), "p_value_from_first": at(rank, "p_values", 0)}


def misses(report, _unit):
    for names, level, entry in by_level(report, "misses inputs"):
        yield {**names, **take(level["misses"], "misses hits"), "input": entry["name"],
               **take(entry, "unit larger_in_misses lower upper p_value")}


def inputs(report, _unit):
    for name, entry in (at(report, "reliability", "robustness") or {}).items():
        for feature, level, part in lines(entry, "features", "levels", "bins"):
            yield {"input": name, "unit": entry["unit"], "feature": feature["name"],
                   "noise_level": level["noise_level"],
                   **take(part, "low high tested detected pd lower upper"),
                   "p_value": level["p_value"]}


def a90_by_input(report, unit):
    for name, entry in (at(report, "reliability", "robustness") or {}).items():
        for feature, level in lines(entry, "features", "levels"):
            for value, found in zip(level.get("values", ()), level.get("a90", ())):
                yield {"input": name, "unit": entry["unit"], "feature": feature["name"],
                       "noise_level": level["noise_level"], "value": value,
                       **{column + unit: at(found, end, "size") for column, end in (
                           ("a90", "estimate"), ("a90_lower", "lower"), ("a90_upper", "upper"))}}


def conditions(report, unit):
    for condition, level, cell in lines(report, "reliability conditions", "levels", "sizes"):
        yield {**take(condition, "input unit feature"), "noise_level": level["noise_level"],
               **groups(cell, unit)}


def numerical(report, unit):
    for part, in lines(report, "numerical shares"):
        yield {**take(part, "feature noise_level rms healthy_spread pd pd_half_width"),
               "a90" + unit: at(part, "a90"), "larger": at(part, "larger")}


def monitoring(report, _unit):
    for entry, machine in lines(report, "monitoring watched", "gearboxes"):
        healthy, sustained = entry["healthy"], at(machine, "sustained")
        yield {**take(entry, "feature detector threshold"),
               **take(healthy, "recordings alarms sustained run_length drift", "healthy_"), **take(healthy, "rate"),
               **take(at(entry, "held_out"), "recordings alarms lower upper", "held_out_"),
               "gearbox": machine["name"], **take(machine, "recordings alarms"),
               **take(at(machine, "first"), "time recording", "first_"),
               **take(sustained, "time recording", "sustained_"),
               **take(sustained, "confirmed_by recordings_left time_left"),
               "tooth": at(machine, "tooth", "number"),
               **take(at(machine, "tooth"), "same recordings", "tooth_")}


def lives(report, _unit):
    for entry, in lines(report, "monitored"):
        alarms = entry["false_alarms"]
        yield {**take(entry, "feature detector threshold threshold_hours"),
               "false_alarms": alarms["count"], "healthy_hours": alarms["hours"],
               "per_1000_h": alarms["per_1000_h"], **bounds(alarms, "bounds", "per_1000_h"),
               **take(entry, "ended found share"), **bounds(entry, "share_bounds", "share"),
               **take(entry, "share_by_chance net_share depth_50_m depth_50_bound_m depth_90_m "
                             "depth_90_bound_m warning_50_h warning_90_h unranked")}


def trade_offs(report, _unit):
    for entry, point in lines(report, "trade_offs", "points"):
        yield {**take(entry, "feature detector"),
               **take(point, "stated_per_1000_h per_1000_h share depth_50_m depth_90_m")}


def inspections(report, unit):
    for size, value in zip(at(report, "data", "size") or [], at(report, "data", "value") or []):
        yield {"size" + unit: size, "value": value}


def thresholds(report, unit):
    for point, in lines(report, "trade_off"):
        yield {**take(point, "threshold false_calls"), "a50" + unit: at(point, "a50", "estimate", "size"),
               "a90" + unit: at(point, "a90", "estimate", "size"),
               "a90_upper" + unit: at(point, "a90", "upper", "size")}


def failures(report, _unit):
    for what in ("gearboxes", "diverged", "not_settled"):
        if (count := at(report, "failures", what)) is not None:
            yield {"what": what, "gearboxes": count}


def provenance(report, _unit):
    for name, value in (report.get("provenance") or {}).items():
        yield {"name": name, "value": value}


TABLES = (features, detection, pod, pod_band, roc, misses, smallest_fault, ranking, inputs,
          a90_by_input, conditions, numerical, monitoring, lives, trade_offs, inspections,
          thresholds, failures, provenance)


def safe(value):
    """Field of a table: empty for None; text that a spreadsheet would compute begins with '."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    text = str(value)
    seen = text.strip()
    if len(seen) > 1 and seen[0] in "=+-@":
        try:
            float(seen)
        except ValueError:
            return "'" + text
    return text


def csv_text(rows):
    """CSV of lists of fields."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([safe(field) for field in row] for row in rows)
    return text.getvalue()


def files(report):
    """Name and text of each table that has rows."""
    size = at(report, "detection", "size", "unit") or at(report, "size", "unit") or "1"
    unit = "" if size == "1" else "_" + size  # as in the results file: fault_depth_m
    found = {}
    for table in TABLES:
        if rows := list(table(report, unit)):
            found[table.__name__ + ".csv"] = csv_text([list(rows[0])] + [row.values() for row in rows])
    return found
