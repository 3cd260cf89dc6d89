"""Results file: gearboxes with their inputs and features, detection rates, signals."""

from __future__ import annotations

import json
import os
import pathlib
import signal
import sys
import tempfile
import warnings
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np

try:
    import h5py
except ImportError as error:
    raise ImportError("gearpod reads its results with h5py (Debian: python3-h5py)") from error

from . import library
from .columns import Array, import_pandas, import_xarray
from .program import SOME_FAILED, PathLike, call, settings

FORMAT, NEWEST = "gearpod results", 3
LIFE_COLUMNS = {"crack_depth": "crack_depth", "record_torque": "torque", "record_speed": "speed",
                "record_gain": "gain", "record_noise": "noise"}
GROUPS = {"threshold": 0, "graded": 1, "neither": 2}


def open(path: PathLike) -> "Results":
    """Opens a results file. Raises OSError if there is none, ValueError if gearpod did not write
    it."""
    return Results(path)


def run(study: PathLike, *, set: Optional[Mapping[str, Any]] = None, out: Optional[PathLike] = None,
        instances: Optional[int] = None, seed: Optional[int] = None, resume: bool = False,
        force: bool = False, progress: Optional[bool] = None) -> "Results":
    """Simulates a study and opens its results.

    set       keys of the study to change, {"sensor.noise_m_s2": 2}
    out       results file; by default the study's name with .h5 in the working folder
    resume    continue an interrupted run, or add gearboxes
    force     overwrite the results of another study
    progress  the program's lines on standard error; by default on a terminal

    Raises Failed with the program's message if it refuses the study. Failed gearboxes only cause a
    warning.
    """
    target = pathlib.Path(out) if out is not None else pathlib.Path(
        pathlib.Path(study).with_suffix(".h5").name)
    arguments = ["run", os.fspath(study), "--out", str(target), *settings(set)]
    for name, number in (("--instances", instances), ("--seed", seed)):
        if number is not None:
            arguments += [name, str(number)]
    arguments += ["--resume"] * resume + ["--force"] * force
    shown = sys.stderr.isatty() if progress is None else progress
    done = call(arguments + ([] if shown else ["--quiet"]), shown)
    if done.returncode == SOME_FAILED:
        warnings.warn(f"{target}: some gearboxes failed; results.status shows which", stacklevel=2)
    return open(target)


@dataclass
class Lives:
    """Lives of gearboxes, results of `gearpod lives`. Rows of all arrays are lives."""

    hours: Array          # of the records
    end_h: Array          # time at which the tooth broke; NaN where it survived
    records: Array        # number of records of each life
    crack_depth: Array    # m, lives x records; NaN after the end of a life, as in the others
    torque: Array         # factors of each record, lives x records
    speed: Array
    gain: Array
    noise: Array


class Results:
    """Results of `gearpod run` or `gearpod lives`, read on demand. Each row is a gearbox or a life;
    those that set the thresholds come first, then the test gearboxes."""

    def __init__(self, path: PathLike) -> None:
        self.path = pathlib.Path(path)
        if not _survives_reading(self.path):
            raise ValueError(f"{self.path}: is damaged: the HDF5 library fails on it")
        with h5py.File(self.path, "r") as file:
            try:
                self._read_frame(file)
            except (KeyError, RuntimeError, TypeError) as error:
                raise ValueError(f"{self.path}: is damaged: {error}") from error

    def _read_frame(self, file: Any) -> None:
        self.attributes: Dict[str, str] = {
            name: _text(value) for name, value in file.attrs.items()}
        if self.attributes.get("format") != FORMAT:
            raise ValueError(f"{self.path}: not a results file of gearpod")
        if int(self.attributes["format_version"]) > NEWEST:
            raise ValueError(f"{self.path}: written by a newer gearpod")
        self.kind: str = self.attributes.get("kind", "run")
        # Lives have values per record instead.
        self.noise_levels: Array = (np.empty(0) if self.kind == "lives"
                                    else file["noise_levels"][()])
        self.group: Array = file["instances/group"][()]
        self.status: Array = file["status"][()]
        self.inputs: List[str] = [name for name in file["instances"] if name != "group"]
        self.features: List[str] = list(file["features"])
        # Meshes whose contact loss ratio is known; none where teeth cannot separate.
        self.meshes: List[str] = list(file.get("contact_loss", {}))
        self.integration: List[str] = list(file.get("integration", {}))
        # Other signals of the same gearboxes whose features are stored, by name.
        self.variants: Dict[str, str] = {
            name: _text(group.attrs["description"])
            for name, group in file.get("variants", {}).items()}
        self.units: Dict[str, str] = {
            name: _text(file[folder][name].attrs["unit"])
            for folder, names in (("instances", self.inputs), ("features", self.features))
            for name in names}
        # Alarm side of the threshold for each feature: "high" or "low".
        self.alarms: Dict[str, str] = {
            name: _text(file["features"][name].attrs["alarm"]) for name in self.features}
        if self.kind == "lives":
            self.features = [name for name in self.features if name not in LIFE_COLUMNS]
        self.size_name: str = _text(file["detection"].attrs["size_name"])

    def __repr__(self) -> str:
        return (f"<gearpod results {self.path}: {len(self)} gearboxes, {len(self.inputs)} inputs, "
                f"{len(self.features)} features at {len(self.noise_levels)} noise levels>")

    def __len__(self) -> int:
        return len(self.status)

    @property
    def study(self) -> str:
        """Resolved study (TOML)."""
        return self.attributes["study"]

    def input(self, name: str) -> Array:
        """Values of an input, one per gearbox."""
        return self._read("instances", name, self.inputs)

    @property
    def size(self) -> Array:
        """Fault size of every gearbox; zeros if the study draws none."""
        return self.input(self.size_name) if self.size_name in self.inputs else np.zeros(len(self))

    def feature(self, name: str, noise: Optional[float] = None) -> Array:
        """Values of a feature, gearboxes x noise levels, or one per gearbox at one noise level; of
        lives, lives x records. NaN where there is no value."""
        values = self._read("features", name, self.features)
        return values if noise is None else values[:, self.level(noise)]

    def contact_loss(self, mesh: str) -> Array:
        """Contact loss ratio of a mesh, one value per gearbox: the share of the engagement, within
        the nominal path of contact, in which a tooth pair carries no load; NaN where there is no
        value."""
        return self._read("contact_loss", mesh, self.meshes)

    def superposed(self) -> Array:
        """1 for each gearbox whose motion was superposed, 0 where all mesh periods were integrated;
        NaN where there is no value. Only for studies whose numerics.horizon is "superposed"."""
        return self._read("integration", "superposed", self.integration)

    def variant(self, name: str, feature: str) -> Array:
        """Values of a feature of other signals, gearboxes x noise levels. The variant "sensor_NAME"
        is an additional sensor. "other_fault" has healthy gearboxes with a faulty bearing, and NaN
        for test gearboxes."""
        if name not in self.variants:
            raise KeyError(f"no variant {name}; available: {', '.join(self.variants) or 'none'}")
        return self._read(f"variants/{name}", feature, self.features)

    def level(self, noise: float) -> int:
        """Index of a noise level. Raises KeyError with the available levels."""
        matches = np.flatnonzero(np.isclose(self.noise_levels, noise))
        if matches.size == 0:
            raise KeyError(f"no noise level {noise:g}; available: "
                           + ", ".join(f"{level:g}" for level in self.noise_levels))
        return int(matches[0])

    @property
    def reference(self) -> float:
        """Noise level that reports show first: 1 if available, otherwise the smallest above 0,
        otherwise the first."""
        levels = self.noise_levels
        if not levels.size:
            raise ValueError(f"{self.path}: contains lives, which have one noise level")
        above = levels[levels > 0]
        return 1.0 if 1.0 in levels else float(above[0] if above.size else levels[0])

    def rows(self, group: str = "graded") -> Array:
        """Row numbers of a group: threshold, graded (test gearboxes) or neither."""
        return np.flatnonzero(self.group == GROUPS[group])

    def columns(self, noise: Optional[float] = None) -> Dict[str, Array]:
        """Group, status, inputs and features by name, one value per gearbox."""
        noise = self.reference if noise is None else noise
        return {"group": self.group, "status": self.status,
                **{name: self.input(name) for name in self.inputs},
                **{name: self.feature(name, noise) for name in self.features}}

    def frame(self, noise: Optional[float] = None) -> Any:
        """columns() as a pandas DataFrame, indexed by row; needs pandas."""
        frame = import_pandas().DataFrame(self.columns(noise))
        frame.index.name = "row"
        return frame

    def dataset(self) -> Any:
        """Inputs by gearbox and features by gearbox and noise level (of lives: record) as an xarray
        Dataset with units, group and status; needs xarray."""
        axes = ["gearbox", "record" if self.kind == "lives" else "noise"]
        values = {**{name: self.input(name) for name in self.inputs},
                  **{name: self.feature(name) for name in self.features}}
        dataset = import_xarray().Dataset(
            {name: (axes[:array.ndim], array, {"units": self.units[name]})
             for name, array in values.items()},
            coords={"group": ("gearbox", self.group), "status": ("gearbox", self.status)})
        return dataset if self.kind == "lives" else dataset.assign_coords(noise=self.noise_levels)

    def detection_columns(self) -> Dict[str, Array]:
        """Detection rates, one entry per feature, noise level and size."""
        columns: Dict[str, List[Any]] = {}
        with h5py.File(self.path, "r") as file:
            for feature in self.features:
                part = file["detection"][feature]
                low, high = part["size_low"][()], part["size_high"][()]
                for n, noise in enumerate(part["noise_level"][()]):
                    for s in range(len(low)):
                        row = {"feature": feature, "noise_level": noise, "size_low": low[s],
                               "size_high": high[s], "threshold": part["threshold"][n],
                               **{name: part[name][n, s] for name in
                                  ("tested", "detected", "failed", "pd", "lower", "upper")}}
                        for name, value in row.items():
                            columns.setdefault(name, []).append(value)
        return {name: np.array(values) for name, values in columns.items()}

    def detection(self) -> Any:
        """detection_columns() as a pandas DataFrame; needs pandas."""
        return import_pandas().DataFrame(self.detection_columns())

    def pod(self, values: Any, *, name: str = "values", alarm: str = "high", unit: str = "1",
            noise: Optional[float] = None) -> library.Pod:
        """Evaluates values of your own, one per gearbox in the order of the rows, as the program
        evaluates its features: threshold at the study's false-alarm rate from the threshold group,
        detection rates, POD curve. `alarm` is the side of the threshold that is an alarm, `noise`
        the noise level of the values, for the report only.

        report["detection"]["level"] has the threshold and the rates by size. Raises Failed if the
        number of values is not that of the rows.
        """
        return library.grade(self.path, values, name=name, alarm=alarm, unit=unit,
                             noise_level=self.reference if noise is None else noise)

    @property
    def lives(self) -> Lives:
        """Lives: times, crack depths and ends. Raises ValueError for results of `run`."""
        if self.kind != "lives":
            raise ValueError(f"{self.path}: contains no lives (gearpod lives writes them)")
        with h5py.File(self.path, "r") as file:
            return Lives(hours=file["hours"][()], end_h=file["instances/end_h"][()],
                         records=file["instances/records"][()].astype(int),
                         **{field: file["features"][name][()]
                            for name, field in LIFE_COLUMNS.items()})

    def signals(self, row: int) -> Dict[str, Array]:
        """Signals of the gearbox in a row, by name. Read from the file if stored (`run --signals`),
        otherwise computed again by the program."""
        if not 0 <= row < len(self):
            raise IndexError(f"row {row} of {len(self)}")
        with h5py.File(self.path, "r") as file:
            stored = file.get(f"signals/{row}")
            if stored is not None:
                return {name: stored[name][()] for name in stored}
        with tempfile.TemporaryDirectory() as folder:
            study, out = os.path.join(folder, "study.toml"), os.path.join(folder, "signals.h5")
            pathlib.Path(study).write_text(self.study, encoding="utf-8")
            call(["simulate", study, "--instance", str(row), "--out", out])
            with h5py.File(out, "r") as file:
                return {name: item[()] for name, item in file["signals"].items()}

    def report(self) -> Dict[str, Any]:
        """The complete report (`gearpod report --json`): curves, ranking, misses. Needs the
        program; cached after the first call."""
        if not hasattr(self, "_report"):
            done = call(["report", str(self.path), "--json", "-"])
            self._report: Dict[str, Any] = json.loads(done.stdout)
        return self._report

    def smallest_fault(self, noise: Optional[float] = None) -> Optional[Tuple[float, str]]:
        """Size and feature of the smallest fault found with 90 % probability, None if there is
        none. Needs the program."""
        reliability = self.report()["reliability"]
        if reliability is None:
            return None
        level = self.level(self.reference if noise is None else noise)
        found = reliability["levels"][level]["smallest_fault"]
        return None if found is None else (found["size"], found["feature"])

    def _read(self, folder: str, name: str, names: List[str]) -> Array:
        if name not in names:
            raise KeyError(f"no {name}; available: {', '.join(names)}")
        with h5py.File(self.path, "r") as file:
            values: Array = file[folder][name][()]
        return values


def _survives_reading(path: pathlib.Path) -> bool:
    """Reads all of a file in a child process: HDF5 may crash on a damaged one, or never finish. True
    for a file that cannot be opened, because opening it in this process gives the reason. False for
    one with links, which no results file has and which may lead to other files."""
    def read(name: str, item: Any) -> None:
        dict(item.attrs)
        if isinstance(item, h5py.Dataset):
            item[()]
        elif not all(isinstance(item.get(link, getlink=True), h5py.HardLink) for link in item):
            raise ValueError(name)

    child = os.fork()
    if child == 0:
        code = 0
        try:
            signal.signal(signal.SIGALRM, signal.SIG_DFL)
            signal.alarm(10 + path.stat().st_size // 10_000_000)
            with h5py.File(path, "r") as file:
                code = 1
                read("/", file)
                file.visititems(read)
                code = 0
        finally:
            os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def _text(value: Union[bytes, str, Any]) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)
