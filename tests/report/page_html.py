"""A parsed page for tests: elements, ids, links and words."""

from html.parser import HTMLParser

VOID = {"meta", "link", "br", "hr", "img", "input"}


class PageHtml(HTMLParser):
    """Parses a page; `problems` lists elements with wrong nesting."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.ids, self.links, self.elements, self.problems = [], [], [], []
        self.words, self.charts, self._open, self._hidden = [], [], [], 0
        self.feed(text)
        self.close()
        self.problems += [f"<{tag}> is never closed" for tag in self._open]

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.elements.append((tag, attributes))
        if "id" in attributes:
            self.ids.append(attributes["id"])
        for name in ("href", "xlink:href", "src"):
            if name in attributes:
                self.links.append(attributes[name])
        if tag == "svg":
            self.charts.append({"attributes": attributes, "names": {}})
        if tag not in VOID:
            self._open.append(tag)
        self._name = attributes.get("id") if tag in ("title", "desc") else None

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self._open.pop()

    def handle_endtag(self, tag):
        if not self._open or self._open[-1] != tag:
            self.problems.append(f"</{tag}> closes <{self._open[-1] if self._open else 'nothing'}>")
        else:
            self._open.pop()
        self._name = None

    def handle_data(self, data):
        if "style" in self._open or "script" in self._open:
            return
        if getattr(self, "_name", None) and self.charts:
            self.charts[-1]["names"][self._name] = data
        self.words.append(data)

    def text(self):
        return " ".join(" ".join(self.words).split())

    def count(self, tag):
        return sum(1 for name, _ in self.elements if name == tag)
