#!/usr/bin/python3
"""Tables of reference numbers: HDF5 files with a dataset per column, and their source and the command that makes
them as attributes `source` and `command` (README.md)."""
import csv
import io
import sys

import h5py
import numpy as np


class TableFile(io.StringIO):
    """Open file for comma-separated values with a heading; at its end an HDF5 file at `path` receives the table.
    Numbers become doubles and empty cells NaN; a heading `sensor [m/s^2]` gives the name and its unit."""

    def __init__(self, path, source, command):
        super().__init__()
        self.path, self.source, self.command = path, source, command

    def __exit__(self, kind, value, trace):
        if kind is None:
            heading, *rows = csv.reader(io.StringIO(self.getvalue()))
            with h5py.File(self.path, "w", track_order=True) as file:
                file.attrs["source"], file.attrs["command"] = self.source, self.command
                for name, cells in zip(heading, zip(*rows, strict=True)):
                    name, _, unit = name.partition(" [")
                    write_column(file, name, unit.rstrip("]"), cells)
        super().__exit__(kind, value, trace)


def write_column(file, name, unit, cells):
    try:
        values = np.array([float(cell or "nan") for cell in cells])
    except ValueError:
        values = np.array(cells, "S")
    filters = {"compression": "gzip", "compression_opts": 9, "shuffle": True} if len(values) > 256 else {}
    file.create_dataset(name, data=values, chunks=values.shape if filters else None, **filters)
    if unit:
        file[name].attrs["unit"] = unit


def read_table(path):
    """Columns by name, in their order; texts as str."""
    with h5py.File(path) as file:
        return {name: column.asstr()[:] if column.dtype.kind == "S" else column[:] for name, column in file["/"].items()}


def main(arguments):
    """FILE.h5 prints a table as CSV; FILE.h5 SOURCE COMMAND makes one of the CSV on standard input."""
    if len(arguments) == 3:
        with TableFile(*arguments) as table:
            table.write(sys.stdin.read())
        return
    columns = read_table(arguments[0])
    csv.writer(sys.stdout, lineterminator="\n").writerows([columns, *zip(*(c.tolist() for c in columns.values()))])


if __name__ == "__main__":
    main(sys.argv[1:])
