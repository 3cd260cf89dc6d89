"""Sphinx extension that typesets formulas with KaTeX from the system's packages, without network.

The files of Debian's libjs-katex and fonts-katex are copied into the pages. Where they are missing,
the pages show the formulas as TeX and the build prints a note.
"""

import pathlib
import shutil

from sphinx.util import logging

SYSTEM = pathlib.Path("/usr/share/javascript/katex")
FILES = ("katex.min.css", "katex.min.js")
RENDER = """document.addEventListener("DOMContentLoaded", function () {
  document.querySelectorAll(".math").forEach(function (element) {
    var display = element.tagName === "DIV";
    katex.render(element.dataset.tex, element, {displayMode: display, throwOnError: false});
  });
});
"""


def visit_inline(translator, node):
    text = translator.encode(node.astext())
    tex = translator.attval(node.astext())
    translator.body.append(f'<span class="math notranslate" data-tex="{tex}">{text}</span>')
    raise_skip()


def visit_block(translator, node):
    text = translator.encode(node.astext())
    tex = translator.attval(node.astext())
    anchor = f' id="{node["ids"][0]}"' if node.get("ids") else ""
    translator.body.append(f'<div class="math notranslate"{anchor} data-tex="{tex}">{text}</div>\n')
    raise_skip()


def raise_skip():
    from docutils.nodes import SkipNode
    raise SkipNode


def copy_files(app):
    target = pathlib.Path(app.outdir) / "_static" / "katex"
    if app.builder.format != "html" or not (SYSTEM / FILES[1]).exists():
        return []
    (target / "fonts").mkdir(parents=True, exist_ok=True)
    for name in FILES:
        shutil.copyfile(SYSTEM / name, target / name)
    for font in (SYSTEM / "fonts").glob("*.woff2"):
        shutil.copyfile(font, target / "fonts" / font.name)
    (target / "render.js").write_text(RENDER, encoding="utf-8")
    return []


def setup(app):
    if (SYSTEM / FILES[1]).exists():
        app.add_css_file("katex/katex.min.css")
        app.add_js_file("katex/katex.min.js")
        app.add_js_file("katex/render.js")
    else:
        logging.getLogger(__name__).info("no KaTeX (libjs-katex): formulas are shown as TeX")
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_block, None))
    app.connect("html-collect-pages", copy_files)
    app.config.html_math_renderer = "katex"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
