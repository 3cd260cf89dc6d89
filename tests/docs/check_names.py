"""Names in the documentation: check_names.py PROGRAM SOURCES

Every study key, and every option in a command line of ./gearpod, that a page or a README names is one
that the program knows (gearpod --reference). The files that docs/developer/extending.md names for an
addition are those that the commit stored in additions.json changed.
"""

import json
import pathlib
import re
import subprocess
import sys

FENCED = re.compile(r"^```\w*\n(.*?)^```$", re.M | re.S)
INLINE = re.compile(r"`([^`\n]+)`")
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")
UNITS = ("mm", "um", "deg", "arcsec", "Hz", "rpm", "kg", "kg_m2", "N_m", "N_s_m", "m_s2", "Pa", "h")
WITH_UNIT = re.compile(r"[a-z]\w*_(?:" + "|".join(UNITS) + ")")
FILES = (".toml", ".csv", ".json", ".py", ".md", ".h5", ".html")
# Columns of signal files, members of the JSON of reports.
OTHER_NAMES = {"speed_rpm", "sensor_m_s2", "mesh_Hz", "highest_Hz", "stated_per_1000_h", "per_1000_h", "end_h"}
HERE = pathlib.Path(__file__).parent
OWN_OPTIONS = {"--help", "--version", "--man", "--completion", "--reference"}


class Known:
    def __init__(self, program):
        text = subprocess.run([program, "--reference"], check=True, capture_output=True, text=True)
        reference = json.loads(text.stdout)
        self.sections = reference["sections"]
        self.keys = {f"{key['section']}.{key['name']}" for key in reference["keys"]}
        self.names = {key["name"].rpartition(".")[2] for key in reference["keys"]}
        self.names |= {field["name"] for key in reference["keys"] for field in key.get("fields", ())}
        self.options = OWN_OPTIONS | {
            name for command in reference["commands"] for option in command["options"]
            for name in option["name"].split(",")}
        self.dotted = re.compile(r"(?<![\w./-])(" + "|".join(self.sections) + r")\.([\w.]+)")

    def wrong_keys(self, text):
        for match in self.dotted.finditer(text):
            name = match.group(0).rstrip(".")
            begins_one = any(key.startswith(name + ".") for key in self.keys)
            if match.group(1) != "random" and not name.endswith(FILES) \
                    and name not in self.keys and not begins_one:
                yield name

    def wrong_names(self, code):
        if WITH_UNIT.fullmatch(code) and code not in self.names | OTHER_NAMES:
            yield code

    def wrong_options(self, line):
        yield from (name for name in OPTION.findall(line) if name not in self.options)


def command_lines(text):
    """Lines of blocks that begin with the program, with their continuations."""
    for match in FENCED.finditer(text):
        for line in match.group(1).replace("\\\n", " ").split("\n"):
            if re.match(r"(\./|build/)gearpod\s", line):
                yield line.partition(" #")[0]


def problems(known, path):
    text = path.read_text(encoding="utf-8")
    for line in command_lines(text):
        yield from known.wrong_keys(line)
        yield from known.wrong_options(line)
    for match in INLINE.finditer(FENCED.sub("", text)):
        yield from known.wrong_keys(match.group(1))
        yield from known.wrong_names(match.group(1))


def files_of_row(row):
    """Files that a row's third column names: `folder/a.hpp` and `.cpp`, `b.cpp` there."""
    files = []
    for code in INLINE.findall(row.split("|")[3]):
        if code.startswith("."):
            code = files[-1].rpartition(".")[0] + code
        elif "/" not in code:
            code = files[-1].rpartition("/")[0] + "/" + code
        files.append(code)
    return sorted(files)


def wrong_additions(sources):
    page = (sources / "docs/developer/extending.md").read_text(encoding="utf-8")
    for addition, files in json.loads((HERE / "additions.json").read_text(encoding="utf-8")).items():
        row = re.search(rf"^\| {addition} \|.*$", page, re.M)
        named = files_of_row(row.group()) if row else []
        if named != sorted(files):
            yield f"extending.md: {addition}: the page names {named}, the commit changed {files}"
        yield from (f"extending.md: there is no {file}" for file in files if not (sources / file).exists())


def main(program, sources):
    known = Known(program)
    pages = sorted((sources / "docs").rglob("*.md")) + [sources / "README.md",
                                                        sources / "studies" / "README.md"]
    found = [f"{page.relative_to(sources)}: the program does not know {name}"
             for page in pages for name in dict.fromkeys(problems(known, page))]
    found += wrong_additions(sources)
    print("\n".join(found) or "the program knows all names")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2])))
