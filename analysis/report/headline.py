"""Headline answer: the smallest fault found, with its feature and noise level, and what limits
it."""

import math

import detection_figures
import numerical_figures
from words import (TESTED_ALONE, count, escape, input_name, joined, noise, number, percent, plural, quantity,
                   rate_with_bounds)

CARRIED = ('<abbr title="the bound of another feature or noise level that finds no more faults">'
           "†</abbr>")
TESTED_SIZE = ('<abbr title="a tested size; there is no detection curve for sizes in between">*'
               "</abbr>")
ARCSECONDS = 180 * 3600 / math.pi  # per radian


def confidence_text(report):
    return f"90\u00a0% probability at {percent(report.confidence)} confidence"


def a_fault(report):
    """Name of the fault with its article, if it has one: "a crack", "pitting"."""
    return report.data.get("fault") or "a fault"


def fault(report):
    return a_fault(report).removeprefix("a ")


def _best_rate(report, level):
    """Feature that finds most of the largest faults, with its cell."""
    best = None
    for f, name in enumerate(report.names):
        cells = [c for c in report.cells(f, level) if c["size_high"] > 0 and c["pd"] is not None]
        if cells and (best is None or cells[-1]["pd"] > best[1]["pd"]):
            best = (name, cells[-1])
    return best


def sentence(report):
    """Headline as text."""
    unassessable_reason = report.unassessable_reason()
    if unassessable_reason:
        return unassessable_reason
    level = report.reference
    found = report.smallest_fault(level)
    at = noise(report.levels[level])
    if found:
        kind = a_fault(report)
        return (f"{kind[0].upper()}{kind[1:]} of {report.sizes.text(found['size'])} is found with "
                f"{confidence_text(report)} by {found['feature']} at {at}.")
    best = _best_rate(report, level)
    if best is None:
        return f"At {at} no feature has a detection rate."
    name, cell = best
    whom = ("the faulty recordings" if report.sizes.name == "label" else
            f"those of {report.sizes.group(cell['size_low'], cell['size_high'])}")
    silent = sum(f["levels"][level]["threshold"] is None for f in report.detection)
    others = (f" {silent} of the {len(report.detection)} features "
              f"{'has' if silent == 1 else 'have'} no threshold." if silent else "")
    return (f"No tested {fault(report)} is found with {confidence_text(report)} at {at}. "
            f"The best is {name}, which finds {rate_with_bounds(cell['pd'], cell['lower'], cell['upper'])} of "
            f"{whom}.{others}")


def _noise_limit(report):
    """Text on how the smallest fault found depends on noise."""
    sizes = [(report.levels[n], report.smallest_fault(n)) for n in range(len(report.levels))]
    here = report.smallest_fault(report.reference)
    if len(sizes) < 2:
        return None
    texts = []
    first = sizes[0]
    if first[0] < report.levels[report.reference] and first[1]:
        quiet = report.sizes.text(first[1]["size"])
        low = "without noise" if first[0] == 0 else f"at {noise(first[0])}"
        if here is None or first[1]["size"] < 0.9 * here["size"]:
            tested = "" if first[1]["from_curve"] else " (a tested size)"
            texts.append(f"{low} it would be {quiet}{tested}")
        else:
            texts.append(f"{low} it is no smaller ({quiet})")
    last = sizes[-1]
    if last[0] > report.levels[report.reference]:
        if last[1] is None and report.without_threshold(len(report.levels) - 1):
            texts.append(f"at {noise(last[0])} there is no threshold")
        elif last[1] is None:
            texts.append(f"at {noise(last[0])} no tested size is found")
        elif here and last[1]["size"] > 1.1 * here["size"]:
            texts.append(f"at {noise(last[0])} it is {report.sizes.text(last[1]['size'])}")
    return "Noise: " + joined(texts) + "." if texts else None


def influences(misses):
    """Inputs with a significant influence on misses, in the given order."""
    return [i for i in misses["inputs"] if i["p_value"] is not None and i["p_value"] < 0.05]


def _input_limit(report, found):
    if not report.reliability:
        return None
    f = report.feature_number(found["feature"])
    misses = report.reliable(f, report.reference)["misses"]
    if misses["refusal"]:
        return None
    strong = influences(misses)
    sizes = report.sizes.group(misses["smallest"], misses["largest"])
    if not strong:
        return (f"Misses at {sizes} ({misses['misses']} of {misses['misses'] + misses['hits']}): "
                "no random input has a significant influence.")
    texts = []
    for i in strong[:3]:
        larger = i["larger_in_misses"] >= 0.5
        share = i["larger_in_misses"] if larger else 1 - i["larger_in_misses"]
        side = "larger" if larger else "smaller"
        chance = " of pairs, 50\u00a0% is chance" if not texts else ""
        texts.append(f"{side} {input_name(i['name'], i['unit'])} "
                     f"({number(100 * share, 2)}\u00a0%{chance})")
    return (f"Misses at {sizes} ({misses['misses']} of {misses['misses'] + misses['hits']}): the "
            f"missed gearbox tends to have the {joined(texts)}.")


def _source(found):
    return f"{found['source']['feature']} at {noise(found['source']['noise_level'])}"


def _sample_limit(report, found):
    if not report.reliability:
        return ("Sizes: the study is too large for detection curves, so this is one of the "
                "tested sizes, not a size between them.")
    f = report.feature_number(found["feature"])
    pod = report.reliable(f, report.reference)["hit_miss"]
    if found["source"]:
        return (f"Sizes: this is the bound of {_source(found)}, which finds no more faults of any "
                f"tested size, so it also holds for {found['feature']} here"
                + ("." if found["from_curve"] else
                   "; one of the tested sizes, not a size between them."))
    if not found["from_curve"]:
        why = pod["refusal"] or ("its goodness of fit is rejected" if pod["doubtful"]
                                 else "its curve does not reach that far")
        return (f"Sizes: there is no detection curve for it ({found['feature']}: {why}), so it is "
                "one of the tested sizes, not a size between them.")
    estimate = pod["a90"]["estimate"]
    if estimate["where"] != "reached":
        return None
    return (f"Sample: {report.sizes.text(estimate['size'])} is the estimate (a90); "
            f"{plural(pod['tests'], 'faulty gearbox', 'faulty gearboxes')} leave it uncertain up to "
            f"{report.sizes.text(found['size'])} (a90/{number(100 * report.confidence)}).")


def limits(report):
    """Sentences on what limits the answer; empty where there is none."""
    if report.unassessable_reason():
        return []
    found = report.smallest_fault(report.reference)
    texts = [_noise_limit(report)]
    if found:
        texts += [_input_limit(report, found), _sample_limit(report, found),
                  numerical_figures.limit(report, found["feature"])]
    return [text for text in texts if text]


def threshold(report, name, n):
    detection = report.detection[report.feature_number(name)]
    level = detection["levels"][n]
    side = ">" if detection["alarm"] == "high" else "<"
    unit = report.unit(name)
    text = (f"{side} {quantity(level['threshold'], unit, 4)}" if level["threshold"] is not None
            else "none")
    return text, rate_with_bounds(report.data["detection"]["false_alarm_rate"],
                                  *level["threshold_rate"])


def narrow_note(report):
    """False alarms of the answer in words, for narrow screens where the table's last column has no
    room."""
    found = report.smallest_fault(report.reference)
    if found is None:
        return ""
    false = threshold(report, found["feature"], report.reference)[1]
    return (f'<p class="small narrow">False alarms of {escape(found["feature"])} at '
            f"{noise(report.levels[report.reference])}: {false}.</p>")


def footnotes(report):
    """Explanation of the marks in the table, shown below the limits."""
    faults = [found for n in range(len(report.levels)) if (found := report.smallest_fault(n))]
    notes = []
    if not all(found["from_curve"] for found in faults):
        notes.append(TESTED_ALONE)
    carried = list(dict.fromkeys(_source(found) for found in faults if found["source"]))
    if carried:
        notes.append(f"† the bound of {escape(joined(carried))}, which finds no more faults of "
                     "any tested size.")
    return "".join(f'<p class="small">{text}</p>' for text in notes)


def table(report):
    """Smallest fault by noise level, as HTML."""
    rows = []
    for n, level in enumerate(report.levels):
        found = report.smallest_fault(n)
        mark = ' class="reference"' if n == report.reference else ""
        if found is None:
            none = "no threshold" if report.without_threshold(n) else "none"
            cells = f'<td>{none}</td><td>–</td><td>–</td><td class="wide">–</td>'
        else:
            alarm, false = threshold(report, found["feature"], n)
            basis = ("" if found["from_curve"] else TESTED_SIZE) + (
                CARRIED if found["source"] else "")
            cells = (f"<td><strong>{escape(report.sizes.text(found['size']))}</strong>{basis}</td>"
                     f"<td>{escape(found['feature'])}</td><td>{escape(alarm)}</td>"
                     f'<td class="wide">{false}</td>')
        rows.append(f'<tr{mark}><th scope="row">× {number(level)}</th>{cells}</tr>')
    confidence = number(100 * report.confidence)
    return ('<div class="scroll" role="region" tabindex="0" '
            'aria-label="Smallest fault found, by noise">'
            f"<table><caption>Smallest {fault(report)} found with {confidence_text(report)}</caption>"
            '<thead><tr><th scope="col">Noise</th>'
            f'<th scope="col">{escape(report.sizes.name.replace("fault ", ""))}</th>'
            '<th scope="col">by</th><th scope="col">alarm if</th>'
            f'<th scope="col" class="wide">false alarms [{confidence} %]</th></tr></thead>'
            f"<tbody>{''.join(rows)}</tbody></table></div>")


def noise_unit(report):
    """Text on the noise that x 1 stands for."""
    given = report.data["noise"]
    texts = []
    if not given["sensor_m_s2"] and given["encoder_rad"] == 0:
        return "The study adds no noise. "
    if given["sensor_m_s2"] is not None:
        texts.append(f"{quantity(given['sensor_m_s2'], 'm/s^2')} rms at the sensor")
    if given["encoder_rad"] is not None:
        texts.append(f"{number(given['encoder_rad'] * ARCSECONDS)} arc seconds rms on the "
                     "transmission error")
    return f"Noise × 1 is {joined(texts)} (nominal). " if texts else ""


def facts(report):
    failures = report.data["failures"]
    failed = failures["diverged"] + failures["not_settled"]
    healthy, faulty = report.sample()
    set_ = any(level["threshold"] is not None for f in report.detection for level in f["levels"])
    recorded = bool(report.data["provenance"].get("recordings"))
    sample = "these healthy recordings" if recorded else "an independent healthy sample"
    thresholds = (f" Thresholds from {sample} at a false-alarm rate of "
                  f"{percent(report.data['detection']['false_alarm_rate'])}." if set_ else "")
    if recorded:
        return (f"{count(failures['gearboxes'])} recordings, {count(healthy)} of them known as "
                f"healthy and {count(faulty)} as faulty.{thresholds}")
    return (f"{noise_unit(report)}{count(failures['gearboxes'])} simulated gearboxes, of which "
            f"{plural(failed, 'failed', 'failed')}; {count(healthy)} healthy and {count(faulty)} "
            f"faulty ones have values.{thresholds}")


def headline_texts(report):
    """Headline texts: shortage of healthy gearboxes, answer, assumptions, and epistemic
    uncertainty."""
    assessable = report.unassessable_reason() is None
    texts = [report.data["detection"]["shortage"] if assessable else None, sentence(report),
             report.data.get("assumptions"),
             detection_figures.epistemic_text(report, report.reference) if assessable else None]
    return [text for text in texts if text]


def html_of(report):
    parts = [f'<p class="answer">{escape(text)}</p>' for text in headline_texts(report)]
    texts = limits(report)
    if report.unassessable_reason() is None:
        parts += [table(report), narrow_note(report)]
    if texts:
        parts.append('<h2 id="limits">What limits it</h2><ul class="limits">'
                     + "".join(f"<li>{escape(text)}</li>" for text in texts) + "</ul>")
    if report.unassessable_reason() is None:
        parts.append(footnotes(report))
    parts.append(f'<p class="facts">{facts(report)}</p>')
    return "\n".join(parts)
