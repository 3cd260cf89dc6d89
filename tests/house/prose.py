"""Checks the language of comments, messages and pages: python3 prose.py TREE [GLOSSARY]

Prints every offence as file:line and exits with 1 if a limit is exceeded. Limits: openings of
comments and paragraphs with a fragment word, messages of C++ and comments of studies with a word of
glossary.txt, lines of the README and of pages, words of sentences.
"""

import ast
import bisect
import math
import pathlib
import re
import sys

TOPS = ("src", "mc", "analysis", "tests", "docs")
NAMES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
CODE, SCRIPTS = (".cpp", ".hpp", ".h", ".c"), (".sh", ".cmake", "CMakeLists.txt")
SKIPPED = {"__pycache__", "_build", "_static", "build"}

FRAGMENTS = ("of", "what", "that", "whose", "as", "those", "whether", "which", "who", "than",
             "beside", "behind", "told")
MOST_FRAGMENTS = 0.005     # share of all openings
MOST_README_LINES, MOST_PAGE_LINES = 120, 400
MOST_WORDS, PERCENTILE = 35, 0.95

# Comments and literals of C++, in the order in which they hide each other.
CPP = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<mark>[^(\s]{0,16})\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"'
                 r'|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'|^[ \t]*#[ \t]*include[^\n]*', re.S | re.M)
# Standard terms that contain a listed word.
STANDARD = re.compile(r"periodic orbits?|exponentially tilted")
TOML_COMMENT = re.compile(r"""^(?:[^"'#\n]|"(?:\\.|[^"\\\n])*"|'[^'\n]*')*#(.*)""", re.M)
KEY = re.compile(r"\w*[_.]\w[\w.]*")    # identifier within a text
DIRECTIVE = re.compile(r"(NOLINT|clang-format|noqa|type:|shellcheck|pylint|!)")
SENTENCE_END = re.compile(r'(?<!\be\.g)(?<!\bi\.e)(?<!\bal)(?<!\bvs)(?<!\bFig)(?<!\bFigs)(?<!\bEq)'
                          r'(?<!\bEqs)(?<!\bNo)(?<!\bSec)[.!?]["\')*]*\s+(?=["\'(*`\[]*[A-Z0-9`])')


class Glossary:
    """Words that no text may contain, with the standard terms."""

    def __init__(self, text):
        self.words = []
        for line in text.splitlines():
            if line := line.partition("#")[0].rstrip():
                pattern, term = re.split(r"\s\s+", line, maxsplit=1)
                expression = re.compile(rf"\b{pattern.replace('*', '[a-z]*')}\b")
                self.words.append((expression, pattern, term))

    def offence(self, text):
        """The listed word and the standard term, or nothing."""
        plain_text = STANDARD.sub("", KEY.sub(" ", text).lower())
        return next(((pattern, term) for expression, pattern, term in self.words
                     if expression.search(plain_text)), None)


def sources(root):
    """Files of the folders and the top's pages, sorted, relative to the root."""
    found = [root / name for name in NAMES if (root / name).is_file()]
    for top in TOPS + ("studies",):
        found += [path for path in (root / top).rglob("*") if path.is_file()
                  and not SKIPPED.intersection(path.relative_to(root).parts)
                  and not any(part.startswith(".") for part in path.relative_to(root).parts)]
    found = [path.relative_to(root).as_posix() for path in sorted(set(found))]
    return [file for file in found if not file.startswith("studies/") or is_page(file)
            or file.endswith(".toml")]


def is_page(file):
    return file.endswith(".md") and (file.startswith("docs/") or file.endswith(NAMES))


class Lines:
    """Line numbers of positions in a text."""

    def __init__(self, text):
        self.ends = [match.start() for match in re.finditer("\n", text)]

    def number(self, position):
        return bisect.bisect_left(self.ends, position) + 1


def cpp_openings(text):
    """First lines of blocks of whole comment lines."""
    previous = False
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r"\s*(?://+|/\*+)\s?(.*)", line)
        if match and not previous and not DIRECTIVE.match(match.group(1)):
            yield number, match.group(1)
        previous = bool(match)


def script_openings(text):
    previous = False
    for number, line in enumerate(text.splitlines(), 1):
        match = re.match(r"\s*#+\s*(.*)", line)
        if match and not previous and not DIRECTIVE.match(match.group(1)):
            yield number, match.group(1)
        previous = bool(match) and not match.group(1).startswith("!")


def docstrings(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)):
            if first := ast.get_docstring(node):
                yield node.body[0].lineno, first.splitlines()[0]


def paragraphs(text):
    """Paragraphs, list items, headings and table cells of a page, without code and formulas."""
    number, start, words, code = 0, 0, [], None
    for number, line in enumerate(text.splitlines(), 1):
        fence = re.match(r"\s*(```+|~~~+|\$\$)", line)
        if code or fence:
            ends = fence and (code is None or fence.group(1).startswith(code))
            single = fence and code is None and line.count("$$") > 1
            code = code if not ends else (None if code or single else fence.group(1))
            line = ""
        blank = not line.strip() or (re.match(r"    |\t", line) and not words)
        opens = re.match(r"\s*(#+ |[-*+] |\d+[.)] |>|\||\(.*\)=|:::)", line)
        if words and (blank or opens):
            yield start, " ".join(words)
            words = []
        if blank:
            continue
        if line.lstrip().startswith("|"):
            yield from ((number, cell.strip()) for cell in line.strip().strip("|").split("|")
                        if re.search(r"[A-Za-z]", cell))
            continue
        if opens and opens.group(1).startswith((":", "(")):
            continue
        if not words:
            start = number
        words.append(re.sub(r"^\s*(#+|[-*+]|\d+[.)]|>)\s+", "", line).strip())
    if words:
        yield start, " ".join(words)


def plain(text):
    """Text of a paragraph without marks: code and formulas count as one word."""
    text = re.sub(r"`+[^`]*`+|\$[^$]+\$", "code", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return text.replace("**", "").replace("*", "")


def sentences(text):
    for line, paragraph in paragraphs(text):
        for sentence in SENTENCE_END.split(plain(paragraph)):
            count = sum(bool(re.search(r"\w", word)) for word in sentence.split())
            if count:
                yield line, count, sentence


def openings(file, text):
    if file.endswith(CODE):
        yield from cpp_openings(text)
    elif file.endswith(".py"):
        yield from docstrings(text)
        yield from script_openings(text)
    elif file.endswith(SCRIPTS):
        yield from script_openings(text)
    elif is_page(file):
        yield from ((line, plain(paragraph)) for line, paragraph in paragraphs(text))


def is_fragment(text):
    match = re.match(r"[\"'(`]*([A-Za-z]+)", text)
    return bool(match) and match.group(1).lower() in FRAGMENTS and not text.rstrip().endswith("?")


def user_texts(file, text):
    """Messages (string literals with a space) of C++ outside tests, and comments of studies."""
    lines = Lines(text)
    if file.endswith(".toml"):
        for match in TOML_COMMENT.finditer(text):
            yield lines.number(match.start(1)), match.group(1)
    elif file.endswith(CODE) and not file.startswith("tests/"):
        for match in CPP.finditer(text):
            if re.match(r'R?"', match.group()) and " " in match.group():
                yield lines.number(match.start()), match.group()


class Report:
    """Offences by check, and a line of counts for each check."""

    def __init__(self):
        self.failed, self.counts = [], []

    def add(self, count, offences, exceeded):
        self.counts.append(count)
        self.failed += sorted(offences) if exceeded else []

    def text(self):
        lines = [f"{file}:{line}: {problem}" for file, line, problem in self.failed]
        return "\n".join(lines + self.counts)


def check_openings(texts, report):
    total, offences = 0, []
    for file, text in texts.items():
        for line, opening in openings(file, text):
            total += 1
            if is_fragment(opening):
                offences.append((file, line, f"opens with a fragment: {opening[:80]}"))
    report.add(f"openings: {len(offences)} of {total} with a fragment, at most "
               f"{100 * MOST_FRAGMENTS:.1f} %", offences, len(offences) > MOST_FRAGMENTS * total)


def check_texts(texts, glossary, report):
    offences, total = [], 0
    for file, text in texts.items():
        for line, words in user_texts(file, text):
            total += 1
            if bad := glossary.offence(words):
                offences.append((file, line, f"{' '.join(words.split())[:80]} has '{bad[0]}', "
                                 f"use: {bad[1]}"))
    report.add(f"texts: {len(offences)} of {total} with a word of the glossary, at most 0",
               offences, bool(offences))


def check_pages(texts, report):
    lengths = {file: len(text.splitlines()) for file, text in texts.items() if is_page(file)}
    limit = {"README.md": MOST_README_LINES}
    long = [(file, limit.get(file, MOST_PAGE_LINES), f"{lines} lines, at most "
             f"{limit.get(file, MOST_PAGE_LINES)}") for file, lines in lengths.items()
            if lines > limit.get(file, MOST_PAGE_LINES)]
    report.add(f"pages: {len(long)} of {len(lengths)} too long", long, bool(long))
    found = [(count, file, line, sentence) for file in lengths
             for line, count, sentence in sentences(texts[file])]
    counts = sorted(count for count, *_ in found)
    most = counts[math.ceil(PERCENTILE * len(counts)) - 1] if counts else 0
    report.add(f"sentences: {most} words at {100 * PERCENTILE:.0f} % of {len(counts)}, at most "
               f"{MOST_WORDS}", [(file, line, f"sentence of {count} words: {sentence[:80]}")
                                 for count, file, line, sentence in found if count > MOST_WORDS],
               most > MOST_WORDS)


def main(arguments):
    root = pathlib.Path(arguments[0])
    listed = arguments[1:] or [pathlib.Path(__file__).with_name("glossary.txt")]
    glossary = Glossary(pathlib.Path(listed[0]).read_text(encoding="utf-8"))
    files = sources(root)
    texts = {file: (root / file).read_text(encoding="utf-8") for file in files
             if file.endswith(CODE + SCRIPTS + (".py", ".md", ".toml"))}
    report = Report()
    check_openings(texts, report)
    check_texts(texts, glossary, report)
    check_pages(texts, report)
    print(report.text())
    return 1 if report.failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
