"""Computes features that are written in Python (docs/guide/own-features.md) for the program gearpod.

The program contains this file and starts it as a process per thread. Requests and replies are
framed messages on the socket that is standard input: the number of bytes (8 bytes, native order),
a line of JSON, and doubles in native order. Only numpy is needed.
"""

# mypy: ignore-errors

import copy
import hashlib
import importlib
import inspect
import json
import numbers
import os
import random
import signal
import socket
import stat
import struct
import sys
import sysconfig
import threading
import time
import traceback
import types

SIGNALS = ("record", "baselines", "change")  # parameters that a feature may have
MOST_BYTES = 1 << 26  # of a file of Python functions
ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


class Record:
    """Signals and properties of one record. In a function with `batch = True`, the signals and
    what is computed from them have a leading axis: one row per noise level.

    sensor               m/s^2, whole turns of the monitored gear; None without a sensor, and in
                         functions with `samples = False`
    te                   rad, transmission error averaged over turns of that gear, without its mean
    tooth_rms            m/s^2, rms around every tooth of that gear; None without a sensor
    noise_level          factor on the noise, one of sensor.noise_levels (batch: an array)
    gear_teeth           teeth of the monitored gear: planet, pinion, or gear with the fault
    teeth, planets       teeth of all gears by name, number of planets (0: fixed shafts)
    samples_per_mesh, te_samples_per_mesh, carrier_meshes (mesh periods per carrier turn)
    mesh_Hz, sampling_Hz, torque_Nm, speed_rpm, noise_m_s2 (rms at noise level 1)
    """

    def __init__(self, properties, signals):
        self.sensor = self.te = self.tooth_rms = None
        self.__dict__.update(properties)
        self.__dict__.update(signals)

    @property
    def sensor_average(self):
        """Sensor signal averaged over turns of the monitored gear, m/s^2."""
        turn = self.gear_teeth * self.samples_per_mesh
        return self.sensor.reshape(*self.sensor.shape[:-1], -1, turn).mean(axis=-2)

    @property
    def gear_angle(self):
        """Angle of the monitored gear at every sensor sample, rad, from the record's start."""
        return self._angle(self.gear_teeth)

    @property
    def carrier_angle(self):
        """Angle of the carrier relative to its fixed gear, rad, from the record's start."""
        return self._angle(self.carrier_meshes)

    def without_samples(self):
        other = copy.copy(self)
        other.sensor = None
        return other

    def _angle(self, meshes):
        samples = numpy.arange(self.sensor.shape[-1])
        return 2 * numpy.pi * samples / (meshes * self.samples_per_mesh)


class Refused(Exception):
    """Message for the user."""


def place_of(error, path, line=1):
    """File and line: of a syntax error, or where the user's file was last; else the given line."""
    if isinstance(error, SyntaxError) and error.filename == path:
        return f"{path}:{error.lineno}"
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__)
             if frame.filename == path]
    return f"{path}:{lines[-1] if lines else line}"


def one_line(error):
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    return f"{type(error).__name__}: {' '.join(text.split())[:300]}".rstrip(": ")


class Function:
    """Feature of a file: function whose first parameter is `record`."""

    def __init__(self, name, code, call, path):
        self.call, self.path, self.line = call, path, code.co_firstlineno
        self.name = name if name != "feature" else os.path.splitext(os.path.basename(path))[0]
        parameters = inspect.signature(call).parameters.values()
        needed = [p.name for p in parameters if p.default is p.empty
                  and p.kind not in (p.VAR_POSITIONAL, p.VAR_KEYWORD)]
        self.uses = [p.name for p in parameters if p.name in SIGNALS]
        unknown = [name for name in needed if name not in SIGNALS]
        if unknown:
            self.refuse(f"unknown parameter {unknown[0]}; a feature has {', '.join(SIGNALS)}")
        if not (self.name.isascii() and self.name.isidentifier()):
            self.refuse("the name of a feature has only ASCII letters, digits and underscores")
        self.unit = self.attribute("unit", "1")
        self.title = self.attribute("title", "")
        self.alarm = self.attribute("alarm", "high")
        if self.alarm not in ("high", "low"):
            self.refuse(f'alarm = {self.alarm!r}, but it is "high" or "low"')
        self.batch = getattr(call, "batch", False) is True
        self.samples = getattr(call, "samples", True) is not False
        self.doc = " ".join((inspect.getdoc(call) or "").split("\n\n")[0].split())[:300]

    def refuse(self, what):
        raise Refused(f"{self.path}:{self.line}: {self.name}: {what}")

    def attribute(self, name, otherwise):
        value = getattr(self.call, name, otherwise)
        if not isinstance(value, str) or not value.isprintable() or (otherwise and not value):
            self.refuse(f"{name} = {value!r}, but it is a line of text")
        return value

    def described(self):
        return {name: getattr(self, name) for name in ("name", "title", "unit", "alarm", "doc")} | {
            "uses": ", ".join(self.uses), "samples": "" if self.samples else "no"}

    def values(self, records, levels):
        """One value per noise level, and the errors as (level, file and line, text)."""
        if self.batch:
            return self.batch_values(records.of(None), levels)
        values, errors = numpy.full(levels, numpy.nan), []
        for level in range(levels):
            try:
                values[level] = self.number(self.call(**self.arguments(records.of(level))))
            except MemoryError:
                raise
            except BaseException as error:  # also SystemExit, which must not end the process
                errors.append((level, place_of(error, self.path, self.line), one_line(error)))
        return values, errors

    def batch_values(self, signals, levels):
        try:
            values = numpy.asarray(self.call(**self.arguments(signals)))
            if values.shape != (levels,) or values.dtype.kind not in "fiub":
                raise TypeError(f"returned an array of shape {values.shape} and type "
                                f"{values.dtype}, not {levels} real numbers, one per noise level")
            return values.astype(float), []
        except MemoryError:
            raise
        except BaseException as error:
            return numpy.full(levels, numpy.nan), [
                (0, place_of(error, self.path, self.line), one_line(error))]

    def arguments(self, signals):
        used = {name: signals[name] for name in self.uses}
        if self.samples:
            return used
        return {name: [record.without_samples() for record in value] if isinstance(value, list)
                else value.without_samples() for name, value in used.items()}

    def number(self, value):
        if isinstance(value, numpy.ndarray) and value.ndim == 0:
            value = value[()]
        if not isinstance(value, (numbers.Real, numpy.bool_)):
            what = (f"an array of shape {value.shape}" if isinstance(value, numpy.ndarray)
                    else repr(value)[:80])
            raise TypeError(f"returned {what}, not a real number")
        return float(value)


class Records:
    """Signals of a request: the same arrays for every noise level."""

    def __init__(self, request, data):
        self.request = request
        self.all = numpy.frombuffer(data).reshape(len(request["levels"]), -1)
        self.all.flags.writeable = False

    def of(self, level):
        """The parameters of a feature at one noise level, or (None) at all of them."""
        rows = self.all if level is None else self.all[level]
        levels = numpy.array(self.request["levels"])
        noise = levels if level is None else levels[level]
        made, column = [], 0
        for kind, properties, arrays in self.request["records"]:
            signals = {}
            for name, count in arrays:
                signals[name] = rows[..., column:column + count]
                column += count
            made.append((kind, Record(properties | {"noise_level": noise}, signals)))
        found = {kind: record for kind, record in made}
        return found | {"baselines": [record for kind, record in made if kind == "baselines"]}


def content(path):
    try:
        if not stat.S_ISREG(os.stat(path).st_mode) and not os.path.isdir(path):
            raise Refused(f"{path}: is not a regular file; name a file of Python functions")  # it might never end
        with open(path, "rb") as stream:
            data = stream.read(MOST_BYTES + 1)
        if len(data) > MOST_BYTES:
            raise Refused(f"{path}: has more than {MOST_BYTES} bytes; name a file of Python functions")
        return data
    except OSError as error:
        raise Refused(f"{path}: cannot be read: {error.strerror}") from None


def sha256(data):
    return hashlib.sha256(data).hexdigest()


def is_below(path, folder):
    """True for a file in the folder or below that is no installed package and not of Python."""
    inside = os.path.relpath(path, folder).split(os.sep)
    library = sysconfig.get_paths()["stdlib"] + os.sep
    return not (inside[0] == ".." or {"site-packages", "dist-packages"} & set(inside)
                or path.startswith(library))


def imported_from(folder):
    """Files of the imported modules by name, of those in the folder or below."""
    files = {name: getattr(module, "__dict__", {}).get("__file__")
             for name, module in list(sys.modules.items())}
    return {name: os.path.abspath(file) for name, file in files.items()
            if isinstance(file, str) and is_below(os.path.abspath(file), folder)}


class Source:
    """A user's file that was run: its hash, and the modules from its folder or below that were
    imported since then, as sorted lines of file and hash."""

    def __init__(self, path, found):
        self.path, self.folder, self.sha256 = path, os.path.dirname(path), found
        self.modules = []

    def imported(self):
        files = set(imported_from(self.folder).values()) - {self.path}
        return sorted(f"{os.path.relpath(file, self.folder)} {sha256(content(file))}"
                      for file in files)

    def check_modules(self, expected):
        """Refuses other modules than those of the study, which are lines as `modules` has them."""
        now, then = (dict(line.rsplit(" ", 1) for line in lines)
                     for lines in (self.modules, expected))
        for name in sorted(now | then):
            file = os.path.join(self.folder, name)
            if name not in now:
                raise Refused(f"{self.path}: does not import {file}, as when the study was read")
            if name not in then:
                raise Refused(f"{self.path}: imports {file}, but not when the study was read")
            check_hash(file, now[name], then[name])


def check_hash(file, found, expected):
    if found != expected:
        raise Refused(f"{file}: has changed since the study was read: its SHA-256 is now {found}, "
                      f"not {expected}")


def load(path, expected, loaded):
    """Runs a file. Returns its source and its features by name. `expected`: hashes of the study,
    if it has them; `loaded`: sources of the files that were run before."""
    text = content(path)
    source = Source(path, sha256(text))
    check_hash(path, source.sha256, expected.get("sha256", source.sha256))
    # Every file imports its modules anew, so that the list does not depend on other files.
    for folder in {source.folder, *(other.folder for other in loaded)}:
        for name in imported_from(folder):
            del sys.modules[name]
    importlib.invalidate_caches()
    module = types.ModuleType(os.path.splitext(os.path.basename(path))[0])
    module.__file__ = path
    sys.modules.setdefault(module.__name__, module)
    sys.path[:] = [source.folder] + [folder for folder in sys.path if folder != source.folder]
    try:
        exec(compile(text, path, "exec"), module.__dict__)
    except BaseException as error:
        raise Refused(f"{place_of(error, path)}: {one_line(error)}") from None
    source.modules = source.imported()
    source.check_modules(expected.get("modules", source.modules))
    functions = {}
    for name, value in list(module.__dict__.items()):
        code = getattr(inspect.unwrap(value), "__code__", None) if callable(value) else None
        if name.startswith("_") or code is None or code.co_filename != path:
            continue
        if next(iter(inspect.signature(value).parameters), None) == "record":
            function = Function(name, code, value, path)
            if function.name in functions:
                function.refuse("the file has another feature of this name")
            functions[function.name] = function
    if not functions:
        raise Refused(f"{path}: has no feature: no public function whose first parameter is record")
    return source, functions


class Worker:
    def __init__(self):
        self.functions = {}  # by path and name
        self.sources = {}  # by path

    def load(self, request):
        path = request["file"]
        source, functions = load(path, request, self.sources.values())
        self.sources[path], self.functions[path] = source, functions
        self.imported = len(sys.modules)
        return {"sha256": source.sha256, "modules": source.modules,
                "functions": [f.described() for f in functions.values()]}

    def check_imports(self):
        """Refuses modules that a function has imported, if the results do not hold their hashes."""
        if len(sys.modules) == self.imported:
            return
        self.imported = len(sys.modules)
        known = {os.path.join(loaded.folder, line) for loaded in self.sources.values()
                 for line in [*loaded.modules, f"{os.path.basename(loaded.path)} {loaded.sha256}"]}
        for loaded in self.sources.values():
            for line in loaded.imported():
                if os.path.join(loaded.folder, line) not in known:
                    raise Refused(f"{loaded.path}: a function imports {line.rsplit(' ', 1)[0]}; import "
                                  f"it outside of functions, because results hold its SHA-256")

    def reply(self, request, data):
        if "file" in request:
            return self.load(request), b""
        records = Records(request, data)
        levels = len(request["levels"])
        values, errors = [], []
        for path, name in request["features"]:
            random.seed(0)
            numpy.random.seed(0)
            result, result_errors = self.functions[path][name].values(records, levels)
            values.append(result)
            errors += [(name, request["levels"][level], *error) for level, *error in result_errors]
        self.check_imports()
        return {"errors": errors}, numpy.concatenate(values).tobytes()


def receive(connection, count):
    data = bytearray(count)
    view, received = memoryview(data), 0
    while received < count:
        got = connection.recv_into(view[received:])
        if got == 0:
            os._exit(0)
        received += got
    return data


def end_with(parent):
    """Ends the process when the program has ended, even if a feature does not return."""
    while os.getppid() == parent:
        time.sleep(1.0)
    os._exit(0)


def main():
    global numpy
    # The stop signals (src/machine/stop_signals.hpp): the program decides when this process ends.
    for request in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1, signal.SIGUSR2, signal.SIGXCPU, signal.SIGHUP):
        signal.signal(request, signal.SIG_IGN)
    connection = socket.socket(fileno=os.dup(0))
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    threading.Thread(target=end_with, args=(os.getppid(),), daemon=True).start()
    for name in ONE_THREAD:  # threads would change the order of sums
        os.environ[name] = "1"
    worker, missing = Worker(), ""
    try:
        import numpy
    except ImportError as error:
        missing = f"{sys.executable}: {error}; name a Python 3 with numpy in GEARPOD_PYTHON"
    while True:
        length, = struct.unpack("=Q", receive(connection, 8))
        message = receive(connection, length)
        end = message.index(b"\n")
        try:
            if missing:
                raise Refused(missing)
            reply, data = worker.reply(json.loads(message[:end].decode()),
                                       memoryview(message)[end + 1:])
        except Refused as error:
            reply, data = {"refused": str(error)}, b""
        except MemoryError:
            reply, data = {"refused": "Python has not enough memory"}, b""
        framed = json.dumps(reply).encode() + b"\n" + data
        connection.sendall(struct.pack("=Q", len(framed)) + framed)


if __name__ == "__main__":
    main()
