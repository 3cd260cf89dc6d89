"""Commands of the program as functions that return values.

A study is the path of a study file. `set` changes its keys, {"sensor.noise_m_s2": 2}. Other keyword
arguments are the command's options with underscores: `instances=100` is --instances 100, True a flag,
a list one option for each element. Refused input raises Failed with the program's text.
"""

from __future__ import annotations

import json
import os
from typing import Any, Dict, List, Mapping, Optional

from .program import Failed, PathLike, call, settings, toml_value


def new(kind: str = "planetary", **options: Any) -> str:
    """Study (TOML) of a planetary stage or a gear pair from its datasheet: `new("planetary", sun=21,
    planet=39, ring=99, module=12, power=1500, speed=18)`."""
    return call(["new", kind, *_options(options)]).stdout


def check(*studies: PathLike) -> List[str]:
    """Problems of studies, one line each; empty if all can be simulated."""
    try:
        call(["check", *(os.fspath(study) for study in studies)])
    except Failed as error:
        if error.code != 2:
            raise
        return str(error).splitlines()
    return []


def sweep(study: PathLike, vary: Mapping[str, List[Any]], *, set: Optional[Mapping[str, Any]] = None,
          **options: Any) -> Dict[str, Any]:
    """Results at every combination of the values of `vary`, {"sensor.noise_m_s2": [1, 2]}: the report
    that `sweep --json` writes. Results files go into the folder `out`."""
    varied = [part for key, values in vary.items() for part in ("--vary", f"{key}={toml_value(values)}")]
    return _report(["sweep", os.fspath(study), *varied, *settings(set)], options)


def compare(*results: PathLike, **options: Any) -> Dict[str, Any]:
    """Differences in detection between results files: the report that `compare --json` writes."""
    return _report(["compare", *(os.fspath(path) for path in results)], options)


def accuracy(study: PathLike, *, set: Optional[Mapping[str, Any]] = None,
             **options: Any) -> Dict[str, Any]:
    """Errors and times of solver settings: the report that `accuracy --json` writes."""
    return _report(["accuracy", os.fspath(study), *settings(set)], options)


def _report(arguments: List[str], options: Mapping[str, Any]) -> Dict[str, Any]:
    report: Dict[str, Any] = json.loads(call([*arguments, "--json", "-", *_options(options)]).stdout)
    return report


def _options(options: Mapping[str, Any]) -> List[str]:
    words: List[str] = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        for each in value if isinstance(value, (list, tuple)) else [value]:
            words += [option] * (each is not False) + ([] if isinstance(each, bool) else [str(each)])
    return words
