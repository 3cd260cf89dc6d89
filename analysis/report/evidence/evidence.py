"""Evidence on condition indicators: the report's statements and tables by the subjects of EASA AMC1
29.1465 (vibration health monitoring, CS-29 Amendment 12, 2024) and MIL-HDBK-1823A (2009; probability
of detection). It words no result anew; each subject states what the results do not provide."""

import hashlib
import pathlib

from words import joined, number, printable, rate

# Key and title of a subject; what it is in the terms of AMC1 29.1465 and of MIL-HDBK-1823A.
SUBJECTS = (
    ("definition", "Definition of the indicators",
     "indicator, the component and the kind of damage that it monitors",
     "inspection system and its response a-hat"),
    ("threshold", "Thresholds and their derivation", "alert threshold", "decision threshold"),
    ("false_alarms", "False-alarm evidence", "false alerts",
     "noise analysis and false calls; trade-off with detection"),
    ("detection", "Detection evidence", "detection of incipient damage, and its lead",
     "POD(a), a90 and its confidence bound; hit/miss or a-hat data"),
    ("limits", "Assumptions, conditions and limits",
     "operating conditions for which the application is shown",
     "targets and conditions of the demonstration"),
    ("data", "Data", "vibration data acquired", "specimens and raw data"),
    ("software", "Software", "processing and its software",
     "software of the demonstration, as it is to be used"),
    ("further", "Further findings", "", ""))

# Subject of the findings in each section of a report; those of other sections are further findings.
SECTIONS = {"state": "limits", "found": "detection", "answer": "detection", "headline": "detection",
            "limits": "limits", "values": "data", "thresholds": "threshold", "pod": "detection",
            "false_alarms": "false_alarms", "time": "software",
            "too_many": "limits", "rates": "detection", "conditions": "threshold",
            "monitoring": "detection", "sensors": "detection",
            "other_fault": "false_alarms", "contact": "limits", "numerical": "limits",
            "failures": "limits", "results": "detection", "basis": "data", "method": "detection"}
# Subject of findings that is not their section's, by the beginning of the key.
KEYS = {"threshold": ("thresholds.", "threshold", "tails", "facts", "monitoring.how",
                      "basis.thresholds"),
        "false_alarms": ("shortage", "false_", "no_false_alarms.", "monitoring.sample",
                         "monitoring.note", "noise.", "trade_off", "effect"),
        "detection": ("headline", "rates.", "curves.", "responses", "unranked."),
        "limits": ("assumptions", "next", "record", "holds", "unknown", "warning.", "interpolation", "failed", "note."),
        "data": ("table",),
        "further": ("effects",)}

REPEAT = ("The file study.toml of this folder is the study with all defaults; it follows this table. The "
          "same version repeats the results bit for bit with `gearpod {} study.toml`, for any number of "
          "threads, ranks and lanes.")

# Rows, and how the results are computed again, for each kind of results.
KINDS = {"gearboxes": ("simulated gearboxes", REPEAT.format("run")),
         "lives": ("simulated gearboxes whose cracks grow until the tooth fails",
                   REPEAT.format("lives")),
         "recordings": ("measured recordings",
                        "The file study.toml of this folder states how the recordings were evaluated; "
                        "it follows this table."),
         "inspections": ("a table of inspections", "")}

SCOPE = ("Evidence on vibration indicators from {}. It is arranged by subjects of EASA AMC1 29.1465 "
         "(vibration health monitoring) and of MIL-HDBK-1823A (reliability assessment of inspection "
         "systems). The table names subjects, not clauses: those texts and the authority decide what has "
         "to be shown. This document is no statement of compliance.")
OUTSIDE = ("Not provided by any result of gearpod: the airborne and ground installation and its "
           "qualification (sensors, wiring, acquisition, storage, transfer, display), the instructions "
           "for its operation and for the action on an alarm, and experience in service.")
RULE = ("A threshold is the order statistic of rank r = ceil((n + 1)(1 - q)) of n healthy values, in the "
        "order of the alarm side, for the false-alarm rate q. Its rate has the Beta(n + 1 - r, r) "
        "distribution (Wilks 1941), from which its interval follows; values of one gearbox count with "
        "their effective number.")
TAIL = (" Where the sample is too small for the rate, a generalised Pareto distribution of its most "
        "extreme values extrapolates it.")
ENTRIES = ("code_version", "git_hash", "compiler", "instruction_set", "kernels", "seed", "ranks",
           "threads", "lanes", "host", "date", "state", "gearboxes_asked_for")


def subject_of(section, key):
    """Subject of a finding: by the longest beginning of its key, else by its section."""
    found = [(len(start), subject) for subject, starts in KEYS.items() for start in starts
             if key.startswith(start)]
    return max(found)[1] if found else SECTIONS.get(section, "further")


def statement(key, text):
    return {"key": "evidence." + key, "text": text}


def table(key, title, columns, rows, labels=1):
    return {"key": "evidence." + key, "title": title, "columns": columns, "rows": rows,
            "labels": labels}


def kind_of(data):
    kinds = {"lives": "lives", "inspection": "inspections"}
    recorded = data.get("provenance", {}).get("kind") == "recordings"
    return kinds.get(data.get("kind"), "recordings" if recorded else "gearboxes")


def indicators(features):
    """Definitions of the features, as the program has them."""
    other = "Not an indicator of this program; the study names the program that computes it."
    return table("indicators", "", ["indicator", "in words", "unit", "alarm if",
                                    "definition and source"],
                 [[f["name"], f["title"], "ratio" if f["unit"] == "1" else f["unit"], f["alarm"],
                   f["doc"]] if f["doc"] else [f["name"], "-", "-", "-", other] for f in features])


def interval(bounds):
    if None in bounds:
        return "-"
    small = bounds[1] < 0.005
    return "[" + ", ".join(number(bound, 2) if small else rate(bound) for bound in bounds) + "]"


def healthy_alarms(detection, rows):
    """Alarms of healthy rows: those that set the threshold, and test gearboxes of size 0."""
    found = []
    for feature in detection["features"]:
        for level in feature["levels"]:
            if not level["threshold_sample"]:
                continue
            cell = next((cell for cell in level["sizes"]
                         if cell["size_high"] == 0 and cell["tested"] > 0), None)
            found.append([feature["name"], f"x {number(level['noise_level'])}",
                          f"{level['threshold_alarms']} of {level['threshold_sample']}",
                          f"1 in {level['threshold_sample'] + 1}",
                          f"{cell['detected']} of {cell['tested']}" if cell else "-",
                          interval(cell["exact"]) if cell else "-"])
    confidence = number(100 * detection["confidence"])
    return table("healthy", f"Alarms of healthy {rows}, by part of the sample",
                 ["indicator", "noise", "of those that set the threshold",
                  "smallest rate that they can set", "of others, not used for the threshold",
                  f"false-alarm rate of the others at {confidence} % (Clopper-Pearson)"], found, 2)


def recorded_files(provenance):
    """Measured files with their numbers of recordings and hashes."""
    names = [name.rpartition(" row ")[0] or name
             for name in provenance.get("recordings", "").split("\n")]
    hashes = [line.split("  ", 1) for line in provenance.get("recorded_files", "").splitlines()]
    return table("recordings", "Measured files", ["file", "recordings", "SHA-256"],
                 [[printable(entry[-1]), str(names.count(entry[-1])), entry[0]] for entry in hashes])


def file_hash(path):
    try:
        return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
    except OSError:
        return "cannot be read"


def added(data, kind, source):
    """Blocks in addition to those of the report, each with its subject."""
    provenance = data.get("provenance", {})
    if kind != "inspections":
        yield "definition", indicators(data["features"])
    if data.get("detection"):
        yield "false_alarms", healthy_alarms(data["detection"], "recordings" if kind == "recordings"
                                             else "gearboxes")
    if provenance and (data.get("title") or data.get("fault")):
        fault = f" Damage that is monitored: {data['fault']}." if data.get("fault") else ""
        yield "definition", statement("monitored",
                                      f"Study: {data.get('title') or 'without a title'}.{fault}")
    yield "data", table("file", "Table of inspections" if kind == "inspections" else "Results file",
                        ["file", "SHA-256"], [[printable(source["file"]), file_hash(source["file"])]])
    if kind == "recordings":
        yield "data", recorded_files(provenance)
    yield "software", statement("repeat", KINDS[kind][1])
    yield "software", table("software", "", ["entry", "value"],
                            [[name.replace("_", " "), printable(provenance[name])]
                             for name in ENTRIES if provenance.get(name)]
                            + [["report by", source["report_by"]]])


def absent(sorted_, kind):
    """Evidence that the results do not provide, by subject. `sorted_`: blocks by subject."""
    def has(subject, *starts):
        return any(block["key"].startswith(start) for block in sorted_[subject] for start in starts)

    simulated, recorded = kind in ("gearboxes", "lives"), kind == "recordings"
    inspected = kind == "inspections"
    texts = {
        "definition": [
            inspected and "a definition of the response (the table has only its values)",
            recorded and "the component and the kind of damage behind the label of the faulty "
                         "recordings"],
        "threshold": [
            not has("threshold", "threshold", "monitoring.how", "basis.thresholds")
            and ("a threshold (the table has decisions, hit or miss)" if inspected else
                 "a threshold (see the false-alarm evidence for the reason)")],
        "false_alarms": [
            not has("false_alarms", "monitoring.sample") and recorded
            and "held-out alarms (the recordings have no times, or are not watched over time)",
            inspected and not has("false_alarms", "false_calls")
            and "false calls (the table has no rows without flaw)",
            "alarms of real machines in service" if simulated else
            "a rate per flight hour over a fleet (alarms are counted per record)"],
        "detection": [
            not (has("detection", "curves.") and has("detection", "smallest_fault"))
            and not any(block["key"] in ("curve", "results", "smooth") for block in sorted_["detection"])
            and "a POD curve with a90 and its bound (it needs faulty rows of several known sizes)",
            not inspected
            and not any(block["key"] in ("monitoring", "results") for block in sorted_["detection"])
            and "sustained alarms and the lead before failure ("
            + ("`gearpod lives` provides them)" if kind == "gearboxes" else
               "they need times and a later fault)"),
            "detection on real machines, in tests with seeded faults or in service" if simulated else
            "an independent check of the labels and sizes that the table states"],
        "data": [
            recorded and not has("data", "evidence.recordings")
            and "hashes of the recordings (the results are of an earlier version; run `features` "
                "again)",
            not simulated and "calibration of the sensors, and how the data were acquired"]}
    return {subject: [text for text in found if text] for subject, found in texts.items()}


def count_text(blocks):
    tables = sum("rows" in block for block in blocks)
    counts = ((len(blocks) - tables, "statement"), (tables, "table"))
    return ", ".join(f"{n} {name}{'s' * (n != 1)}" for n, name in counts) if blocks else "not provided"


def sections(data):
    """The report's findings by subject, each once, with what the pack adds and what is absent.
    data["evidence"]: "file" of the results or inspections, and the program that reports."""
    kind = kind_of(data)
    by_subject = {subject[0]: [] for subject in SUBJECTS}
    extra = [(subject, block) for subject, block in added(data, kind, data["evidence"])
             if block.get("text") or block.get("rows")]
    by_subject["definition"] += [block for _, block in extra if block["key"] == "evidence.indicators"]
    stated = set()
    for section in data["findings"]:
        for block in section["blocks"]:
            if "rows" in block or block["text"] not in stated:
                stated.add(block.get("text"))
                by_subject[subject_of(section["key"], block["key"])].append(block)
    keys = [block["key"] for blocks in by_subject.values() for block in blocks]
    if kind != "inspections" and any(key.startswith("thresholds.") for key in keys):
        by_subject["threshold"].append(statement("rule", RULE + (TAIL if "tails" in keys else "")))
    for subject, block in extra:
        if block["key"] != "evidence.indicators":
            by_subject[subject].append(block)
    scope = [statement("scope", SCOPE.format(KINDS[kind][0])),
             table("map", "Subjects", ["subject", "in AMC1 29.1465", "in MIL-HDBK-1823A",
                                       "in this document"],
                   [[*subject[1:], count_text(by_subject[subject[0]])] for subject in SUBJECTS[:-1]]),
             statement("outside", OUTSIDE)]
    for subject, texts in absent(by_subject, kind).items():
        if texts:
            by_subject[subject].append(
                statement(f"absent.{subject}", f"Not provided by this study: {joined(texts)}."))
    return [{"key": "scope", "title": "Scope", "blocks": scope}] + [
        {"key": key, "title": title, "blocks": by_subject[key]}
        for key, title, _, _ in SUBJECTS if by_subject[key]]


def with_evidence(data):
    """The report with its evidence: "sections" like "findings", and "study", the text or null."""
    provenance = data.get("provenance", {})
    study = provenance.get("study") or provenance.get("measured_by_study")
    return {**data, "evidence": {"sections": sections(data), "study": study or None}}


def files(data):
    """Name and bytes of each file of the pack."""
    import json

    import tables
    from evidence import evidence_document

    report = with_evidence(data)
    found = {"evidence.pdf": evidence_document.pdf(report),
             "report.json": json.dumps(report, indent=2, ensure_ascii=False, sort_keys=True) + "\n"}
    if study := report["evidence"]["study"]:
        found["study.toml"] = "# Study of an evidence pack, with all defaults\n" + study
    found |= tables.files(report)
    found = {name: text if isinstance(text, bytes) else text.encode() for name, text in found.items()}
    hashes = "".join(f"{hashlib.sha256(text).hexdigest()}  {name}\n" for name, text in found.items())
    found["SHA256SUMS"] = ("# SHA-256 of the files of an evidence pack\n" + hashes).encode()
    return found
