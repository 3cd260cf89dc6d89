#!/usr/bin/python3
"""Measures all published times and ratios, and writes them into docs/validation/performance.md.

    tests/bench/performance.py [--only PART ...] [--quick] [--render | --compare] [--build build]

Each part is a command of this folder. Results are stored in docs/validation/performance.json with machine,
date and load, and tabulated between the marks of the page. --only measures some parts and keeps the others
with their machine and date. --render writes the page from the stored results alone. --compare stores
nothing: it prints each ratio next to the stored one and exits with 1 if one changed by more than its
spread. Run it in the top folder, with a build of the preset `bench` (README.md).
"""
import argparse
import dataclasses
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from measuring import markdown, ratio_text

SOURCES = pathlib.Path(__file__).resolve().parents[2]
STORE, PAGE = (SOURCES / "docs" / "validation" / f"performance.{kind}" for kind in ("json", "md"))
PEERS = "build/tests/peers/solvers/peer_solvers"
FEW_STUDIES = ["studies/" + name + ".toml" for name in ("planet-crack-ideal", "gravity", "wind-turbine", "published/yang-test-rig",
                                                        "published/liang-fig-5-8", "published/tian-fig-4-9")]


@dataclasses.dataclass
class Measurement:
    """Command of a part, its arguments with --quick, and the least change of a ratio that counts."""

    command: str
    quick: str = ""
    margin: float = 0.05


PARTS = {
    "commands": Measurement("tests/bench/commands.py", "--rounds 1"),
    "peers": Measurement(PEERS + " --rounds 3", "--try-s 20"),
    "scipy": Measurement("tests/bench/scipy_solver.py", "--rounds 1"),
    "steps": Measurement("tests/bench/steps.py", "--rounds 1"),
    "effects": Measurement("tests/bench/effects.py", "--rounds 3"),
    "instances": Measurement("tests/bench/instances.py --rounds 1", "--most 2048"),
    "scaling": Measurement("tests/bench/scaling.py --instances 1500", "--rounds 1"),
    "sensors": Measurement("tests/bench/sensor_costs.py --instances 32 --rounds 3", "--rounds 1"),
    "shafts": Measurement("tests/bench/sensor_costs.py --shafts --study studies/planet-crack.toml --instances 8 --rounds 3",
                          "--rounds 1"),
    "python": Measurement("tests/bench/python_costs.py --rounds 3", "--rounds 1"),
    "prediction": Measurement("tests/bench/prediction.py", " ".join(FEW_STUDIES), margin=0.3),
    "memory": Measurement("tests/bench/prediction.py --settings", margin=0.3),
    "tasks": Measurement("tests/bench/tasks.py"),
}


def words_of(name: str, quick: bool) -> str:
    """Command as a user types it; an option of --quick replaces the same one."""
    command = PARTS[name].command
    for option, value in re.findall(r"(--[\w-]+) (\S+)", PARTS[name].quick if quick else ""):
        command = re.sub(rf" {option} \S+", "", command) + f" {option} {value}"
    return command + (" " + PARTS[name].quick if quick and not PARTS[name].quick.startswith("--") else "").rstrip()


def this_machine(build: str) -> dict[str, str | int]:
    """Processor, number of cores and compiler."""
    info = dict(line.split(":", 1) for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").split("\n\n")[0]
                .replace("\t", "").splitlines())
    found = next(pathlib.Path(build, "CMakeFiles").glob("*/CMakeCXXCompiler.cmake")).read_text(encoding="utf-8")
    compiler = re.findall(r'^set\(CMAKE_CXX_COMPILER_(?:ID|VERSION) "(.*)"\)$', found, re.MULTILINE)
    return {"processor": f"{info['model name'].strip()}, family {info['cpu family'].strip()}, model {info['model'].strip()}",
            "cores": os.cpu_count(), "compiler": " ".join(compiler)}


def machine_name(store: dict, machine: dict) -> str:
    """Letter of a machine, a new one if it is not known."""
    for name, known in store["machines"].items():
        if known == machine:
            return name
    name = chr(ord("A") + len(store["machines"]))
    store["machines"][name] = machine
    return name


def rounded(value: object) -> object:
    """The same lists and objects with four significant digits."""
    if isinstance(value, float):
        return float(f"{value:.4g}")
    if isinstance(value, list):
        return [rounded(item) for item in value]
    return {key: rounded(item) for key, item in value.items()} if isinstance(value, dict) else value


def measure(name: str, options: argparse.Namespace, store: dict) -> dict:
    """Runs the command of a part and returns its results with machine, date and load."""
    words = words_of(name, options.quick)
    load = os.getloadavg()[0]
    start = time.perf_counter()
    print(f"{name}: {words}", file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "part.json")
        command = words.replace("build/", options.build + "/", 1).split() + ["--json", str(file)]
        if not words.startswith(PEERS):
            command += ["--build", options.build]
        subprocess.run(command, cwd=SOURCES, stdout=subprocess.DEVNULL, check=True)
        part = json.loads(file.read_text(encoding="utf-8"))
    head = {"command": words, "machine": machine_name(store, this_machine(options.build)),
            "date": datetime.date.today().isoformat(), "load": round(load, 1),
            "minutes": round((time.perf_counter() - start) / 60, 1)}
    return head | rounded(part)


def machine_table(store: dict) -> str:
    lines = ["| name | processor | cores | compiler |", "| --- | --- | --- | --- |"]
    lines += [f"| {name} | {m['processor']} | {m['cores']} | {m['compiler']} |" for name, m in store["machines"].items()]
    return "\n".join(lines)


def block(part: dict) -> str:
    """Command, machine, date and load of a part, and its tables."""
    load = part["load"] if isinstance(part["load"], str) else f"load {part['load']:g}"
    head = f"`{part['command']}`\n(machine {part['machine']}, {part['date']}, {load}):"
    return "\n\n".join([head, *map(markdown, part["tables"])])


def rendered(store: dict, page: str) -> str:
    """The page with the stored results between its marks."""
    texts = {name: block(part) for name, part in store["parts"].items()} | {"machines": machine_table(store)}
    for name, text in texts.items():
        marks = f"<!-- measured: {name} -->", "<!-- end -->"
        before, first, rest = page.partition(marks[0])
        _, last, after = rest.partition(marks[1])
        if not first or not last:
            sys.exit(f"{PAGE.name} has no block {marks[0]}")
        page = f"{before}{marks[0]}\n\n{text}\n\n{marks[1]}{after}"
    return page


def json_lines(value: object, indent: int = 0) -> str:
    """JSON with one line for each list or object that fits into a line."""
    flat = json.dumps(value, ensure_ascii=False)
    if len(flat) + indent <= 118 or not isinstance(value, (dict, list)):
        return flat
    head = [json.dumps(key, ensure_ascii=False) + ": " for key in value] if isinstance(value, dict) else [""] * len(value)
    items = value.values() if isinstance(value, dict) else value
    inner = ",\n".join(" " * (indent + 1) + key + json_lines(item, indent + 1) for key, item in zip(head, items))
    return "{}\n{}\n{}{}".format("{["[isinstance(value, list)], inner, " " * indent, "}]"[isinstance(value, list)])


def differs(new: dict, old: dict, margin: float) -> bool:
    """True if two ratios differ by more than their spread; ratios of few rounds have twice the margin."""
    if min(new["rounds"], old["rounds"]) < 3:
        margin *= 2
    (new_low, new_high), (old_low, old_high) = (
        (min(one["low"], (1 - margin) * one["median"]), max(one["high"], (1 + margin) * one["median"])) for one in (new, old))
    return new_low > old_high or old_low > new_high


def compare(name: str, new: dict, stored: dict | None) -> int:
    """Prints the ratios of a part next to the stored ones, and returns how many changed."""
    if stored is None:
        print(f"{name}: nothing is stored")
        return 0
    changed = 0
    print(f"{name}: machine {new['machine']}, load {new['load']}; stored: machine {stored['machine']}, {stored['date']}, "
          f"load {stored['load']}")
    for key in dict.fromkeys([*new["ratios"], *stored["ratios"]]):
        pair = new["ratios"].get(key), stored["ratios"].get(key)
        both = None not in pair
        is_changed = both and differs(*pair, PARTS[name].margin)
        changed += is_changed
        texts = ["none" if one is None else ratio_text(one) for one in pair]
        print(f"  {key}: {texts[0]}; stored: {texts[1]}" + "  CHANGED" * is_changed)
    return changed


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=PARTS, metavar="PART", default=list(PARTS), help=", ".join(PARTS))
    parser.add_argument("--quick", action="store_true", help="few repetitions")
    parser.add_argument("--build", default="build")
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--render", action="store_true", help="write the page from the stored results")
    action.add_argument("--compare", action="store_true", help="compare ratios with the stored ones")
    options = parser.parse_args()
    options.build = os.path.abspath(options.build)
    store = json.loads(STORE.read_text(encoding="utf-8"))
    changed = 0
    for name in () if options.render else options.only:
        part = measure(name, options, store)
        if options.compare:
            changed += compare(name, part, store["parts"].get(name))
            continue
        store["parts"][name] = part
        store["parts"] = {key: store["parts"][key] for key in PARTS if key in store["parts"]}
        STORE.write_text(json_lines(store) + "\n", encoding="utf-8")
    if not options.compare:
        PAGE.write_text(rendered(store, PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    elif changed:
        sys.exit(f"{changed} ratios changed")


if __name__ == "__main__":
    main()
