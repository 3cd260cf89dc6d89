"""The answer at the top of the page: the smallest fault found with its figure, the conditions for
which it holds, and what limits it."""

import detection_figures
from blocks import bullets, note
from words import escape


def conditions(report):
    """Assumptions of the answer, and its epistemic uncertainty."""
    texts = [report.text(key) for key in ("assumptions", "unknown")]
    return [text for text in texts if text]


def limits(report):
    return report.texts("limit.")


def table(report):
    """Smallest fault by noise level, as HTML. Its last column has no room on narrow screens, so
    the reference level's follows in words."""
    head, rows = report.rows("smallest_fault")
    title = escape(report.findings["smallest_fault"]["title"])

    def line(tag, cells):
        return "".join(f'<{tag}{" class=wide" if k + 2 == len(cells) else ""}>{cell}</{tag}>'
                       for k, cell in enumerate(cells[1:]))
    body = ""
    for n, row in enumerate(rows):
        cells = [escape(cell) for cell in row]
        cells[1] = f"<strong>{cells[1]}</strong>" if row[2] != "–" else cells[1]
        mark = ' class="reference"' if n == report.reference else ""
        body += f'<tr{mark}><th scope="row">{cells[0]}</th>{line("td", cells)}</tr>'
    columns = "".join(f'<th scope="col"{" class=wide" if k + 1 == len(head) else ""}>'
                      f"{escape(name)}</th>" for k, name in enumerate(head))
    shown = rows[report.reference]
    return (f'<div class="scroll" role="region" tabindex="0" aria-label="{title}"><table>'
            f"<caption>{title}</caption><thead><tr>{columns}</tr></thead><tbody>{body}</tbody>"
            f'</table></div><p class="small narrow">{escape(head[-1].capitalize())}, '
            f"{escape(shown[2])}: {escape(shown[-1])}.</p>")


def html_of(report, page):
    figure = report.text("figure")
    chart = (f'<figure>{detection_figures.headline(report, page)}<figcaption>{escape(figure)}'
             "</figcaption></figure>" if figure else "")
    holds = "".join(f"<p>{escape(text)}</p>" for text in conditions(report))
    shortage = report.text("shortage")
    parts = [f'<div class="lead"><p class="answer">{escape(report.text("headline"))}</p>{chart}'
             f'<div class="holds">{holds}{note(shortage) if shortage else ""}</div></div>']
    if "smallest_fault" in report.findings:
        parts.append(table(report))
    if limits(report):
        parts.append('<h2 id="limits">What limits it</h2>'
                     + bullets(limits(report)).replace("<ul>", '<ul class="limits">'))
    parts += [f'<p class="small">{escape(text)}</p>' for text in report.texts("note.")]
    parts.append(f'<p class="facts">{escape(report.text("facts"))}</p>')
    return "\n".join(parts)
