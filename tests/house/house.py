"""Checks the order and size of the sources: python3 house.py TREE [FLOORS [CEILINGS]]

Prints one line per problem of the sources below TREE and exits with 1 if there are any. Problems
are includes against the order of floors.txt, includes and imports in a circle, missing headers and modules,
names of missing files in comments, paths of files in pages of which one does not include the next, constants of one name in two sources of a library, scripts that
cannot be run, and numbers above those of ceilings.txt, which are printed too.
"""

import ast
import collections
import fnmatch
import os
import pathlib
import posixpath
import re
import sys

from study_reach import reach_of

PARTS = ("src", "analysis", "mc")  # folders of the library, the lowest first
CODE = (".cpp", ".hpp")
SCRIPTS = (".py", ".sh", ".cmake", ".txt")
DATA = (".csv", ".json", ".txt")  # text data of the tests, CMakeLists.txt not counted
INCLUDE = re.compile(r'\s*#\s*include\s*["<]([^">]+)[">]')
QUOTED = re.compile(r'\s*#\s*include\s*"')
# Headers that src must not include: files and messages.
OUTSIDE = re.compile(r"^(hdf5|H5|mpi|mc/|analysis/)")
NAME = re.compile(r"[\w./*-]*[\w*]\.[ch]pp(?!\.?\w)")
FOLDER = re.compile(r"`([\w/]+)/`")
# Sources that have compiler options of their own and are never compiled together with others.
ALONE = re.compile(r"_kernel\.cpp$")
CONSTANT = re.compile(r"(?:inline |static )?constexpr [^(=]*?\b(k[A-Z]\w*)\s*(?:\[|=|\{)")
# A step of a path in a page, and the most that a path may have.
STEP = re.compile(r"\| (\d+) `([\w./]+\.cpp)` \|")
MOST_STEPS = 8
STRING = re.compile(r'"(\\.|[^"\\])*"')

# Folder of a package that scripts of other folders import, and packages from outside.
PACKAGE_ROOT = "analysis/python"
PACKAGES = {"docutils", "h5py", "jinja2", "lxml", "matplotlib", "numpy", "pandas", "pybind11", "scipy", "setuptools",
            "soundfile", "sphinx", "sphinx_copybutton", "xarray"}

# An include, or an import of Python; `header` is its text.
Arrow = collections.namedtuple("Arrow", "file line header target")


def text_of(arrow):
    verb = "imports" if arrow.file.endswith(".py") else "includes"
    return f"{arrow.file}:{arrow.line} {verb} {arrow.header}"


class Tree:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.files = [path.relative_to(self.root).as_posix() for path in self.found()]
        self.known = set(self.files)
        self.arrows = [arrow for file in self.files if file.endswith(CODE)
                       for arrow in self.includes(file)]
        self.resolved_arrows = [
            arrow for arrow in self.arrows
            if arrow.target and arrow.file.startswith(tuple(f"{p}/" for p in PARTS))]
        self.imports = [arrow for file in self.files
                        if file.endswith(".py") and not file.startswith("tests/")
                        for arrow in self.imports_of(file)]

    def found(self):
        """Yields all files except build folders and hidden ones."""
        tops = [self.root / name for name in PARTS + ("tests", "studies", "docs")]
        yield from sorted(path for path in self.root.glob("*") if path.is_file()
                          and not path.name.startswith("."))
        for top in tops:
            yield from sorted(path for path in top.rglob("*") if path.is_file()
                              and "__pycache__" not in path.parts)

    def lines(self, file):
        return (self.root / file).read_text(encoding="utf-8").splitlines()

    def includes(self, file):
        for number, line in enumerate(self.lines(file), 1):
            if match := INCLUDE.match(line):
                header = match.group(1)
                yield Arrow(file, number, header,
                            self.resolved(file, header) if QUOTED.match(line) else None)

    def resolved(self, file, header):
        """Path of the included file: relative to the including one, to src, or to the top."""
        relative = posixpath.normpath(f"{folder(file)}/{header}")
        candidates = (relative, f"src/{header}", header)
        return next((path for path in candidates if path in self.known), None)

    def imports_of(self, file):
        """Imports of a Python file, those within functions and for types included."""
        for node in ast.walk(ast.parse((self.root / file).read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                start = "." * node.level + (node.module or "")
                joint = "." if node.module else ""
                names = [f"{start}{joint}{alias.name}" for alias in node.names]
                # A name may be a module of the package, or an object of the module.
                names = [name if self.imported(file, name) else start for name in names]
            else:
                continue
            for name in dict.fromkeys(names):
                yield Arrow(file, node.lineno, name, self.imported(file, name))

    def imported(self, file, name):
        """Path of an imported module: in the folder for `.name`, otherwise in the folders above,
        too."""
        dots = len(name) - len(name.lstrip("."))
        path = name.lstrip(".").replace(".", "/")
        above = [parent.as_posix() for parent in pathlib.PurePosixPath(file).parents]
        bases = above[dots - 1:dots] if dots else above + [PACKAGE_ROOT]
        candidates = (posixpath.normpath(f"{base}/{path}{end}") for base in bases
                      for end in (".py", "/__init__.py"))
        return next((path for path in candidates if path in self.known), None)


def folder(file):
    return file.rpartition("/")[0]


def module(file):
    """Path without extension: a header and its source are one module."""
    return file.rpartition(".")[0]


class Floors:
    def __init__(self, text):
        self.on = {}        # folders below, by its line
        self.below = {}     # all folders that it may include, with itself
        self.problems = []
        for line in text.splitlines():
            line = line.partition("#")[0].strip()
            if line:
                room, _, on = line.partition(" on ")
                self.add(room.strip(), on.split())

    def add(self, room, on):
        for other in on:
            if other not in self.below:
                self.problems.append(f"floors: {room} is after {other}, which has no line above")
        self.on[room] = [other for other in on if other in self.below]
        self.below[room] = {room}.union(*(self.below[other] for other in self.on[room]))


def upward(tree, floors):
    """Includes against the order, folders without a line, and lines that no include needs."""
    yield from floors.problems
    rooms = {folder(file) for file in tree.files
             if file.endswith(CODE) and file.startswith(tuple(f"{p}/" for p in PARTS))}
    for room in sorted(rooms - set(floors.on)):
        yield f"floors: {room} has no line"
    for room in sorted(set(floors.on) - rooms):
        yield f"floors: {room} holds no sources"
    used = collections.defaultdict(set)
    for arrow in tree.resolved_arrows:
        room, other = folder(arrow.file), folder(arrow.target)
        used[room].add(other)
        if room in floors.below and other in floors.on and other not in floors.below[room]:
            yield f"{text_of(arrow)}: {room} may not include {other}"
    for room in sorted(rooms & set(floors.on)):
        for other in floors.on[room]:
            if other not in used[room]:
                yield f"floors: {room} includes nothing of {other}, which is on its line"


def unresolved(tree):
    """Headers that do not exist, unless a build makes them; headers that src must not include."""
    recipes = "\n".join("\n".join(tree.lines(file)) for file in tree.files
                        if file.endswith(("CMakeLists.txt", ".cmake")))
    for arrow in tree.arrows:
        quoted = QUOTED.match(tree.lines(arrow.file)[arrow.line - 1])
        if quoted and not arrow.target and arrow.header.rpartition("/")[2] not in recipes:
            yield f"{text_of(arrow)}, which does not exist"
        if arrow.file.startswith("src/") and OUTSIDE.match(arrow.header):
            yield f"{text_of(arrow)}: src may not include files, messages or its users"


def unknown_modules(tree):
    """Imports of modules that are neither in the tree nor of Python nor in PACKAGES."""
    for arrow in tree.imports:
        top = arrow.header.partition(".")[0]
        if not arrow.target and top not in sys.stdlib_module_names and top not in PACKAGES:
            yield f"{text_of(arrow)}, which does not exist"


def shortest_circle(start, arrows):
    """Includes of the shortest circle through a node, or none."""
    came, queue = {}, collections.deque([start])
    while queue:
        here = queue.popleft()
        for there, arrow in arrows[here].items():
            if there == start:
                way = [arrow]
                while here != start:
                    here, arrow = came[here]
                    way.append(arrow)
                return way[::-1]
            if there not in came:
                came[there] = (here, arrow)
                queue.append(there)
    return []


def circles(all_arrows, node_of, what):
    """Yields one circle through every node that is in any; nodes of a printed circle are done."""
    arrows = collections.defaultdict(dict)
    for arrow in all_arrows:
        here, there = node_of(arrow.file), node_of(arrow.target or arrow.file)
        if here != there:
            arrows[here].setdefault(there, arrow)
    done = set()
    for start in sorted(arrows):
        if start in done:
            continue
        if way := shortest_circle(start, arrows):
            nodes = [node_of(arrow.file) for arrow in way]
            done.update(nodes)
            yield "\n    ".join([f"circle of {what}: {' -> '.join(nodes + nodes[:1])}"]
                                + [text_of(arrow) for arrow in way])


def comment_of(file, line):
    if file.endswith(".md"):
        return line
    mark = "//" if file.endswith(CODE) else "#"
    return STRING.sub('""', line).partition(mark)[2]


def missing_names(tree):
    """Yields names of missing sources in comments and pages; the end of a path suffices."""
    for file in tree.files:
        if not file.endswith(CODE + SCRIPTS + (".md",)):
            continue
        for number, line in enumerate(tree.lines(file), 1):
            for name in NAME.findall(comment_of(file, line)):
                name = name.lstrip("./")
                if not any(fnmatch.fnmatchcase(f"/{known}", f"*/{name}") for known in tree.files):
                    yield f"{file}:{number} names {name}, which does not exist"


def missing_folders(tree):
    """Yields names of missing folders in the overviews of folders, `name/`."""
    known = {file[:index] for file in tree.files
             for index, sign in enumerate(file) if sign == "/"}
    for file in tree.files:
        if not file.endswith("/README.md"):
            continue
        for number, line in enumerate(tree.lines(file), 1):
            for name in FOLDER.findall(line):
                if name != "build" and not any(f"/{path}".endswith(f"/{name}") for path in known):
                    yield f"{file}:{number} names {name}/, which does not exist"


def broken_paths(tree):
    """Yields steps of a page's table of numbered sources in which no include leads to the next."""
    headers = collections.defaultdict(set)
    for arrow in tree.resolved_arrows:
        headers[module(arrow.file)].add(module(arrow.target))
    for page in (file for file in tree.files if file.endswith(".md")):
        steps = [match.groups() for line in tree.lines(page) if (match := STEP.match(line))]
        for (_, file), (number, following) in zip(steps, steps[1:]):
            if int(number) > 1 and module(following) not in headers[module(file)]:
                yield f"{page}: {file} does not include the next file of its path, {following}"
        if any(int(number) > MOST_STEPS for number, _ in steps):
            yield f"{page}: a path has more than {MOST_STEPS} files"


def namespace(file):
    """Folder whose sources share a namespace: analysis, mc, and each folder of src."""
    parts = file.split("/")
    return "/".join(parts[:2]) if parts[0] == "src" else parts[0]


def clashing_constants(tree):
    """Yields constants of one name in two sources of a library, which a build may compile as one."""
    first = {}
    for file in tree.files:
        if not (file.endswith(".cpp") and file.startswith(tuple(f"{p}/" for p in PARTS))) \
                or ALONE.search(file):
            continue
        for number, line in enumerate(tree.lines(file), 1):
            if match := CONSTANT.match(line):
                constant = namespace(file), match.group(1)
                other = first.setdefault(constant, f"{file}:{number}")
                if not other.startswith(f"{file}:"):
                    yield f"{file}:{number} defines {match.group(1)}, which {other} defines too"


def not_executable(tree):
    """Yields scripts that name their interpreter but are not executable, although pages run them."""
    for file in tree.files:
        path = tree.root / file
        if file.endswith(SCRIPTS) and path.read_bytes()[:2] == b"#!" and not os.access(path, os.X_OK):
            yield f"{file} names its interpreter but is not executable: chmod +x, or drop the line"


def measured(tree):
    """Numbers that ceilings.txt limits, by name."""
    lines = {top: sum(len(tree.lines(file)) for file in tree.files
                      if file.startswith(f"{top}/") and file.endswith(CODE + (".py",)))
             for top in PARTS + ("tests",)}
    data = sum(len(tree.lines(file)) for file in tree.files
               if file.startswith("tests/") and file.endswith(DATA) and not file.endswith("/CMakeLists.txt"))
    reach = reach_of(tree.root)
    return {"lines of src, mc and analysis": sum(lines[top] for top in PARTS),
            "lines of tests": lines["tests"],
            "lines of text data in tests": data,
            "functions and members that reach a study": len(reach.found),
            "functions that answer yes or no about a study": len(reach.questions)}


def compare(numbers, text):
    """A line for each number, and a problem for each above its ceiling."""
    ceilings = {}
    for line in text.splitlines():
        if line := line.partition("#")[0].strip():
            name, _, number = line.rpartition(" ")
            ceilings[name.strip()] = int(number)
    problems = [f"ceilings: {name} has no line" for name in numbers if name not in ceilings]
    problems += [f"ceilings: {name} is not measured" for name in ceilings if name not in numbers]
    lines = []
    for name in (name for name in numbers if name in ceilings):
        left = ceilings[name] - numbers[name]
        lines.append(f"{name}: {numbers[name]}, at most {ceilings[name]}, {max(left, 0)} left")
        if left < 0:
            problems.append(f"ceilings: {name}: {numbers[name]} are {-left} too many")
    return lines, problems


def complaints(tree, floors):
    yield from upward(tree, floors)
    yield from unresolved(tree)
    yield from unknown_modules(tree)
    yield from circles(tree.resolved_arrows, module, "modules")
    yield from circles(tree.resolved_arrows, folder, "folders")
    yield from circles(tree.imports, module, "Python modules")
    yield from missing_names(tree)
    yield from missing_folders(tree)
    yield from broken_paths(tree)
    yield from clashing_constants(tree)
    yield from not_executable(tree)


def main(arguments):
    here = pathlib.Path(__file__).parent
    listed = arguments[1:] + [here / "floors.txt", here / "ceilings.txt"][len(arguments) - 1:]
    floors, ceilings = (pathlib.Path(path).read_text(encoding="utf-8") for path in listed)
    tree = Tree(arguments[0])
    lines, high = compare(measured(tree), ceilings)
    found = list(complaints(tree, Floors(floors))) + high
    print("\n".join((found or ["the sources are in order"]) + lines))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
