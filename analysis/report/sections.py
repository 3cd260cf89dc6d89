"""Sections of the page below the answer."""

import detection_figures
import influence_figures
import input_figures
import monitoring_figures
import numerical_figures
import signal_figures
from blocks import bullets, note, paragraph, table
from words import escape, percent


def detection(report, page):
    if report.curves:
        body = detection_figures.comparison(report, page)
    else:
        body = (note(report.text("headline")) if not report.assessable else "") + report.notes("too_many")
    rated = any(c["size_high"] > 0 and c["pd"] is not None
                for f in report.detection for level in f["levels"] for c in level["sizes"])
    body += detection_figures.by_feature(report, page) if rated else report.tables("rates.")
    return page.section("detection", "Detection", body + report.tables("values."))


def sensors(report):
    """Each sensor of the run alone, and all together."""
    if not report.table("sensors"):
        return ""
    return "<h3>Sensors</h3>" + report.notes("sensors.") + report.table("sensors")


def features(report, page):
    if not report.curves:
        return ""
    return page.section("features", "Features compared", detection_figures.ranking(report, page)
                        + detection_figures.roc(report, page) + sensors(report))


def inputs(report, page):
    if not report.curves:
        return ""
    body = influence_figures.misses(report, page) + input_figures.rates_by_input(report, page)
    if "conditions.how" in report.findings:
        body += ("<h3>Thresholds by operating condition</h3>" + report.notes("conditions.")
                 + report.tables("conditions."))
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
                 + signal_figures.spectrogram(report, page)
                 + signal_figures.tooth_rms(report, page) + signal_figures.sensors(report, page))
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


def thresholds(report, page):
    body = paragraph("Thresholds are set on a separate healthy sample; intervals are at "
                     f"{percent(report.confidence)}.")
    body += ("<details><summary>Thresholds of every feature and noise level</summary>"
             + report.tables("thresholds.") + "</details>")
    if report.curves:
        body += (influence_figures.false_alarm_curves(report, page) + report.notes("no_false_alarms."))
    body += "".join(map(paragraph, report.texts("other_fault."))) + report.table("other_fault")
    if report.table("tails"):
        body += (note("Thresholds beyond the healthy sample are extrapolated by a generalised "
                      "Pareto distribution of its most extreme values.")
                 + "<details><summary>How far, and results with fewer values</summary>"
                 + report.table("tails") + "</details>")
    if any(level["tilted"] for feature in report.detection for level in feature["levels"]):
        body += note("Thresholds by importance sampling (exponential tilting): in most records "
                     "part of the noise is drawn towards an alarm, and a weight corrects for it.")
    body += '<details><summary>What the features are</summary>' + table(
        "Features", ["feature", "in words", "unit", "alarms when", "definition"],
        [[f["name"], f["title"], f["unit"], f["alarm"], f["doc"]] for f in report.data["features"]]) + "</details>"
    return page.section("thresholds", "Thresholds and false alarms", body)


def errors(report, page):
    return page.section("errors", "Numerical against statistical error",
                        numerical_figures.numerical(report, page))


def failures(report, page):
    body = "".join(paragraph(text) for text in report.texts("failures") + report.texts("warning."))
    return page.section("failures", "Failures and warnings", body)


# Entries too long for a table.
_LONG = ["study", "measured_by_study", "recordings", "recorded_gearboxes",
         "recorded_alignments", "recorded_teeth"]


def monitoring(report, page):
    """Section on measured recordings with known times."""
    if not report.data.get("monitoring"):
        return ""
    body = "".join(map(paragraph, report.texts("monitoring.")))
    body += monitoring_figures.figures(report, page) or report.table("monitoring")
    return page.section("monitoring", "Monitoring over time", body)


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
    body += "".join(map(paragraph, report.texts("time")))
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
    parts = [detection, monitoring, features, inputs, signals, stiffness, thresholds, errors, failures,
             provenance]
    return "\n".join(part(report, page) for part in parts)
