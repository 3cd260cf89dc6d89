"""Builds the documentation: build_docs.py PROGRAM SOURCES OUTPUT

Copies docs/ to OUTPUT/pages, adds the pages that are made from the program's own description
(gearpod --reference), and runs Sphinx with warnings as errors. The site is OUTPUT/html. Exit code
77: Sphinx or one of its extensions is not installed.
"""

import filecmp
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import reference_pages

NEEDED = {"sphinx": "python3-sphinx", "myst_parser": "python3-myst-parser", "furo": "furo"}
SKIPPED = 77


def missing_packages():
    return [package for module, package in NEEDED.items()
            if importlib.util.find_spec(module) is None]


def put(text, path):
    """Writes a file only if its text changes, so that Sphinx reads changed pages only."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def copy_pages(docs, pages):
    """Copies docs/ and removes pages that no longer exist there."""
    kept = set()
    for source in sorted(docs.rglob("*")):
        path = source.relative_to(docs)
        if source.is_dir() or "__pycache__" in path.parts:
            continue
        kept.add(path)
        target = pages / path
        if not target.exists() or not filecmp.cmp(source, target, shallow=False):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
    return kept


def version_of(sources):
    text = (sources / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(gearpod VERSION (\S+)", text).group(1)


def main(program, sources, output):
    if missing := missing_packages():
        print("the documentation needs: " + " ".join(missing), file=sys.stderr)
        return SKIPPED
    docs, pages = sources / "docs", output / "pages"
    kept = copy_pages(docs, pages)
    reference = json.loads(subprocess.run([program, "--reference"], check=True,
                                          capture_output=True, text=True).stdout)
    for name, text in reference_pages.fragments(reference).items():
        path = pathlib.Path("reference/_generated") / name
        put(text, pages / path)
        kept.add(path)
    for source, name in (("CHANGELOG.md", "developer/changelog.md"),
                         ("studies/own_features.py", "guide/own_features.py")):
        put((sources / source).read_text(encoding="utf-8"), pages / name)
        kept.add(pathlib.Path(name))
    for old in sorted(pages.rglob("*")):
        if old.is_file() and old.relative_to(pages) not in kept \
                and "__pycache__" not in old.parts:
            old.unlink()
    environment = dict(os.environ, GEARPOD_VERSION=version_of(sources), PYTHONDONTWRITEBYTECODE="1")
    command = [sys.executable, "-m", "sphinx", "-b", "html", "-W", "-n", "--keep-going", "-q",
               "-d", str(output / "doctrees"), str(pages), str(output / "html")]
    return subprocess.run(command, env=environment, check=False).returncode


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], *map(pathlib.Path, sys.argv[2:])))
