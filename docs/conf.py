"""Sphinx configuration of the documentation. docs/tools/build_docs.py runs Sphinx with it."""

import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent / "tools"))

project = "gearpod"
author = "gearpod developers"
copyright = "gearpod developers"  # the name is Sphinx's
release = version = os.environ.get("GEARPOD_VERSION", "")

extensions = ["myst_parser", "sphinx.ext.graphviz", "katex"]
try:
    import sphinx_copybutton  # noqa: F401, an optional convenience
    extensions.append("sphinx_copybutton")
except ImportError:
    pass

myst_enable_extensions = ["dollarmath", "deflist", "colon_fence"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
exclude_patterns = ["tools/**", "reference/_generated/**"]
nitpicky = True
graphviz_output_format = "svg"

html_theme = "furo"
html_title = f"gearpod {release}".strip()
html_static_path = ["_static"]
html_css_files = ["gearpod.css"]
html_copy_source = False
html_show_sphinx = False
