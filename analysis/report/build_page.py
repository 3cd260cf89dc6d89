"""Writes the page of a report to standard output.

    gearpod report F.h5 --json F.json         (or of gearpod pod, compare, sweep, lives,
                                                 accuracy)
    python3 build_page.py F.json > F.html       (- reads the JSON from standard input)

With a final --figures FOLDER the figures are also written there, each as SVG, PNG and PDF. With a final
--pdf (for a report) its summary on one sheet is written instead, as PDF. With a final --csv or --evidence
the files of these folders are written instead: a line with their names and sizes (JSON), then the files.

gearpod report F.h5 --html F.html does both. Everything on the page comes from the JSON; the page
loads nothing and runs no script.
"""

import importlib
import json
import pathlib
import sys

from tables import Number
from words import escape


DRAWING = (("numpy", "python3-numpy"), ("matplotlib", "python3-matplotlib"))


def missing_packages(needed):
    packages = []
    for module, package in needed:
        try:
            importlib.import_module(module)
        except ImportError:
            packages.append(package)
    return packages


def study_parts(data, page):
    """Title, headline sentence, HTML of the answer, HTML of the sections."""
    import headline
    import sections
    from report import Report

    report = Report(data)
    banner = "".join(f'<p class="banner" role="note">{escape(text)}</p>'
                     for key in ("part", "incomplete") if (text := report.text(key)))
    return (report.title(), headline.answers(report)[0], banner + headline.html_of(report, page),
            sections.all_of(report, page))


# Command and module of the page of each kind of JSON.
PAGES = {"accuracy": ("accuracy", "pages.accuracy_page"), "inspection": ("pod", "pages.inspection_page"),
         "comparison": ("compare", "pages.comparison_page"), "modes": ("modes", "pages.modes_page"),
         "sweep": ("sweep", "pages.sweep_page"), "lives-sweep": ("sweep", "pages.lives_sweep_page"),
         "lives": ("lives", "lives.lives_page")}


def page_html(data, figures=None):
    import charts
    from blocks import Page

    page = Page(figures)
    command, module = PAGES.get(data.get("kind"), ("report", None))
    make = importlib.import_module(module).parts if module else study_parts
    title, sentence, summary, body = make(data, page)
    contents = "".join(f'<li><a href="#{name}">{escape(title_)}</a></li>'
                       for name, title_ in page.sections)
    style = (pathlib.Path(__file__).parent / "page.css").read_text(encoding="utf-8")
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="description" content="{escape(sentence)}">
<title>{escape(title)} – gearpod report</title>
<link rel="icon" href="data:,">
<style>
{charts.scheme_css()}{style}</style>
</head>
<body>
<a class="skip" href="#main">Skip to the answer</a>
<header><p class="product">gearpod report</p><h1>{escape(title)}</h1></header>
<main id="main" tabindex="-1">
<section id="answer" aria-label="Answer">
{summary}
</section>
<nav aria-label="Contents"><h2>Contents</h2><ul>{contents}</ul></nav>
{body}
</main>
<footer><p>Every number of this page is in <code>gearpod {command} --json</code>.</p></footer>
</body>
</html>
"""


def framed(files):
    """Files, texts or bytes by their names, as one text: names and sizes in the first line."""
    contents = [text if isinstance(text, bytes) else text.encode() for text in files.values()]
    return json.dumps(list(zip(files, map(len, contents)))).encode() + b"\n" + b"".join(contents)


# Modules that make documents, and the packages that they need.
DOCUMENTS = {"--pdf": ("summary_sheet", DRAWING), "--csv": ("tables", ()),
             "--evidence": ("evidence.evidence", DRAWING)}


def document_of(kind, data):
    """Bytes of a PDF, or of the files of a folder."""
    module = importlib.import_module(DOCUMENTS[kind][0])
    if kind == "--pdf":
        from report import Report

        return module.pdf(Report(data))
    return framed(module.files(data))


def main(arguments):
    figures = None
    document = arguments[1] if len(arguments) == 2 else None
    if len(arguments) == 3 and arguments[1] == "--figures":
        figures = pathlib.Path(arguments[2])
    elif len(arguments) != 1 and document not in DOCUMENTS:
        print(__doc__, file=sys.stderr)
        return 2
    missing = missing_packages(DOCUMENTS[document][1] if document else DRAWING)
    if missing:
        print(f"{sys.executable} lacks packages for this output: apt-get install "
              + " ".join(missing), file=sys.stderr)
        return 2
    text = (sys.stdin.buffer.read() if arguments[0] == "-" else
            pathlib.Path(arguments[0]).read_bytes()).decode("utf-8")
    # Tables keep the digits of the JSON.
    data = json.loads(text, parse_float=Number if document else None)
    if document:
        sys.stdout.buffer.write(document_of(document, data))
        return 0
    try:
        if figures is not None:
            figures.mkdir(parents=True, exist_ok=True)
        html = page_html(data, figures)
    except OSError as error:
        print(error, file=sys.stderr)
        return 2
    sys.stdout.reconfigure(encoding="utf-8")
    sys.stdout.write(html)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
