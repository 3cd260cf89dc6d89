"""Recordings as recorders, spreadsheets and libraries write them: one signal in many files, with the right answer for each.

Every function that is decorated with `case` writes files into a folder and yields tuples: name of the file, arguments,
expected answer. Answers: a factor on the signal (1.0: read in m/s^2), or a text that the refusal must contain."""

import gzip
import io
import os
import struct
import wave

import h5py
import numpy as np
import scipy.io

RATE = 5120.0
G = 9.80665
CASES = []


def signal():
    """One second of a planetary rig with 20/28/76 teeth at 76 Hz mesh frequency, rounded as recorders round."""
    t = np.arange(5120) / RATE
    generator = np.random.default_rng(47)
    mesh = sum(np.cos(2 * np.pi * 76 * k * t + k) / k for k in (1, 2, 3, 4))
    loud_tooth = 1 + 0.6 * np.exp(-(((t * 76 / 28) % 1 - 0.3) / 0.02) ** 2)
    return np.round(mesh * loud_tooth + 0.3 * generator.standard_normal(t.size), 4)


X = signal()
T = np.arange(X.size) / RATE


def case(function):
    CASES.append(function)
    return function


def write(folder, name, text, encoding="utf-8"):
    (folder / name).write_bytes(text.encode(encoding) if isinstance(text, str) else text)
    return name


def rows(*columns, separator=",", end="\n"):
    return "".join(separator.join(fields) + end for fields in zip(*columns))


def numbers(values, form="%.9f", comma=False):
    texts = [form % v for v in values]
    return [t.replace(".", ",") for t in texts] if comma else texts


@case
def csv_units(folder):
    def table(header, factor=1.0, encoding="utf-8"):
        return (f"time [s],{header}\n" + rows(numbers(T), numbers(X / factor))).encode(encoding)

    for i, (unit, factor) in enumerate([("m/s^2", 1), ("m/s**2", 1), ("m/s2", 1), ("m/s²", 1), ("m s^-2", 1), ("mm/s^2", 1e-3),
                                        ("g", G), ("mg", G / 1e3)]):
        yield write(folder, f"unit{i}.csv", table(f"sensor [{unit}]", factor)), [], 1.0
    yield write(folder, "latin1.csv", table("sensor [m/s²]", encoding="latin-1")), [], 1.0
    yield write(folder, "tight.csv", table("sensor[g]", G)), [], 1.0
    yield write(folder, "tight_remark.csv", table("sensor[g (peak)]")), [], (G, "g (peak)")
    yield write(folder, "remark.csv", table("sensor [g (peak)]")), [], (G, "g (peak)")
    yield write(folder, "volts.csv", table("sensor [V]")), [], "V"
    yield write(folder, "volts_taken.csv", table("sensor [V]")), ["--sensor-unit", "m/s^2"], 1.0
    yield write(folder, "furlongs.csv", table("sensor [furlong/s^2]")), [], "furlong"
    yield write(folder, "furlongs_taken.csv", table("sensor [furlong/s^2]")), ["--sensor-unit", "g"], G
    yield write(folder, "millivolts.csv", table("sensor [mV]", 0.1)), ["--sensor-sensitivity", "10 mV/(m/s^2)"], 1.0
    yield write(folder, "place.csv", table("Accelerometer (rear)")), ["--sensor", "Accelerometer (rear)"], 1.0
    yield write(folder, "place_alone.csv", table("Accelerometer (rear)")), ["--sensor", "Accelerometer"], 1.0
    yield write(folder, "parenthesis.csv", table("sensor (g)", G)), [], 1.0
    yield (write(folder, "quoted.csv", table('"sensor, rear [g]"', G)), ["--sensor", "sensor, rear"], 1.0)


@case
def csv_times(folder):
    def table(name, times, unit="s"):
        return write(folder, name, f"time [{unit}],sensor [m/s^2]\n" + rows(times, numbers(X, "%.4f")))

    yield table("float32.csv", numbers((64 + T).astype(np.float32), "%.9g")), [], 1.0
    yield table("six_digits.csv", numbers(9.6 + T, "%.6g")), [], 1.0
    yield table("epoch.csv", numbers(1.7e9 + T, "%.6f")), [], 1.0
    yield table("epoch_ms.csv", numbers((1.7e9 + T) * 1e3, "%.3f"), "ms"), [], 1.0
    lost = np.delete(np.arange(X.size + 3), [2000, 2001, 2002]) / RATE
    yield table("lost.csv", numbers(lost)), [], "column time"


@case
def csv_dialects(folder):
    """Some forms; tests/mc/files/test_text_dialects.cpp has all."""
    x, t, xc = numbers(X, "%.4f"), numbers(T), numbers(X, "%.4f", True)
    head = "time [s],sensor [m/s^2]\n"
    plain = head + rows(t, x)
    w = lambda name, text, encoding="utf-8": write(folder, name, text, encoding)
    yield w("plain.csv", plain), [], 1.0
    yield w("blank_lines.csv", "\n" + plain + "\n\n"), [], 1.0
    yield w("one_column.csv", "sensor [m/s^2]\n" + rows(xc)), ["--sampling-Hz", "5120"], 1.0
    yield "one_column.csv", ["--sampling-Hz", "1e-320"], "--sampling-Hz"
    yield w("units_row_unknown.csv", "time,sensor\ns,furlong/s^2\n" + rows(t, x)), [], "furlong"
    yield w("gap.csv", head + rows(t, ["" if i == 700 else v for i, v in enumerate(x)])), [], "702"
    (folder / "zipped.csv.gz").write_bytes(gzip.compress(plain.encode()))
    yield "zipped.csv.gz", [], 1.0


@case
def hdf5_files(folder):
    """Statements of h5py; tests/mc/files/test_hdf5_recordings.cpp has all structures."""
    def made(name, fill, **options):
        with h5py.File(folder / name, "w", **options) as file:
            fill(file)
        return name

    def attributes(**values):
        def fill(file):
            d = file.create_dataset("sensor", data=values.pop("data", X))
            file.attrs["sampling_Hz"] = RATE
            for key, value in values.items():
                d.attrs[key] = value
        return fill

    yield made("unit.h5", attributes(data=X / G, unit="g")), [], 1.0
    for name in ("unit", "units", "Units", "unit_string", "engineering_units"):  # text of fixed length
        yield made(f"{name}_fixed.h5", attributes(data=X / G, **{name: np.bytes_("m/s**2" if name == "units" else "g  ")})), [], \
            1 / G if name == "units" else 1.0
    yield made("unit_array.h5", attributes(data=X / G, units=np.array([b"g"]))), [], 1.0
    yield made("packed.h5", attributes(data=np.round(X * 1e4 - 500).astype("i4"), scale_factor=1e-4, add_offset=0.05)), [], 1.0
    yield made("contradiction.h5", attributes(unit="g", units="m/s^2")), [], "unit"
    yield made("velocity.h5", attributes(units="mm/s")), [], "mm/s"

    rate = ["--sampling-Hz", "5120"]
    yield made("float32.h5", lambda f: f.create_dataset("sensor", data=X.astype("f4"))), rate, 1.0
    yield made("integers.h5", lambda f: (f.create_dataset("sensor", data=X / 2).attrs.create("scale", 2),
                                         f.attrs.create("sampling_Hz", 5120))), [], 1.0
    # Links out of the file are refused by name and not opened; opening a pipe would block.
    os.mkfifo(folder / "pipe.h5")
    outside, raw = h5py.ExternalLink(folder / "pipe.h5", "/sensor"), [("/etc/passwd", 0, 24)]
    yield made("link.h5", lambda f: f.update(sensor=outside)), \
        [*rate, "--sensor", "sensor"], "sensor is stored in another file"
    yield made("raw.h5", lambda f: f.create_dataset("sensor", (3,), "f8", external=raw)), \
        [*rate, "--sensor", "sensor"], "sensor is stored in another file"
    group = made("group.h5", lambda f: f.update(x=X, signals=outside, sensor=h5py.SoftLink("/x")))
    yield group, rate, 1.0
    yield group, [*rate, "--sensor", "signals"], "signals is stored in another file"
    yield group, [*rate, "--sensor", "none"], "signals (in another file)"
    # Tables of rows: fields are columns, and fields of several values, as pandas writes them, are matrices.
    rows = np.rec.fromarrays([T, X, np.stack([0 * X, X], 1)], dtype=[("time", "f8"), ("sensor", "f4"), ("values_block_0", "f8", 2)])
    table = made("rows.h5", lambda f: f.create_dataset("df/table", data=rows, chunks=True, compression=4))
    yield table, [], 1.0
    yield table, ["--sensor", "df/table/values_block_0:2"], 1.0
    yield table, ["--sensor", "values_block_0"], "df/table/values_block_0 is a matrix of 5120 x 2; choose one"
    yield table, ["--sensor", "none"], "df/table/sensor (5120)"
    yield made("unused.h5", lambda f: f.update(sensor=X, RPM=60 + 0 * X)), ["--sampling-Hz", "3000"], \
        "column RPM is not used: name it speed_rpm"
    yield made("big_endian.h5", lambda f: f.create_dataset("sensor", data=X.astype(">f8"))), rate, 1.0


@case
def mat_files(folder):
    def made(name, values):
        scipy.io.savemat(folder / name, values)
        return name

    rate = {"sampling_Hz": RATE}
    yield made("vector.mat", {"sensor": X, **rate}), [], 1.0
    yield made("column.mat", {"sensor": X[:, None], **rate}), [], 1.0
    chosen = made("chosen.mat", {"data": np.stack([0 * X, X], 1), "fs": RATE})
    yield chosen, ["--sensor", "data:2"], 1.0
    yield chosen, ["--sensor", "data"], "data is a matrix of 5120 x 2; choose one"
    yield chosen, ["--sensor", "data:3"], "data has 2 columns, counted from 1"
    yield chosen, ["--sensor", "none"], "data (5120 x 2; data:1 to data:2), fs (1 x 1)"
    yield made("struct.mat", {"s": {"sensor": X}, **rate}), ["--sensor", "s.sensor"], 1.0
    yield made("int.mat", {"sensor": np.round(X * 1e4).astype("i2"), **rate}), [], 1e4


def wav16(values, rate):
    """A sound file of one channel; a value of 1 is the full scale."""
    with io.BytesIO() as stream:
        with wave.open(stream, "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(rate)
            file.writeframes(np.round(values * 2**15).astype("<i2").tobytes())
        return stream.getvalue()


@case
def sound_files(folder):
    share = X / 16
    write(folder, "pcm16.wav", wav16(share, 5120))
    yield "pcm16.wav", [], 1 / 16
    for name in ("a.WAV", "a.csv", "a.h5", "a"):  # the content decides
        yield write(folder, name, wav16(share, 5120)), [], 1 / 16


@case
def other_formats(folder):
    yield write(folder, "a.h5", "time,sensor\n0,1\n"), [], "a.h5"
    yield write(folder, "book.xlsx", b"PK\x03\x04" + bytes(100)), [], "book.xlsx"
    yield write(folder, "book.csv", b"PK\x03\x04" + bytes(100)), [], "ZIP"
    np.save(folder / "array.npy", X)
    yield "array.npy", [], "NumPy"
    yield write(folder, "old.xls", bytes.fromhex("d0cf11e0a1b11ae1") + bytes(600)), [], "old.xls"
    yield write(folder, "empty.csv", ""), [], "empty"
    yield write(folder, "t.parquet", b"PAR1" + bytes(50) + b"PAR1"), [], "Parquet"
    yield write(folder, "m.mf4", b"MDF     4.10    " + bytes(200)), [], "MDF"
    for name, data in (("b.xlsx", b"PK\x03\x04"), ("b.csv", b"PK\x03\x04"), ("page.csv", "<!DOCTYPE html>"), ("b.npy", b"\x93NUMPY"),
                       ("b.xyz", "sensor\n1\n2\n")):
        yield write(folder, name, data), [], f"{name}: is not a file that gearpod reads"
        yield name, [], "asammdf"  # a program that converts others
    yield write(folder, "b.tdms", "sensor\n1\n2\n"), [], "b.tdms: is damaged or truncated in the segment at byte 0"


def dataset_58(title="NONE", binary="", function=1, direction=0, kind=2, count=4, spacing=1, abscissa=17, quantity=12, start=0.0,
               step=0.5, abscissa_unit="s", unit="g", denominator="NONE", denominator_kind=0,
               data="  1.00000e+00 -2.00000e+00  3.50000e+00  4.00000e+00\n"):
    axis = lambda kind, unit: f"{kind:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {unit:20s}\n"
    return (f"    -1\n    58{binary}\n{title}\nNONE\nNONE\nNONE\nNONE\n"
            f"{function:5d}{1:10d}{1:5d}{0:10d} {'NONE':10s}{1:10d}{direction:4d} {'NONE':10s}{0:10d}{0:4d}\n"
            f"{kind:10d}{count:10d}{spacing:10d}{start:13.5e}{step:13.5e}{0:13.5e}\n" + axis(abscissa, abscissa_unit) +
            axis(quantity, unit) + axis(denominator_kind, denominator) + axis(0, "NONE") + data + "    -1\n")


def uff58(values, per_line=4, exponent="E", times=None, kind=4, **fields):
    """Dataset 58 as text: a time history, evenly spaced or with the times of its values."""
    width, digits = (20, 12) if kind == 4 else (13, 5)
    texts = [f"{v:{width}.{digits - 1}E}".replace("E", exponent) for v in values]
    if times is not None:
        texts = [text for pair in zip((f"{v:20.13E}" for v in times), texts) for text in pair]
    data = "".join("".join(texts[i:i + per_line]) + "\n" for i in range(0, len(texts), per_line))
    return dataset_58(kind=kind, count=len(values), spacing=int(times is None), data=data,
                      **{"unit": "m/s^2", "step": 1 / RATE, **fields})


def uff164(length):
    """Dataset 164: the unit of length is that many times smaller than the metre."""
    return "\n".join(["    -1", "   164", f"{10:10d}{'user defined':20s}{2:10d}",
                      f"{length:25.17E}{1:25.17E}{1:25.17E}".replace("E", "D"), f"{0:25.17E}".replace("E", "D"), "    -1", ""])


@case
def universal_files(folder):
    w = lambda name, text: write(folder, name, text)
    yield w("plain.uff", uff58(X)), [], 1.0
    yield w("single.unv", uff58(X, 6, kind=2)), [], 1.0
    yield w("g.uff", uff58(X / G, unit="g")), [], 1.0
    yield w("millimetres.uff", uff164(1000.0) + uff58(1e3 * X, unit="NONE")), [], 1.0
    yield w("velocity.uff", uff58(X, quantity=11, unit="m/s")), [], "velocity"
    yield w("force.uff", uff58(X, quantity=9, unit="N")), [], "force"
    frf = uff58(X, function=4)
    yield w("frf_too.uff", frf + uff58(X)), [], 1.0
    yield w("frf.uff", frf), [], "frequency response"
    for name, unit, expected in (("label", "mm/s^2", 1.0), ("gravity", "g", "g by the function's label, but mm/s^2 by dataset 164"),
                                 ("metre_label", "m/s^2", "m/s^2 by the function's label, but mm/s^2 by dataset 164")):
        yield w(f"{name}.uff", uff164(1000.0) + uff58(1e3 * X, unit=unit)), [], expected
    titles = w("titles.uff", uff58(X[::-1], title="title") + uff58(X, title="Mic"))
    yield titles, ["--sensor", "Mic"], 1.0
    yield titles, ["--sensor", "none"], "function1 (title), function2 (Mic)"
    # Stored times belong to the column in use.
    with_times = lambda times, title: uff58(X, title=title, times=times)
    yield w("times.uff", with_times(2 * T, "Mic") + with_times(T, "rear")), ["--sensor", "rear"], 1.0
    yield w("two_times.uff", with_times(T, "sensor") + with_times(2 * T, "te")), [], "has other times than the first column"
    yield w("even_times.uff", with_times(2 * T, "Mic") + uff58(X, title="rear")), ["--sensor", "rear"], 1.0


class TdmsBytes:
    """Writes TDMS segments in one byte order."""

    META, NEW, RAW, INTERLEAVED, BIG = 2, 4, 8, 32, 64
    ALL = META | NEW | RAW
    NO_INDEX, SAME_INDEX = 0xFFFFFFFF, 0

    def __init__(self, big=False):
        self.order = ">" if big else "<"

    def pack(self, form, *values):
        return struct.pack(self.order + form, *values)

    def text(self, text):
        return self.pack("I", len(text.encode())) + text.encode()

    def properties(self, entries):
        data = self.pack("I", len(entries))
        for name, value in entries.items():
            data += self.text(name)
            data += self.pack("I", 0x20) + self.text(value) if isinstance(value, str) else \
                self.pack("II", 7, value) if isinstance(value, int) else \
                self.pack("IqQ", 0x44, value[0], value[1]) if isinstance(value, tuple) and self.order == ">" else \
                self.pack("IQq", 0x44, value[1], value[0]) if isinstance(value, tuple) else self.pack("Id", 10, value)
        return data

    def index(self, kind, count, size=None):
        return self.pack("IIIQ", 20, kind, 1, count) + (b"" if size is None else self.pack("Q", size))

    def segment(self, contents, objects, raw, closed=True):
        """`objects`: path, raw data index, properties."""
        meta = b""
        if contents & self.META:
            meta = self.pack("I", len(objects))
            for path, index, *entries in objects:
                meta += self.text(path) + (self.pack("I", index) if isinstance(index, int) else index)
                meta += self.properties(entries[0] if entries else {})
        head = b"TDSm" + struct.pack("<I", contents | (self.BIG if self.order == ">" else 0))
        return head + self.pack("IQQ", 4713, len(meta) + len(raw) if closed else 2**64 - 1, len(meta)) + meta + raw


def tdms(channels, properties):
    """A TDMS file: channels by path, in two segments of which only the first has metadata."""
    to = TdmsBytes()
    groups = sorted({path.rpartition("/")[0] for path in channels})
    objects = [(name, to.NO_INDEX) for name in ("/", *groups)]
    objects += [(path, to.index(10, len(values) // 2), properties.get(path, {})) for path, values in channels.items()]
    first, second = (b"".join(np.split(values, 2)[half].tobytes() for values in channels.values()) for half in (0, 1))
    return to.segment(to.ALL, objects, first) + to.segment(to.RAW, [], second)


@case
def tdms_files(folder):
    sensor = "/'Vibration'/'sensor'"
    rate = {"wf_increment": 1 / RATE, "unit_string": "m/s^2"}
    w = lambda name, *made: write(folder, name, tdms(*made))
    yield w("plain.tdms", {sensor: X}, {sensor: rate}), [], 1.0
    yield w("g.tdms", {sensor: X / G}, {sensor: {**rate, "unit_string": "g"}}), [], 1.0
    yield w("two.tdms", {"/'Vibration'/'other'": X[::-1].copy(), sensor: X}, {sensor: rate}), [], 1.0
    yield w("path.tdms", {"/'A'/'sensor'": 0 * X, "/'B'/'sensor'": X}, {"/'B'/'sensor'": rate}), ["--sensor", "B/sensor"], 1.0
    yield w("both.tdms", {"/'A'/'sensor'": 0 * X, "/'B'/'sensor'": X}, {"/'B'/'sensor'": rate}), [], "B/sensor"
    quoted = {"/'it''s'/'a'": 0 * X, "/'h'/'a'": X, "/'h'/'b'": X[::-1].copy()}
    three = w("three.tdms", quoted, {path: rate for path in quoted})
    yield three, ["--sensor", "a"], "several columns are named a: it's/a, h/a"
    yield three, ["--sensor", "h/a"], 1.0
    yield three, ["--sensor", "c"], "it's/a"
    te = "/'Vibration'/'te'"
    for name, other, refusal in (("steps", {"wf_increment": 0.5}, "have different time steps, 0.000195313 s and 0.5 s"),
                                 ("starts", {**rate, "wf_start_offset": 1.0}, "start at different times, 1 s apart")):
        sampled = {sensor: {"wf_start_offset": 0.0, **rate}, te: other}
        yield w(f"{name}.tdms", {sensor: X, te: X}, sampled), [], refusal
        # A column that is not in use does not matter.
        yield w(f"unused_{name}.tdms", {sensor: X, te.replace("te", "x"): X}, {**sampled, te.replace("te", "x"): other}), [], 1.0
    yield write(folder, "cut.tdms", tdms({sensor: X}, {sensor: rate})[:1000]), [], "cut.tdms"
