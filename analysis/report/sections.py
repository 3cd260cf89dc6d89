"""Sections of the page below the answer."""

import detection_figures
import influence_figures
import input_figures
import numerical_figures
import signal_figures
from blocks import bullets, note, paragraph, table
from words import count, escape, noise, number, percent, plural, rate, rate_with_bounds


def detection(report, page):
    if not report.names or not report.levels:
        return page.section("detection", "Detection", note(report.unassessable_reason()))
    body = ""
    if report.reliability and report.unassessable_reason() is None:
        body += detection_figures.pod(report, page)
    else:
        body += note(report.unassessable_reason() or
                     "No detection curves, areas and ranking: they need the values of all "
                     "gearboxes at once, and this study has too many.")
    tested = any(c["tested"] for f in report.detection for level in f["levels"]
                 for c in level["sizes"])
    if tested:
        body += detection_figures.heat_maps(report, page)
    return page.section("detection", "Detection", body)


def features(report, page):
    if not report.reliability or report.unassessable_reason():
        return ""
    return page.section("features", "Features compared", detection_figures.ranking(report, page)
                        + detection_figures.roc(report, page)
                        + input_figures.combined(report, page))


def inputs(report, page):
    if not report.reliability or report.unassessable_reason():
        return ""
    body = (influence_figures.misses(report, page) + input_figures.sensitivity(report, page)
            + input_figures.rates_by_input(report, page) + input_figures.a90_maps(report, page))
    by_condition = influence_figures.conditions(report)
    if by_condition:
        body += "<h3>Thresholds by operating condition</h3>" + by_condition
    return page.section("misses", "Why faults are missed", body)


def signals(report, page):
    examples = report.data["examples"]
    contact = signal_figures.contact_loss(report)
    if examples["refusal"]:
        return page.section("signals", "Example signals",
                            note(f"No example signals: {examples['refusal']}") + contact)
    gearboxes = examples["gearboxes"]
    body = paragraph("The first healthy gearbox of the results and the first with the largest "
                     "fault. They differ in their other random inputs as well. "
                     + signal_figures.same_bits(report))
    if all(g["size"] == 0 for g in gearboxes):
        body += note("No gearbox with a fault has values, so only a healthy one is shown.")
    elif all(g["size"] > 0 for g in gearboxes):
        body += note("No healthy gearbox has values, so only a faulty one is shown.")
    if any(g["sensor"] for g in gearboxes):
        body += (signal_figures.sensor(report, page) + signal_figures.spectrum(report, page)
                 + signal_figures.tooth_rms(report, page))
    else:
        body += note("The gearbox is quasi-static: nothing accelerates, so there is no sensor "
                     "signal.")
    body += signal_figures.transmission_error(report, page)
    body += f"<details><summary>Their inputs and features</summary>{signal_figures.gearbox_table(report)}</details>"
    body += contact
    return page.section("signals", "Example signals", body)


def stiffness(report, page):
    given = report.data["stiffness"]
    body = (note(f"No stiffness curves: {given['refusal']}") if given["refusal"]
            else signal_figures.stiffness(report, page))
    return page.section("stiffness", "Mesh stiffness", body)


def _tail_row(feature, level, choice):
    first = choice is level["tail"]["choices"][0]
    return [feature["name"], f"× {number(level['noise_level'])}",
            f"{number(level['tail']['extrapolation'], 2)} times" if first else "",
            count(choice["exceedances"]), number(choice["above"], 4), number(choice["shape"], 2),
            number(choice["threshold"], 4), number(choice["rate"], 2)]


def _costs(report):
    """Thresholds of least expected cost at the noise shown, if costs were given."""
    n = report.reference
    rows = []
    for f in report.order(n):
        least = report.reliable(f, n)["least_cost"]
        if least:
            rows.append([report.names[f], number(least["threshold"], 4),
                         number(least["false_alarm_rate"], 2),
                         rate_with_bounds(least["pd"], *least["pd_bounds"]),
                         f"{number(least['cost'])} [{number(least['bounds'][0])}, "
                         f"{number(least['bounds'][1])}]", number(least["without"])])
    if not rows:
        return ""
    return table(f"Thresholds of least expected cost per record, at {noise(report.levels[n])}",
                 ["feature", "alarm beyond", "false-alarm rate", "Pd of the study's faults", "cost",
                  "without any alarm"], rows)


def thresholds(report, page):
    rows, extrapolated, weighted = [], [], []
    for f, feature in enumerate(report.detection):
        sign = ">" if feature["alarm"] == "high" else "<"
        for level in feature["levels"]:
            rows.append([feature["name"], f"× {number(level['noise_level'])}",
                         f"{sign} {number(level['threshold'], 5)}"
                         if level["threshold"] is not None else "none",
                         f"{count(level['threshold_alarms'])} of {count(level['threshold_sample'])}",
                         _bounds(level["threshold_rate"]),
                         rate_with_bounds(level["healthy_rate"], *level["healthy_rate_bounds"])])
            if level["tail"]:
                extrapolated += [_tail_row(feature, level, choice)
                                 for choice in level["tail"]["choices"]]
            if level["tilted"]:
                weighted.append([feature["name"], f"× {number(level['noise_level'])}",
                               count(level["tilted"]["gearboxes"]),
                               number(level["tilted"]["carrying"], 3),
                               f"{number(level['tilted']['extrapolation'], 2)} times"])
    units = ", ".join(f"{f['name']} in {f['unit']}" for f in report.data["features"]
                      if f["unit"] not in ("", "1"))
    body = paragraph(
        "Thresholds are set on a separate healthy sample for a false-alarm rate of "
        f"{percent(report.data['detection']['false_alarm_rate'])}; intervals are at "
        f"{percent(report.confidence)}." + (f" Units: {units}; others are pure numbers." if units else ""))
    body += ('<details><summary>Thresholds of every feature and noise level</summary>'
             + table("Alarm thresholds",
                     ["feature", "noise", "alarm if", "alarms in the healthy sample",
                      "false-alarm rate, interval", "with graded healthy gearboxes"], rows)
             + "</details>")
    if report.reliability and report.unassessable_reason() is None:
        body += influence_figures.false_alarm_curves(report, page) + _costs(report)
    if extrapolated:
        body += (note("Thresholds beyond the healthy sample are extrapolated by a generalised "
                      "Pareto distribution of its most extreme values.")
                 + "<details><summary>How far, and results with fewer values</summary>"
                 + table("Extrapolated thresholds",
                         ["feature", "noise", "rarer than one in the sample", "values fitted",
                          "fitted above", "shape", "threshold",
                          "expected rate of the threshold used"], extrapolated)
                 + "</details>")
    if weighted:
        body += (note("Thresholds by importance sampling (exponential tilting): in most records "
                      "part of the noise is drawn towards an alarm, and a weight corrects for it.")
                 + "<details><summary>Which, and from how many gearboxes</summary>"
                 + table("Thresholds by importance sampling",
                         ["feature", "noise", "healthy gearboxes", "effective number",
                          "rate rarer than one in these"], weighted)
                 + "</details>")
    body += '<details><summary>What the features are</summary>' + table(
        "Features", ["feature", "unit", "alarms when", "definition"],
        [[f["name"], f["unit"], f["alarm"], f["doc"]] for f in report.data["features"]]) + "</details>"
    return page.section("thresholds", "Thresholds and false alarms", body)


def _bounds(pair):
    if pair[0] is None or pair[1] is None:
        return "–"
    text = rate if pair[1] >= 0.005 else lambda value: number(value, 2)
    return f"[{text(pair[0])}, {text(pair[1])}]"


def errors(report, page):
    return page.section("errors", "Numerical against statistical error",
                        numerical_figures.numerical(report, page))


def failures(report, page):
    given = report.data["failures"]
    failed = given["diverged"] + given["not_settled"]
    body = paragraph(
        f"{count(failed)} of {plural(given['gearboxes'], 'gearbox', 'gearboxes')} failed: "
        f"{count(given['diverged'])} diverged, {count(given['not_settled'])} did not converge to "
        "the periodic orbit. Failed gearboxes count neither as detected nor as missed.")
    if given["first_rows"]:
        meaning = dict(part.strip().split(" ", 1) for part in given["status_meanings"].split(","))
        named = ", ".join(f"{row['row']} ({meaning.get(str(row['status']), row['status'])})"
                          for row in given["first_rows"])
        more = failed - len(given["first_rows"])
        body += note(f"Rows: {named}" + (f" and {count(more)} more." if more > 0 else "."))
    without = [f"{f['name']} at {noise(level)}: {count(number_)}" for f in given["no_value"]
               for level, number_ in zip(report.levels, f["gearboxes"]) if number_]
    if without:
        body += paragraph("Gearboxes that did not fail, but for which a feature has no value "
                          "(not a number):") + bullets(without)
    elif given["gearboxes"] > failed:
        body += paragraph("Every feature has a value for every gearbox that did not fail.")
    warnings = [f"{f['name']}: {warning}" for f in report.detection for warning in f["warnings"]]
    if warnings:
        body += paragraph("Warnings:") + bullets(warnings)
    return page.section("failures", "Failures and warnings", body)


# Entries too long for a table.
_LONG = ["study", "measured_by_study", "recordings", "recorded_gearboxes"]


def _monitoring(report):
    """HTML on monitoring the recordings in sequence."""
    data = report.data.get("monitoring")
    if not data:
        return ""
    if data["refusal"]:
        return paragraph("No monitoring in time order: " + data["refusal"] + ".")
    rows = []
    for one in data["watched"]:
        if one["threshold"] is None:
            continue
        for gearbox in one["gearboxes"]:
            if gearbox["recordings"]:
                first = gearbox["first"]
                rows.append([one["feature"], one["detector"], number(one["threshold"]),
                             f"{one['healthy']['alarms']} of {one['healthy']['recordings']}",
                             f"{gearbox['alarms']} of {gearbox['recordings']}",
                             f"{number(first['time'])} ({first['recording'].split('/')[-1]})"
                             if first else "none"])
    return (paragraph("Recordings in time order, compared with each gearbox's first "
                      f"{data['baseline_records']} recordings; thresholds at a false-alarm rate "
                      f"of {number(data['false_alarm_rate'])}; the detector restarts after every "
                      "alarm."
                      + (f" Here {data['note']}." if data["note"] else ""))
            + table("Monitoring in time order",
                    ["feature", "detector", "threshold", "healthy alarms", "later alarms",
                     "first alarm"], rows))


def over_time(report, page):
    """Section on measured recordings with known times."""
    groups = report.data.get("over_time")
    if not groups:
        return ""
    body = detection_figures.over_time(report, page, groups)
    body += _monitoring(report)
    return page.section("over-time", "Alarms over time", body)


def provenance(report, page):
    given = report.data["provenance"]
    names = ["date", "code_version", "git_hash", "compiler", "instruction_set", "host", "seed",
             "ranks", "threads", "lanes", "state", "gearboxes_asked_for"]
    rows = [[name.replace("_", " "), given[name]] for name in names if name in given]
    rows += [[name.replace("_", " "), value] for name, value in given.items()
             if name not in names + _LONG]
    if "results" in report.data:
        rows.insert(0, ["results file", report.data["results"]])
    body = table("Where the numbers come from", ["entry", "value"], rows)
    if report.data["timing"]:
        body += "<details><summary>Computing time</summary>" + table(
            "Seconds; thread seconds are sums over all threads", ["part", "s"],
            [[name.replace("_", " ").removesuffix(" s"), number(value)]
             for name, value in sorted(report.data["timing"].items())]) + "</details>"
    if given.get("recordings"):
        body += "<details><summary>The recordings</summary>" + bullets(
            given["recordings"].splitlines()) + "</details>"
    study = given.get("study") or given.get("measured_by_study")
    if study:
        body += ("<details><summary>The study, with all defaults</summary>"
                 '<pre tabindex="0" aria-label="Study file">' + escape(study)
                 + "</pre></details>")
    return page.section("provenance", "Provenance", body)


def all_of(report, page):
    parts = [detection, over_time, features, inputs, signals, stiffness, thresholds, errors, failures,
             provenance]
    return "\n".join(part(report, page) for part in parts)
