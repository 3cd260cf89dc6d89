"""Finds and runs the program gearpod."""

from __future__ import annotations

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import warnings
from typing import TYPE_CHECKING, Any, Mapping, Optional, Sequence, Union

if TYPE_CHECKING:
    from .results import Results

PathLike = Union[str, "os.PathLike[str]"]
SOME_FAILED = 3


class Failed(RuntimeError):
    """The program refused its arguments or stopped early. `code` is its exit code; the message is
    the program's own."""

    def __init__(self, code: int, message: str) -> None:
        super().__init__(message.strip() or f"gearpod exited with code {code}")
        self.code = code


def find_program() -> str:
    """Path of the program: GEARPOD_PROGRAM, the one installed with this package or built in its
    checkout, otherwise the first in PATH. Raises FileNotFoundError if there is none."""
    given = os.environ.get("GEARPOD_PROGRAM")
    if given:
        return given
    for folder in pathlib.Path(__file__).resolve().parents:
        for place in ("bin/gearpod", "build/gearpod"):
            if (folder / place).is_file():
                return str(folder / place)
    found = shutil.which("gearpod")
    if found is None:
        raise FileNotFoundError("program gearpod not found: build it, add it to PATH, or set "
                                "GEARPOD_PROGRAM")
    return found


def call(arguments: Sequence[str], progress: bool = False) -> subprocess.CompletedProcess[str]:
    """Runs the program. Raises Failed unless the exit code is 0 (complete) or 3 (some gearboxes
    failed). With `progress` its messages go to standard error immediately."""
    with tempfile.TemporaryFile("w+") as messages:
        done = subprocess.run([find_program(), *arguments], check=False, text=True,
                              stdout=sys.stderr if progress else subprocess.PIPE,
                              stderr=None if progress else messages)
        messages.seek(0)
        output = messages.read()
    if done.returncode not in (0, SOME_FAILED):
        raise Failed(done.returncode, output)
    done.stderr = output
    return done


def toml_value(value: Any) -> str:
    """Value in the syntax of --set: numbers, booleans, texts, lists and tables of these."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{k} = {toml_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, (list, tuple)) or getattr(value, "ndim", 0) > 0:
        return "[" + ", ".join(toml_value(each) for each in value) + "]"
    return repr(value.item() if hasattr(value, "item") else value)


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
    from .results import open as open_results

    target = pathlib.Path(out) if out is not None else pathlib.Path(
        pathlib.Path(study).with_suffix(".h5").name)
    arguments = ["run", os.fspath(study), "--out", str(target)]
    for key, value in (set or {}).items():
        arguments += ["--set", f"{key}={toml_value(value)}"]
    for name, number in (("--instances", instances), ("--seed", seed)):
        if number is not None:
            arguments += [name, str(number)]
    arguments += ["--resume"] * resume + ["--force"] * force
    shown = sys.stderr.isatty() if progress is None else progress
    done = call(arguments + ([] if shown else ["--quiet"]), shown)
    if done.returncode == SOME_FAILED:
        warnings.warn(f"{target}: some gearboxes failed; results.status shows which", stacklevel=2)
    return open_results(target)
