"""The program's computations in process: numpy arrays in and out, no files, no subprocess.

Each function takes a study: the path of a study file, its TOML text, a dict of sections, or a
Study, which is read once and keeps what was computed for all gearboxes. Input that the program
would refuse raises Failed with the program's text, one line per problem.
"""

from __future__ import annotations

import importlib.machinery
import importlib.util
import json
import os
import pathlib
import sys
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from .columns import Array, Columns
from .program import PathLike, find_program, toml_value

StudyLike = Union["Study", PathLike, Mapping[str, Any]]
# A recording: a file, an array of accelerations in m/s^2, or columns by name.
SignalLike = Union[PathLike, Array, Sequence[float], Mapping[str, Any]]
TableLike = Union[PathLike, Mapping[str, Any]]


def compiled() -> Any:
    """The compiled module: in the installed package, or in the build folder of the sources. Raises
    ImportError with the command that builds it."""
    name = f"{__package__}._library"
    if name in sys.modules:
        return sys.modules[name]
    if importlib.util.find_spec(name) is not None:
        return importlib.import_module(name)
    try:
        folder = pathlib.Path(find_program()).resolve().parent / "python"
    except FileNotFoundError:
        folder = pathlib.Path()
    for suffix in importlib.machinery.EXTENSION_SUFFIXES:
        path = folder / f"_library{suffix}"
        if path.is_file():
            spec = importlib.util.spec_from_file_location(name, path)
            assert spec is not None and spec.loader is not None
            module = importlib.util.module_from_spec(spec)
            sys.modules[name] = module
            spec.loader.exec_module(module)
            return module
    raise ImportError("the compiled module of gearpod is missing: `cmake --build build --target "
                      "gearpod_python` builds it, `pip install .` in analysis/python installs it")


@dataclass
class Simulation:
    """Simulated gearboxes: one, or several in the first axis of every array."""

    signals: Columns                   # by sample: time, mesh_phase, sensor, te, ...
    features: Dict[str, Array]         # one value per noise level
    noise_levels: Array
    contact_loss: Dict[str, Array]     # by mesh; empty where teeth cannot separate


class Features(Dict[str, float]):
    """Features of a recording by name. `unavailable` has the reason why others have no value,
    `report` everything that `gearpod features --json` has."""

    def __init__(self, report: Dict[str, Any]) -> None:
        super().__init__(report["features"])
        self.unavailable: Dict[str, str] = report["unavailable"]
        self.report = report

    @property
    def alarm(self) -> Optional[bool]:
        """Decision by the threshold of the results given as `against`; None without, or if they do not
        describe the machine."""
        alarm: Optional[bool] = (self.report.get("against") or {}).get("alarm")
        return alarm


class Pod:
    """Probability of detection over size: `report` is the program's JSON, `text` its report.

    `curve` has size, pod, lower and upper; a50 and a90 are (estimate, lower, upper), NaN where the
    data do not determine them. Raises ValueError with the reason where there is no curve.
    """

    def __init__(self, report: Dict[str, Any], text: str, fit: Optional[Mapping[str, Any]],
                 unit: str) -> None:
        self.report = report
        self.text = text
        self._fit = fit
        self._unit = unit

    @property
    def fit(self) -> Mapping[str, Any]:
        """The fitted curve in the program's JSON: model, parameters, candidates."""
        if self._fit is None:
            raise ValueError("no POD curve")
        if self._fit["refusal"]:
            raise ValueError(self._fit["refusal"])
        return self._fit

    @property
    def curve(self) -> Columns:
        units = {"size": self._unit, "pod": "1", "lower": "1", "upper": "1"}
        return Columns([(name, unit, np.array(self.fit["band"][name], dtype=float))
                        for name, unit in units.items()], ("point",))

    @property
    def a50(self) -> Tuple[float, float, float]:
        return self._sizes("a50")

    @property
    def a90(self) -> Tuple[float, float, float]:
        return self._sizes("a90")

    def _sizes(self, name: str) -> Tuple[float, float, float]:
        size = self.fit[name]
        estimate, lower, upper = (
            np.nan if size[bound]["size"] is None else float(size[bound]["size"])
            for bound in ("estimate", "lower", "upper"))
        return estimate, lower, upper


class Study:
    """A study that is read once. Its functions are those of the module."""

    def __init__(self, study: Union[PathLike, Mapping[str, Any]], *,
                 set: Optional[Mapping[str, Any]] = None) -> None:
        name, text = _name_and_text(study)
        overrides = [f"{key}={toml_value(value)}" for key, value in (set or {}).items()]
        self._open = compiled().OpenStudy(name, text, overrides,
                                          not isinstance(study, Mapping))

    def stiffness(self, *, points: int = 1000, transmission_error: bool = False) -> Columns:
        """Mesh stiffness (N/m) of every gear pair over a mesh period, healthy and with each fault
        size of the study; or the loaded static transmission error (um)."""
        return Columns(self._open.stiffness(points, transmission_error), ("point",))

    def describe(self) -> Dict[str, Dict[str, str]]:
        """Texts on gearbox, effects simulated and effects omitted, by heading and name, as in
        `gearpod describe --full`. The forecast of time and memory is the program's."""
        description: Dict[str, Dict[str, str]] = self._open.describe()
        return description

    def modes(self) -> Array:
        """Natural frequencies, Hz, ascending, at the mean mesh stiffness."""
        modes: Array = self._open.modes()
        return modes

    def simulate(self, rows: Union[int, Sequence[int], Array] = 0, *,
                 meshes: Optional[int] = None) -> Simulation:
        """Signals and features of the gearboxes in these rows of the study's results, over a
        planet turn or `meshes` mesh periods. With a sequence of rows, arrays have one axis more,
        the first. Raises Failed with code 3 if a gearbox fails."""
        single = np.ndim(rows) == 0
        given = self._open.simulate([int(row) for row in np.atleast_1d(np.asarray(rows))],
                                    0 if meshes is None else _positive("meshes", meshes))

        def shaped(array: Array) -> Array:
            return np.asarray(array[0]) if single else array

        values = shaped(given["features"])
        return Simulation(
            Columns([(name, unit, shaped(array)) for name, unit, array in given["signals"]],
                    ("sample",) if single else ("row", "sample")),
            {name: values[..., f, :] for f, name in enumerate(given["feature_names"])},
            given["noise_levels"],
            {mesh: shaped(array) for mesh, array in given["contact_loss"].items()})

    def features(self, signal: SignalLike, *, baseline: Optional[SignalLike] = None,
                 healthy: Sequence[SignalLike] = (), against: Optional[PathLike] = None,
                 feature: str = "", noise_level: float = 1.0, **columns: Any) -> Features:
        """Features of a recording.

        signal       a file, an array of accelerations (m/s^2), or columns by name with the names
                     that a file has: sensor, te (rad), time (s), mesh_phase, speed_rpm; a unit
                     may follow in brackets, "sensor [g]"
        baseline     earlier recording of the same gearbox
        healthy      recordings of healthy gearboxes, the reference of na4
        against      results file with healthy gearboxes to compare with
        feature      feature that decides the alarm; by default the best ranked one
        noise_level  of simulated healthy gearboxes
        columns      sampling_Hz, samples_per_mesh, sensor, te, sensor_unit, sensor_sensitivity,
                     tachometer, pulses_per_turn, encoder, row, speed: as the options of
                     `gearpod features`
        """
        return Features(json.loads(self._open.features(
            _recording(signal), None if baseline is None else _recording(baseline),
            [_recording(each) for each in healthy],
            _options(compiled().SignalColumns(), columns), noise_level,
            "" if against is None else os.fspath(against), feature)))


def stiffness(study: StudyLike, *, points: int = 1000, transmission_error: bool = False) -> Columns:
    """See Study.stiffness."""
    return _study(study).stiffness(points=points, transmission_error=transmission_error)


def describe(study: StudyLike) -> Dict[str, Dict[str, str]]:
    """See Study.describe."""
    return _study(study).describe()


def modes(study: StudyLike) -> Array:
    """See Study.modes."""
    return _study(study).modes()


def simulate(study: StudyLike, rows: Union[int, Sequence[int], Array] = 0, *,
             meshes: Optional[int] = None) -> Simulation:
    """See Study.simulate."""
    return _study(study).simulate(rows, meshes=meshes)


def features(signal: SignalLike, study: StudyLike, **options: Any) -> Features:
    """See Study.features."""
    return _study(study).features(signal, **options)


def pod(table: TableLike, **options: Any) -> Pod:
    """Probability of detection from a table of inspections: a CSV file, columns by name, or a
    pandas DataFrame. A unit may follow a name in brackets, "size [mm]".

    options are those of `gearpod pod`: size, hit, response, specimen (columns), link, size_scale,
    response_scale, convention, bounds, alarm, threshold, false_call_rate, left, right, floor,
    target, confidence, fit_ceiling, firth. Bounds are calibrated unless convention or bounds say
    otherwise.
    """
    for name in ("hit", "response", "link"):
        if isinstance(options.get(name), str):
            options[name] = [options[name]]
    if "response_scale" in options:
        options["response_scale"] = str(options["response_scale"])
    names, columns = [], []
    path = None if _has_columns(table) else os.fspath(table)  # type: ignore[arg-type]
    if path is None:
        names = [str(name) for name in table]  # type: ignore[union-attr]
        columns = [[_field(value) for value in table[name]]  # type: ignore[index]
                   for name in table]  # type: ignore[union-attr]
    text, report = compiled().pod(path, names, columns,
                                  _options(compiled().InspectionOptions(), options))
    report = json.loads(report)
    return Pod(report, text, report["hit_miss"] or report["signal_response"],
               report["size"]["unit"])


def grade(path: PathLike, values: Any, *, name: str, alarm: str, unit: str,
          noise_level: float) -> Pod:
    """See Results.pod."""
    report = json.loads(compiled().grade(
        os.fspath(path), name, unit, alarm, noise_level,
        np.ascontiguousarray(values, dtype=float).ravel()))
    fit = report["reliability"]["hit_miss"] if report["reliability"] else None
    return Pod(report, "", fit, report["detection"]["size"]["unit"])


def _study(study: StudyLike) -> Study:
    return study if isinstance(study, Study) else Study(study)


def _name_and_text(study: Union[PathLike, Mapping[str, Any]]) -> Tuple[str, Optional[str]]:
    """Name for messages, and the TOML text unless the name is a file's."""
    if isinstance(study, Mapping):
        return "study", "\n".join(f"{json.dumps(str(section))} = {toml_value(keys)}"
                                  for section, keys in study.items())
    if isinstance(study, str) and ("\n" in study or "=" in study):
        return "study", study
    return os.fspath(study), None


def _has_columns(value: Any) -> bool:
    """True for a mapping and for a pandas DataFrame or xarray Dataset."""
    return isinstance(value, Mapping) or hasattr(value, "columns")


def _recording(signal: SignalLike) -> Union[str, List[Tuple[str, str, Array]]]:
    if isinstance(signal, (str, os.PathLike)):
        return os.fspath(signal)
    if not _has_columns(signal):
        return [("sensor", "", np.ascontiguousarray(signal, dtype=float).ravel())]
    units = getattr(signal, "units", {})
    columns = []
    for header in signal:
        name, _, unit = str(header).partition(" [")
        array = np.ascontiguousarray(signal[header], dtype=float)  # type: ignore[index]
        columns.append((name, unit.rstrip("]") or units.get(name, ""), array.ravel()))
    return columns


def _field(value: Any) -> str:
    """Field of a table; a missing number is empty."""
    if isinstance(value, (float, np.floating)):
        return "" if np.isnan(value) else repr(float(value))
    if isinstance(value, (bool, np.bool_)):
        return str(int(value))
    return "" if value is None else str(value)


def _options(target: Any, options: Mapping[str, Any]) -> Any:
    for name, value in options.items():
        if name.startswith("_") or not hasattr(type(target), name):
            known = [each for each in dir(type(target)) if not each.startswith("_")]
            raise TypeError(f"unknown option {name}; available: {', '.join(known)}")
        setattr(target, name, value)
    return target


def _positive(name: str, value: int) -> int:
    if value < 1:
        raise ValueError(f"{name} must be at least 1, but is {value}")
    return int(value)
