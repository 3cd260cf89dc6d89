"""Runs the command blocks of the guide: run_guide.py PROGRAM SOURCES [PAGE ...]

Blocks marked `sh` and `python` of each page run in their order, in a folder that looks like the
top of the tree. `./gearpod` there is a script that starts PROGRAM with few gearboxes. Blocks marked
`text` or `toml` do not run. Python blocks are left out without python3-h5py or the compiled module,
pages with --html or --pdf without python3-matplotlib.
"""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
KNOWN = {"sh", "python", "text", "toml"}
LINKED = ("studies", "analysis", "tests", "docs", "cmake")
# Options that make a command quick where the block does not give them.
SMALL = {
    "run": ["--instances", "7", "--set", "ensemble.threshold_instances=19"],
    # Studies that integrate every mesh period.
    "run real teeth": ["--instances", "7", "--set", "ensemble.threshold_instances=8"],
    "sweep": ["--instances", "7", "--set", "ensemble.threshold_instances=19"],
    "lives": ["--instances", "2", "--set", "ensemble.threshold_instances=2",
              "--set", "life.healthy_lives=2", "--set", "life.records=40",
              "--set", "life.depth_steps=2", "--set", "life.distinct_torques=2"],
    "describe": ["--seconds", "1"],
}
# Studies of slow gearboxes, which turn faster here: a mesh period then has fewer samples and steps.
SLOW = ("studies/planet-crack.toml", "studies/bearing-fault.toml", "studies/sensor-places.toml", "studies/two-stages.toml",
        "studies/planet-life.toml")
REAL_TEETH = (*SLOW, "studies/real-teeth.toml", "studies/indicator-league.toml", "studies/worn-sun.toml", "stage.toml", "turbine.toml")
FASTER = ["--set", "operation.carrier_speed_rpm=60"]
# Arguments of the wind turbine and what replaces them: few gearboxes, and steps without a pilot run.
REPLACED = {"ensemble.threshold_instances=400": ["ensemble.threshold_instances=8"],
            "numerics.scatter_tolerance=0.2": ["numerics.integrator=central-difference", "--set", "numerics.mass_scaling_Hz=214"]}
LAUNCHER = """#!/usr/bin/python3 -Bs
import os, sys
small = {small!r}
command, *rest = sys.argv[1:] or [""]
if rest and rest[0] == "turbine.toml":
    rest = [new for old in rest for new in {replaced!r}.get(old, [old])]
if command == "sweep" and "--lives" in rest:
    added = small["lives"]
elif command == "run" and rest and rest[0] in {real!r}:
    added = small["run real teeth"]
elif "--keys" in rest:
    added = []
else:
    added = small.get(command, [])
if command in ("run", "sweep", "lives") and rest and rest[0] in {slow!r}:
    added = added + {faster!r}
given = " ".join(rest)
for option, value in zip(added[::2], added[1::2]):
    if option not in rest if option != "--set" else value.split("=")[0] not in given:
        rest += [option, value]
os.execv({program!r}, [{program!r}, *([command] if command else []), *rest])
"""


def has(*modules):
    return all(importlib.util.find_spec(module) for module in modules)


def blocks(page):
    """Language and text of each block, with the line on which it begins."""
    text = page.read_text(encoding="utf-8")
    for match in BLOCK.finditer(text):
        yield match.group(1), match.group(2), text.count("\n", 0, match.start()) + 1


def processor_seconds():
    used = os.times()
    return used.children_user + used.children_system


def make_tree(folder, program, sources):
    for name in LINKED:
        (folder / name).symlink_to(sources / name)
    launcher = folder / "gearpod"
    launcher.write_text(LAUNCHER.format(small=SMALL, real=REAL_TEETH, slow=SLOW, faster=FASTER, replaced=REPLACED, program=str(program)), encoding="utf-8")
    launcher.chmod(0o755)


def command_of(language, text):
    if language == "sh":
        return ["/bin/sh", "-eu", "-c", text]
    return ["/usr/bin/python3", "-Bs", "-c", text]


def is_left_out(language, text, program):
    if language not in ("sh", "python"):
        return True
    if language == "python":
        return not has("h5py", "numpy") or not list(program.parent.glob("python/_library.*"))
    return not has("matplotlib") and re.search(r"--(html|pdf|figures)\b", text) is not None


def problems_of(page, program, sources):
    environment = dict(os.environ, PYTHONPATH=str(sources / "analysis" / "python"),
                       GEARPOD_PROGRAM=str(program), PYTHONDONTWRITEBYTECODE="1",
                       GEARPOD_REPORT_DIR=str(sources / "analysis" / "report"))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_tree(folder, program, sources)
        for language, text, line in blocks(page):
            where = f"{page.relative_to(sources)}:{line}"
            if language not in KNOWN:
                yield f"{where}: block of kind '{language}'; mark it sh, python, text or toml"
            if is_left_out(language, text, program):
                continue
            begin = processor_seconds()
            ended = subprocess.run(command_of(language, text), cwd=folder, env=environment,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, check=False)
            print(f"{where}: {processor_seconds() - begin:.1f} processor s", flush=True)
            if ended.returncode != 0:
                yield f"{where}: exit code {ended.returncode}\n{text}{ended.stdout[-3000:]}"


def main(program, sources, names):
    guide = sources / "docs" / "guide"
    pages = [guide / f"{name}.md" for name in names] or sorted(guide.glob("*.md"))
    found = [problem for page in pages for problem in problems_of(page, program, sources)]
    print("\n".join(found) or "all commands of the guide run")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(),
                  sys.argv[3:]))
