"""Finds and runs the program gearpod."""

from __future__ import annotations

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
from typing import Any, List, Mapping, Optional, Sequence, Union

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
        for name in ("bin/gearpod", "build/gearpod"):
            if (folder / name).is_file():
                return str(folder / name)
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


def settings(changed: Optional[Mapping[str, Any]]) -> List[str]:
    """Options --set of the keys and values."""
    return [part for key, value in (changed or {}).items()
            for part in ("--set", f"{key}={toml_value(value)}")]
