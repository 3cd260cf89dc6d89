"""The answer at the top of the page: the smallest fault found with its figure, the conditions for
which it holds, and what limits it."""

import detection_figures
from blocks import bullets, note
from words import escape


def answers(report):
    """What was found in recordings over time, and detection."""
    return [*report.texts("found."), report.text("headline")]


def conditions(report):
    """Further answers, assumptions of the answer, the next step, and the epistemic uncertainty."""
    texts = [report.text(key) for key in ("assumptions", "record", "next", "noise", "unknown")]
    return [text for text in answers(report)[1:] + texts if text]


def limits(report):
    return report.texts("limit.")


def html_of(report, page):
    figure = report.text("figure")
    chart = (f'<figure>{detection_figures.headline(report, page)}<figcaption>{escape(figure)}'
             "</figcaption></figure>" if figure else "")
    holds = "".join(f"<p>{escape(text)}</p>" for text in conditions(report))
    shortage = report.text("shortage")
    parts = [f'<div class="lead"><p class="answer">{escape(answers(report)[0])}</p>{chart}'
             f'<div class="holds">{holds}{note(shortage) if shortage else ""}</div></div>']
    parts.append(report.table("smallest_fault") + report.table("rates_by_noise"))
    if limits(report):
        parts.append('<h2 id="limits">What limits it</h2>'
                     + bullets(limits(report)).replace("<ul>", '<ul class="limits">'))
    parts += [f'<p class="small">{escape(text)}</p>' for text in report.texts("note.")]
    parts.append(f'<p class="facts">{escape(report.text("facts"))}</p>')
    return "\n".join(parts)
