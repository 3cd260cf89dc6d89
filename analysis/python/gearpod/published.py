"""Compares published figures with this program's results, with one command:

    python3 -m gearpod.published [NAME ...] [--out FOLDER] [--list]

Runs the study of each figure (all, or those named) and draws FOLDER/NAME.svg and .png. Lists the
published values next to the computed ones on the terminal and in FOLDER/published.csv. The
published values and their sources are in studies/published/figures.json; docs/validation/published.md explains
why some differ. matplotlib is needed.
"""

from __future__ import annotations

import argparse
import csv
import io
import json
import os
import pathlib
import sys
import tempfile
import textwrap
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import h5py
import numpy as np

from .columns import Array
from .program import Failed, call, find_program
from .results import run

INK, PUBLISHED = "0.15", "#c24e00"
COLOURS = ["#0072b2", "#00795b", "#a23f7d", "#806000", "#4b4fb8", "#5b6066"]
DASHES = ["-", "--", ":", "-.", (0, (6, 1, 1, 1, 1, 1)), (0, (1, 3))]


class Row(NamedTuple):
    """Published and computed value; `published` is None where the source prints no number."""

    figure: str
    what: str
    published: Optional[float]
    ours: float


Figure = Dict[str, Any]


def studies_folder() -> pathlib.Path:
    """Folder of the published studies in the program's checkout or installation."""
    program = pathlib.Path(find_program()).resolve()
    for folder in (*program.parents, *pathlib.Path(__file__).resolve().parents):
        for name in ("studies/published", "share/gearpod/studies/published"):
            if (folder / name / "figures.json").is_file():
                return folder / name
    raise FileNotFoundError("studies/published/figures.json not found near the program; set "
                            "GEARPOD_PROGRAM to the program of a checkout or an installation")


def figures() -> List[Figure]:
    """All figures in studies/published/figures.json."""
    text = (studies_folder() / "figures.json").read_text(encoding="utf-8")
    read: List[Figure] = json.loads(text)
    return read


def _panels(count: int) -> Tuple[Any, List[Any]]:
    import matplotlib.pyplot as plt

    columns = 1 if count == 1 else 2
    rows = -(-count // columns)
    drawing, axes = plt.subplots(rows, columns, figsize=(5.2 * columns, 3.6 * rows), squeeze=False,
                                 layout="constrained")
    return drawing, list(axes.flat)


def _line(axes: Any, number: int, x: Array, y: Array, label: str, marks: bool = False) -> None:
    axes.plot(x, y, color=COLOURS[number % 6], linestyle=DASHES[number % 6],
              linewidth=1.4, marker="o" if marks else None, markersize=4, label=label)


def _trend(panel: Dict[str, Any], axes: Any) -> None:
    """Sets the trend that the source states in words as the title of a panel."""
    words = []
    if "rises" in panel:
        words.append("rises" if panel["rises"] else "falls")
    if "faulty" in panel:
        words.append(f"{panel['faulty']} when faulty")
    if words:
        axes.set_title(f"published: {', '.join(words)}", fontsize=9, color=PUBLISHED, loc="left")


def _features(figure: Figure, folder: pathlib.Path, work: str) -> Tuple[Any, List[Row]]:
    """Features over an input, one line per value of another input."""
    results = run(folder / figure["study"], out=os.path.join(work, "run.h5"), progress=False)
    rows = results.rows("graded")
    x = figure["scale"] * results.input(figure["along"])[rows]
    groups = results.input(figure["lines"])[rows] if "lines" in figure else np.zeros(len(rows))
    drawing, many = _panels(len(figure["panels"]))
    table: List[Row] = []
    for panel, axes in zip(figure["panels"], many):
        values = results.feature(panel["feature"], results.reference)[rows]
        for n, group in enumerate(np.unique(groups)):
            members = np.flatnonzero(groups == group)
            order = members[np.argsort(x[members], kind="stable")]
            label = figure["line"].format(1 - group) if "lines" in figure else "gearpod"
            _line(axes, n, x[order], values[order], label, True)
            published: Dict[float, float] = dict(panel.get("published", []))
            group_text = f", {label}," if "lines" in figure else ""
            for abscissa, value in zip(x[order], values[order]):
                known = next((v for k, v in published.items() if abs(k - abscissa) < 1e-6), None)
                if known is not None or not published:
                    table.append(Row(
                        figure["name"], f"{panel['feature']}{group_text} at {abscissa:g} "
                        f"({figure['axis']})", known, float(value)))
        if panel.get("published"):
            axes.plot(*zip(*panel["published"]), "s", color=PUBLISHED, markersize=6,
                      fillstyle="none", label="published")
        _trend(panel, axes)
        axes.set(xlabel=figure["axis"], ylabel=panel["axis"])
        axes.legend(fontsize=8)
    return drawing, table


def _stiffness(figure: Figure, folder: pathlib.Path, work: str) -> Tuple[Any, List[Row]]:
    """Stiffness of the faulty pair over the mesh periods in which its faulty tooth is engaged, one
    line per fault level."""
    text = call(["stiffness", str(folder / figure["study"]), "--csv", "-"]).stdout
    head = text.split("\n", 1)[0].split(",")
    values = np.loadtxt(io.StringIO(text), delimiter=",", skiprows=1)
    levels: Dict[str, List[int]] = {}
    for column, name in enumerate(head):
        level, found, _ = name.rpartition("_period")
        if found:
            levels.setdefault(level, []).append(column)
    pair = next(iter(levels)).partition("_")[0]
    columns = next(iter(levels.values()))
    phase = np.arange(len(columns) * len(values)) / len(values)
    healthy = np.tile(values[:, head.index(pair)], len(columns))
    drawing, (axes,) = _panels(1)
    _line(axes, 0, phase, healthy, f"{pair}, healthy")
    table: List[Row] = []
    for n, (level, columns) in enumerate(levels.items(), 1):
        curve = np.concatenate([values[:, column] for column in columns])
        label = level.split("_", 2)[-1].replace("_", " ")
        _line(axes, n, phase, curve, label)
        table.append(Row(figure["name"], f"largest loss at {label}, %", None,
                         100 * float(np.max(1 - curve / healthy))))
        if figure.get("missing") and n == len(levels):
            table.append(Row(figure["name"], f"least stiffness at {label}, N/m", 0.0,
                             float(np.min(curve))))
    axes.set(xlabel="mesh periods", ylabel="mesh stiffness, N/m")
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=8)
    return drawing, table


def _signals(figure: Figure, folder: pathlib.Path, work: str, row: int) -> Dict[str, Array]:
    out = os.path.join(work, "signals.h5")
    call(["simulate", str(folder / figure["study"]), "--instance", str(row), "--meshes",
          str(figure["meshes"]), "--out", out])
    with h5py.File(out, "r") as file:
        return {name: item[()] for name, item in file["signals"].items()}


def _spikes(away: Array, count: int) -> Array:
    """Indices of the largest value in each of `count` equal parts of the record, in order."""
    parts = np.array_split(np.arange(len(away)), count)
    return np.array([part[np.argmax(away[part])] for part in parts])


def _motion(figure: Figure, folder: pathlib.Path, work: str) -> Tuple[Any, List[Row]]:
    """Deviation of signals from those of the healthy gearbox over mesh periods."""
    drawing, (axes,) = _panels(1)
    healthy: Optional[Dict[str, Array]] = None
    table: List[Row] = []
    phase = away = np.zeros(0)
    for n, (row, label) in enumerate(figure["rows"]):
        signals = _signals(figure, folder, work, row)
        phase = np.asarray(signals["mesh_phase"])
        if healthy is None:
            healthy = signals
            continue
        off = [signals[name] - healthy[name] for name in figure["signals"]]
        away = figure["scale"] * np.sqrt(np.sum(np.square(off), axis=0))
        axes.plot(phase, away, color=COLOURS[n - 1], linewidth=0.8, label=label)
        table.append(Row(figure["name"], f"largest at {label} ({figure['axis']})", None,
                         float(np.max(away))))
    (what, distance), = figure["published"].items()
    spikes = _spikes(away, figure["peaks"])
    for k in range(figure["peaks"]):
        axes.axvline(phase[spikes[0]] + k * distance, color=PUBLISHED, linewidth=1, linestyle="--",
                     label="published distance" if k == 0 else None)
    table.append(Row(figure["name"], what, distance, float(np.mean(np.diff(phase[spikes])))))
    axes.set(xlabel="mesh periods", ylabel=figure["axis"])
    axes.legend(fontsize=8)
    return drawing, table


def _orders(figure: Figure, folder: pathlib.Path, work: str) -> Tuple[Any, List[Row]]:
    """One-sided amplitude spectrum over the record, with the published largest line marked."""
    values = _signals(figure, folder, work, figure["row"])[figure["signal"]]
    lines = 2 * figure["scale"] * np.abs(np.fft.rfft(values))[:figure["shown"] + 1] / len(values)
    lines[0] = 0.0
    (what, largest), = figure["published"].items()
    drawing, (axes,) = _panels(1)
    axes.vlines(np.arange(len(lines)), 0, lines, color=COLOURS[0], linewidth=1.4, label="gearpod")
    axes.axvline(largest, color=PUBLISHED, linewidth=1, linestyle="--", label="published largest")
    axes.set(xlabel=figure["axis"], ylabel=figure["value"])
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=8)
    return drawing, [Row(figure["name"], what, largest, float(np.argmax(lines)))]


KINDS = {"features": _features, "stiffness": _stiffness, "motion": _motion, "orders": _orders}


def draw(figure: Figure) -> Tuple[Any, List[Row]]:
    """matplotlib figure of an entry of figures(), and its rows."""
    import matplotlib.pyplot as plt

    with tempfile.TemporaryDirectory() as work, plt.rc_context(
            {"axes.grid": True, "grid.color": "0.88", "axes.axisbelow": True}):
        drawing, table = KINDS[figure["kind"]](figure, studies_folder(), work)
    letters = int(13 * drawing.get_figwidth())  # letters per line of the title
    drawing.suptitle(textwrap.fill(f"{figure['source']}: {figure['title']}", letters), fontsize=10,
                     color=INK)
    if "says" in figure:
        drawing.supxlabel(textwrap.fill(f"Published: {figure['says']}", int(1.25 * letters)),
                          fontsize=8, color=PUBLISHED)
    return drawing, table


def _text(row: Row) -> str:
    published_text = "-" if row.published is None else f"{row.published:g}"
    return f"{row.figure:<16}{published_text:>10}{row.ours:>12.4g}  {row.what}"


def main(arguments: Optional[Sequence[str]] = None) -> int:
    known = {figure["name"]: figure for figure in figures()}
    parser = argparse.ArgumentParser(prog="python3 -m gearpod.published", description=(
        "Compares published figures with this program's results."))
    parser.add_argument("names", nargs="*", metavar="NAME", help="names of figures (default: all)")
    parser.add_argument("--out", default="published",
                        help="folder for the figures (default: published)")
    parser.add_argument("--list", action="store_true", help="list the figures")
    options = parser.parse_args(arguments)
    unknown = [name for name in options.names if name not in known]
    if unknown:
        print(f"unknown figure {', '.join(unknown)}; available: {', '.join(known)}",
              file=sys.stderr)
        return 2
    if options.list:
        for figure in known.values():
            print(f"{figure['name']:<16}{figure['source']}: {figure['title']}")
        return 0
    try:
        import matplotlib
    except ImportError:
        print("pictures need matplotlib (Debian: python3-matplotlib)", file=sys.stderr)
        return 2
    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    out = pathlib.Path(options.out)
    table: List[Row] = []
    print(f"{'figure':<16}{'published':>10}{'computed':>12}  what")
    try:
        out.mkdir(parents=True, exist_ok=True)
        for name in options.names or known:
            drawing, rows = draw(known[name])
            for kind in ("svg", "png"):
                drawing.savefig(out / f"{name}.{kind}", dpi=150)
            plt.close(drawing)
            print("\n".join(map(_text, rows)), flush=True)
            table += rows
        with open(out / "published.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["figure", "source", "what", "published", "ours"])
            for row in table:
                writer.writerow([row.figure, known[row.figure]["source"], row.what,
                                 "" if row.published is None else row.published, row.ours])
    except (OSError, Failed) as error:
        print(error, file=sys.stderr)
        return 2
    print(f"pictures: {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
