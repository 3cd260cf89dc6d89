"""HTML elements of the sections: figures with their data, tables, notes."""

from charts import SvgNames
from words import escape


class Page:
    """Numbers figures and charts in order and collects the sections for the table of contents."""

    def __init__(self, figures=None):
        self.names = SvgNames(figures)
        self.figures = 0
        self.sections = []

    def section(self, name, title, body):
        self.sections.append((name, title))
        return (f'<section id="{name}" aria-labelledby="{name}-heading">'
                f'<h2 id="{name}-heading">{escape(title)}</h2>\n{body}\n</section>')

    def figure(self, title, charts, how_to_read, data):
        """HTML of a figure. `charts`: one or more SVG side by side; `data`: HTML of the table with
        their numbers."""
        self.figures += 1
        label = f"Figure {self.figures}"
        kind = {1: "one", 2: "two", 4: "two"}.get(len(charts), "many")
        return (f'<figure id="figure-{self.figures}">'
                f'<h3>{label}. {escape(title)}</h3>'
                f'<div class="charts {kind}">{"".join(charts)}</div>'
                f"<figcaption>{escape(how_to_read)}</figcaption>"
                f'<details><summary>Numbers of {label.lower()}</summary>{data}</details></figure>')


def table(caption, head, rows):
    """HTML of a table. `rows`: lists of cells; cells are text, not HTML."""
    body = "".join(
        f'<tr><th scope="row">{escape(row[0])}</th>'
        + "".join(f"<td>{escape(cell)}</td>" for cell in row[1:]) + "</tr>" for row in rows)
    columns = "".join(f'<th scope="col">{escape(cell)}</th>' for cell in head)
    return (f'<div class="scroll" role="region" tabindex="0" aria-label="{escape(caption)}"><table>'
            f"<caption>{escape(caption)}</caption><thead><tr>{columns}</tr></thead>"
            f"<tbody>{body}</tbody></table></div>")


def note(text):
    return f'<p class="note">{escape(text)}</p>'


def answer(text):
    return f'<p class="answer">{escape(text)}</p>'


def small(text):
    return f'<p class="small">{escape(text)}</p>'


def paragraph(text):
    return f"<p>{escape(text)}</p>"


def bullets(texts):
    return "<ul>" + "".join(f"<li>{escape(text)}</li>" for text in texts) + "</ul>"
