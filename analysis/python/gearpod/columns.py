"""Named numpy arrays with units, as pandas and xarray see them too."""

from __future__ import annotations

import importlib
from typing import Any, Dict, Iterable, Iterator, Mapping, Tuple

import numpy.typing as npt

Array = npt.NDArray[Any]


class Columns(Mapping[str, Array]):
    """Arrays of one shape by name, for example the signals of a gearbox. `units` has the unit of
    each, `dimensions` the names of the axes."""

    def __init__(self, columns: Iterable[Tuple[str, str, Array]],
                 dimensions: Tuple[str, ...]) -> None:
        self.units: Dict[str, str] = {}
        self.dimensions = dimensions
        self._arrays: Dict[str, Array] = {}
        for name, unit, array in columns:
            self.units[name] = unit
            self._arrays[name] = array

    def __getitem__(self, name: str) -> Array:
        if name not in self._arrays:
            raise KeyError(f"no {name}; available: {', '.join(self._arrays)}")
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def __repr__(self) -> str:
        shape = next(iter(self._arrays.values())).shape if self._arrays else ()
        axes = " x ".join(f"{n} {name}s" for n, name in zip(shape, self.dimensions))
        return f"<gearpod columns {', '.join(self._arrays)}: {axes}>"

    def frame(self) -> Any:
        """The columns as a pandas DataFrame; needs pandas. Of several axes the index has one level
        each."""
        pandas = import_pandas()
        if len(self.dimensions) == 1:
            frame = pandas.DataFrame(self._arrays)
            frame.index.name = self.dimensions[0]
            return frame
        shape = next(iter(self._arrays.values())).shape
        index = pandas.MultiIndex.from_product([range(n) for n in shape], names=self.dimensions)
        return pandas.DataFrame({name: array.ravel() for name, array in self._arrays.items()},
                                index=index)

    def dataset(self) -> Any:
        """The columns as an xarray Dataset with units as attributes; needs xarray."""
        return import_xarray().Dataset({name: (self.dimensions, array, {"units": self.units[name]})
                                        for name, array in self._arrays.items()})


def _imported(name: str, problem: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(problem) from error


def import_xarray() -> Any:
    return _imported("xarray", "datasets need xarray (Debian: python3-xarray); a column is a numpy "
                               "array")


def import_pandas() -> Any:
    return _imported("pandas", "frames need pandas (Debian: python3-pandas); numpy arrays are "
                               "available without it")
