"""Links of the documentation: check_links.py SOURCES [HTML]

Every relative link of a README or another Markdown file of the sources leads to a file, and every
link of the built pages to a page and an anchor. Links to other sites are not followed. The tests
that hold the promises of the pages exist.
"""

import html.parser
import pathlib
import re
import sys
import urllib.parse

LINK = re.compile(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)|!\[[^\]]*\]\(([^)\s]+)\)")
MARKDOWN = ("*.md", "docs/**/*.md", "studies/**/*.md", "mc/**/*.md", "src/**/*.md", "tests/**/*.md",
            "analysis/**/*.md")
MADE = ("docs/developer/changelog.md",)  # copied by the build


def source_links(sources):
    for pattern in MARKDOWN:
        for path in sorted(sources.glob(pattern)):
            text = re.sub(r"```.*?```|`[^`\n]*`", "", path.read_text(encoding="utf-8"), flags=re.S)
            for match in LINK.finditer(text):
                yield path, match.group(1) or match.group(2)


def broken_sources(sources):
    for path, link in source_links(sources):
        parts = urllib.parse.urlsplit(link)
        if parts.scheme or not parts.path:
            continue
        target = (path.parent / urllib.parse.unquote(parts.path)).resolve()
        made = any(target == (sources / name).resolve() for name in MADE)
        if not target.exists() and not made:
            yield f"{path.relative_to(sources)}: {link} leads nowhere"


def missing_tests(sources):
    """Tests that the table of promises names and the sources lack."""
    page = sources / "docs/developer/testing.md"
    if not (sources / "tests").exists():  # installed
        return
    for path, titles in re.findall(r"`([^`]+\.cpp)`((?:[:,] \"[^\"]+\")*)",
                                   page.read_text(encoding="utf-8").split("## Promises")[1]
                                   .split("## ")[0]):
        text = (sources / "tests" / path).read_text(encoding="utf-8")
        for title in re.findall(r"\"([^\"]+)\"", titles):
            if not re.search(r"TEST_CASE\(\s*\"" + re.escape(title), text):
                yield f"{page.relative_to(sources)}: {path} has no test \"{title}...\""


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(values[name] for name in ("id", "name") if values.get(name))
        link = values.get("href") if tag in ("a", "link") else \
            values.get("src") if tag in ("img", "script") else None
        if link:
            self.links.append(link)


def broken_pages(folder):
    pages = {path.resolve(): Page(path) for path in sorted(folder.rglob("*.html"))}
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() \
                if parts.path else path
            if not target.exists():
                yield f"{path.relative_to(folder.resolve())}: {link} leads nowhere"
            elif parts.fragment and target in pages \
                    and urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                yield f"{path.relative_to(folder.resolve())}: {link} has no such anchor"


def loaded_from_elsewhere(folder):
    """Scripts and styles that a page would load from the network."""
    for path in sorted(folder.rglob("*.html")):
        for match in re.finditer(r"<(?:script|link)[^>]+(?:src|href)=\"(https?:)?//[^\"]+\"",
                                 path.read_text(encoding="utf-8")):
            if "rel=\"canonical\"" not in match.group(0):
                yield f"{path.name} loads {match.group(0)}"


def main(sources, pages=None):
    found = [*broken_sources(sources), *missing_tests(sources)]
    if pages is None:
        print("\n".join(found) or "all links lead somewhere")
        return 1 if found else 0
    if not pages.exists():
        print("\n".join(found) or "the pages are not built")
        return 1 if found else 77
    found += list(broken_pages(pages)) + list(loaded_from_elsewhere(pages))
    print("\n".join(found) or "all links lead somewhere")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*map(pathlib.Path, sys.argv[1:3])))
