"""Checks that every source file compiles on its own includes: own_includes.py ROOT

Files of a unity build can use what an earlier file of their group includes. The presets for finding faults compile
every file alone. Here the compiler checks each file as they do, without making an object; some ten minutes.
"""

import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

CHECKED = ("mc", "analysis", "src", "tests")


def commands(root, build):
    """Compiler arguments by file, for files of the tree that any target compiles."""
    # The header with the version is made by the build, not when CMake runs.
    for step in (["--preset", "debug", "-S", root, "-B", build],
                 ["--build", build, "--target", "gearpod_version"]):
        done = subprocess.run(["cmake", *step], cwd=root, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stdout + done.stderr)
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        path = pathlib.Path(entry["file"])
        if path.is_relative_to(root) and path.relative_to(root).parts[0] in CHECKED:
            arguments = shlex.split(entry["command"])
            found.setdefault(path, (arguments[:arguments.index("-o")], entry["directory"]))
    return found


def problem_of(path, command):
    arguments, folder = command
    done = subprocess.run([*arguments, "-fsyntax-only", path], cwd=folder, capture_output=True,
                          text=True, check=False)
    return "" if done.returncode == 0 else f"{path}:\n{done.stderr[:2000]}"


def main(root):
    with tempfile.TemporaryDirectory() as folder:
        found = commands(root, pathlib.Path(folder))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            problems = list(filter(None, pool.map(problem_of, found, found.values())))
    print("\n".join(problems) or f"{len(found)} files compile on their own includes")
    return 1 if problems or not found else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
