"""Recordings as recorders, spreadsheets and libraries write them: one signal in many files, with the right answer for each.

Every function that is decorated with `case` writes files into a folder and yields tuples: name of the file, arguments,
expected answer. Answers: a factor on the signal (1.0: read in m/s^2), or a text that the refusal must contain."""

import gzip
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
    yield table("float32_shortest.csv", [str(v) for v in (64 + T).astype(np.float32)]), [], 1.0
    yield table("six_digits.csv", numbers(9.6 + T, "%.6g")), [], 1.0
    yield table("epoch.csv", numbers(1.7e9 + T, "%.6f")), [], 1.0
    yield table("epoch_ms.csv", numbers((1.7e9 + T) * 1e3, "%.3f"), "ms"), [], 1.0
    yield table("exponents.csv", numbers(T, "%.7e")), [], 1.0
    lost = np.delete(np.arange(X.size + 3), [2000, 2001, 2002]) / RATE
    yield table("lost.csv", numbers(lost)), [], "column time"
    yield table("one_lost_float32.csv", numbers((64 + np.delete(np.arange(X.size + 1), 2000) / RATE).astype(np.float32), "%.9g")), \
        [], "column time"
    yield table("too_coarse.csv", numbers(T, "%.3f")), [], "time"
    yield table("twice.csv", numbers(np.where(T == T[3000], T[2999], T))), [], "time"


@case
def csv_dialects(folder):
    x, t = numbers(X, "%.4f"), numbers(T)
    xc, tc = numbers(X, "%.4f", True), numbers(T, comma=True)
    index = [str(i) for i in range(X.size)]
    head = "time [s],sensor [m/s^2]\n"
    plain = head + rows(t, x)
    rate = ["--sampling-Hz", "5120"]
    w = lambda name, text, encoding="utf-8": write(folder, name, text, encoding)
    yield w("plain.csv", plain), [], 1.0
    yield w("bom.csv", plain, "utf-8-sig"), [], 1.0
    yield w("crlf.csv", plain.replace("\n", "\r\n")), [], 1.0
    yield w("no_last_end.csv", plain.rstrip("\n")), [], 1.0
    yield w("blank_lines.csv", "\n" + plain + "\n\n"), [], 1.0
    yield w("pandas.csv", ",time [s],sensor [m/s^2]\n" + rows(index, t, x)), [], 1.0
    yield w("r.csv", '"","time [s]","sensor [m/s^2]"\n' + rows([f'"{i}"' for i in index], t, x)), [], 1.0
    yield w("r_table.csv", '"time [s]","sensor [m/s^2]"\n' + rows([f'"{i}"' for i in index], t, x)), [], 1.0
    yield w("sep.csv", "sep=;\ntime [s];sensor [m/s^2]\n" + rows(t, x, separator=";")), [], 1.0
    yield w("sep_comma.csv", "sep=;\ntime [s];sensor [m/s^2]\n" + rows(tc, xc, separator=";")), [], 1.0
    yield w("semicolon.csv", "time [s];sensor [m/s^2]\n" + rows(tc, xc, separator=";")), [], 1.0
    yield w("tab.csv", "time [s]\tsensor [m/s^2]\n" + rows(tc, xc, separator="\t")), [], 1.0
    yield w("blanks.csv", "time [s] , sensor [m/s^2]\n" + rows(t, x, separator=" , ")), [], 1.0
    yield w("trailing.csv", "time [s],sensor [m/s^2],\n" + rows(t, x, end=",\n")), [], 1.0
    yield w("trailing_rows.csv", head + rows(t, x, end=",\n")), [], 1.0
    yield w("trailing_tab.csv", "time [s]\tsensor [m/s^2]\t\n" + rows(t, x, separator="\t", end="\t\n")), [], 1.0
    yield w("quoted_commas.csv", head + rows([f'"{v}"' for v in tc], [f'"{v}"' for v in xc])), [], 1.0
    yield w("one_column.csv", "sensor [m/s^2]\n" + rows(xc)), rate, 1.0
    yield w("one_column_point.csv", "sensor [m/s^2]\n" + rows(x)), rate, 1.0
    yield w("units_row.csv", "time,sensor\ns,g\n" + rows(t, numbers(X / G))), [], 1.0
    yield w("units_row_brackets.csv", "time,sensor\n[s],[g]\n" + rows(t, numbers(X / G))), [], 1.0
    yield w("units_row_unknown.csv", "time,sensor\ns,furlong/s^2\n" + rows(t, x)), [], "furlong"
    yield w("preamble.csv", "Title:\tGear 30-2\nRate:\t5120\nChannels:\t2\n\ntime [s]\tsensor [m/s^2]\t\n" +
            rows(t, x, separator="\t", end="\t\n")), [], 1.0
    yield w("preamble_comma.csv", "Recorder,X7\nDate,2024-03-01\n" + plain), [], 1.0
    yield w("comments.csv", "# recorder X7\n" + plain), [], 1.0
    yield w("label.csv", "time [s],sensor [m/s^2],label\n" + rows(t, x, ["healthy"] * X.size)), [], 1.0
    yield w("stamp.csv", "stamp,time [s],sensor [m/s^2]\n" + rows(["2024-03-01 12:00:00"] * X.size, t, x)), [], 1.0
    yield w("empty_other.csv", "time [s],sensor [m/s^2],rpm\n" + rows(t, x, [""] * X.size)), [], 1.0
    yield w("utf16.csv", plain, "utf-16"), [], 1.0
    yield w("gap.csv", head + rows(t, ["" if i == 700 else v for i, v in enumerate(x)])), [], "702"
    yield w("missing.csv", head + rows(t, ["NA" if i == 700 else v for i, v in enumerate(x)])), [], "702"
    yield w("short_row.csv", plain.replace("\n" + t[900] + "," + x[900], "\n" + t[900])), [], "902"
    yield w("two_sensors.csv", "time [s],sensor [m/s^2],sensor [g]\n" + rows(t, x, x)), [], "sensor"
    (folder / "zipped.csv.gz").write_bytes(gzip.compress(plain.encode()))
    yield "zipped.csv.gz", [], 1.0


@case
def hdf5_files(folder):
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
    yield made("units.h5", attributes(data=X / G, units="g")), [], 1.0
    yield made("units_fixed.h5", attributes(data=X / G, units=np.bytes_("g"))), [], 1.0
    yield made("unit_array.h5", attributes(data=X / G, units=np.array([b"g"]))), [], 1.0
    yield made("scaled.h5", attributes(data=np.round(X * 1e4).astype("i4"), scale=1e-4)), [], 1.0
    yield made("scale_factor.h5", attributes(data=np.round(X * 1e4).astype("i4"), scale_factor=1e-4)), [], 1.0
    yield made("offset.h5", attributes(data=X - 3, add_offset=3.0)), [], 1.0
    yield made("packed.h5", attributes(data=np.round(X * 1e4 - 500).astype("i4"), scale_factor=1e-4, add_offset=0.05)), [], 1.0
    yield made("contradiction.h5", attributes(unit="g", units="m/s^2")), [], "unit"
    yield made("velocity.h5", attributes(units="mm/s")), [], "mm/s"

    def nested(file):
        d = file.create_dataset("run1/accelerometers/sensor", data=X)
        file.create_dataset("run1/speed/counts", data=np.arange(5))
        d.attrs["units"] = "m/s^2"

    rate = ["--sampling-Hz", "5120"]
    yield made("nested.h5", nested), [*rate, "--sensor", "run1/accelerometers/sensor"], 1.0
    yield made("nested_list.h5", nested), [*rate, "--sensor", "vibration"], "run1/accelerometers/sensor"
    yield made("column.h5", lambda f: f.create_dataset("sensor", data=X[:, None])), rate, 1.0
    yield made("row.h5", lambda f: f.create_dataset("sensor", data=X[None, :])), rate, 1.0
    yield made("matrix.h5", lambda f: f.create_dataset("data", data=np.stack([X, 0 * X], 1))), [*rate, "--sensor", "data:1"], 1.0
    yield made("matrix_list.h5", lambda f: f.create_dataset("data", data=np.stack([X, 0 * X], 1))), rate, "data"
    yield made("float32.h5", lambda f: f.create_dataset("sensor", data=X.astype("f4"))), rate, 1.0
    yield made("big_endian.h5", lambda f: f.create_dataset("sensor", data=X.astype(">f8"))), rate, 1.0

    def many(file):
        for i in range(20000):
            file.create_dataset(f"d{i}", data=0.0)
        file["sensor"] = X

    yield made("many.h5", many, libver="latest"), rate, 1.0

    def others(file):
        file["sensor"] = X
        file["label"] = "healthy"
        file.create_dataset("table", data=np.zeros(3, dtype=[("a", "f8"), ("b", "i4")]))

    yield made("others.h5", others), rate, 1.0


@case
def mat_files(folder):
    def made(name, values, **options):
        scipy.io.savemat(folder / name, values, **options)
        return name

    rate = {"sampling_Hz": RATE}
    yield made("vector.mat", {"sensor": X, **rate}), [], 1.0
    yield made("column.mat", {"sensor": X[:, None], **rate}), [], 1.0
    yield made("matrix.mat", {"data": np.stack([X, 0 * X], 1), **rate}), ["--sensor", "data:1"], 1.0
    yield made("matrix_list.mat", {"data": np.stack([X, 0 * X], 1), **rate}), [], "data"
    yield made("struct.mat", {"s": {"sensor": X}, **rate}), ["--sensor", "s.sensor"], 1.0
    yield made("structs.mat", {"run": {"a": {"sensor": X}}, **rate}), ["--sensor", "run.a.sensor"], 1.0
    yield made("int.mat", {"sensor": np.round(X * 1e4).astype("i2"), **rate}), [], 1e4
    yield made("packed.mat", {"sensor": X, **rate}, do_compression=True), [], 1.0
    yield made("four.mat", {"sensor": X, **rate}, format="4"), [], 1.0
    yield made("text.mat", {"sensor": X, "note": "healthy", **rate}), [], 1.0
    first, second = (folder / n for n in (made("a.mat", {"sensor": 0 * X, **rate}), made("b.mat", {"sensor": X})))
    (folder / "twice.mat").write_bytes(first.read_bytes() + second.read_bytes()[128:])
    yield "twice.mat", [], (1.0, "sensor")


@case
def sound_files(folder):
    share = X / 16
    with wave.open(str(folder / "pcm16.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(5120)
        file.writeframes(np.round(share * 2**15).astype("<i2").tobytes())
    yield "pcm16.wav", [], 1 / 16
    data = np.round(share * 2**15).astype("<i2").tobytes()
    form = struct.pack("<HHIIHH", 1, 1, 5120, 10240, 2, 16)
    ds64 = struct.pack("<QQQI", 4 + 36 + 24 + 8 + len(data), len(data), X.size, 0)
    rf64 = b"RF64\xff\xff\xff\xffWAVEds64" + struct.pack("<I", len(ds64)) + ds64 + b"fmt " + struct.pack("<I", 16) + form + \
        b"data\xff\xff\xff\xff" + data
    yield write(folder, "rf64.wav", rf64), [], 1 / 16
    yield write(folder, "cut.wav", (folder / "pcm16.wav").read_bytes()[:3000]), [], "cut.wav"


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


def uff58(values, per_line=4, exponent="E", unit="m/s^2", kind=12, function=1, form=4, step=1 / RATE):
    """Dataset 58 of a universal file, as text: a time history, evenly spaced."""
    lines = ["    -1", "    58", "gear", "NONE", "NONE", "NONE", "NONE",
             f"{function:5d}{0:10d}{0:5d}{0:10d} {'NONE':10s}{1:10d}{3:4d} {'NONE':10s}{0:10d}{0:4d}",
             f"{form:10d}{len(values):10d}{1:10d}{0:13.5E}{step:13.5E}{0:13.5E}",
             f"{17:10d}{0:5d}{0:5d}{0:5d} {'Time':20s} {'s':20s}",
             f"{kind:10d}{0:5d}{0:5d}{0:5d} {'Acceleration':20s} {unit:20s}",
             *[f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':20s} {'NONE':20s}"] * 2]
    width, digits = (20, 12) if form == 4 else (13, 5)
    texts = [f"{v:{width}.{digits - 1}E}".replace("E", exponent) for v in values]
    lines += ["".join(texts[i:i + per_line]) for i in range(0, len(texts), per_line)]
    return "\n".join([*lines, "    -1", ""])


def uff164(length):
    """Dataset 164: the unit of length is that many times smaller than the metre."""
    return "\n".join(["    -1", "   164", f"{10:10d}{'user defined':20s}{2:10d}",
                      f"{length:25.17E}{1:25.17E}{1:25.17E}".replace("E", "D"), f"{0:25.17E}".replace("E", "D"), "    -1", ""])


@case
def universal_files(folder):
    w = lambda name, text: write(folder, name, text)
    yield w("plain.uff", uff58(X)), [], 1.0
    yield w("single.unv", uff58(X, 6, form=2)), [], 1.0
    yield w("d.uff", uff58(X, exponent="D")), [], 1.0
    yield w("lower_d.uff", uff58(X, exponent="d")), [], 1.0
    yield w("g.uff", uff58(X / G, unit="g")), [], 1.0
    yield w("metres.uff", uff164(1.0) + uff58(X, unit="NONE")), [], 1.0
    yield w("millimetres.uff", uff164(1000.0) + uff58(1e3 * X, unit="NONE")), [], 1.0
    yield w("velocity.uff", uff58(X, kind=11, unit="m/s")), [], "velocity"
    yield w("force.uff", uff58(X, kind=9, unit="N")), [], "force"
    frf = uff58(X, function=4)
    yield w("frf_too.uff", frf + uff58(X)), [], 1.0
    yield w("frf.uff", frf), [], "frequency response"


def tdms(channels, properties, segments=2):
    """A TDMS file: channels by path, in segments of which only the first has metadata."""
    text = lambda s: struct.pack("<I", len(s.encode())) + s.encode()

    def listed(entries):
        out = struct.pack("<I", len(entries))
        for name, value in entries.items():
            out += text(name) + (struct.pack("<I", 0x20) + text(value) if isinstance(value, str)
                                 else struct.pack("<Id", 10, value))
        return out

    groups = sorted({path.rpartition("/")[0] for path in channels})
    count = {path: len(values) // segments for path, values in channels.items()}
    meta = struct.pack("<I", 1 + len(groups) + len(channels)) + text("/") + struct.pack("<II", 0xFFFFFFFF, 0)
    for group in groups:
        meta += text(group) + struct.pack("<II", 0xFFFFFFFF, 0)
    for path, values in channels.items():
        kind = {"f8": 10, "f4": 9, "i2": 2, "i4": 3}[values.dtype.str[1:]]
        meta += text(path) + struct.pack("<IIIQ", 20, kind, 1, count[path]) + listed(properties.get(path, {}))
    out = b""
    for k in range(segments):
        raw = b"".join(v[k * count[p]:(k + 1) * count[p]].tobytes() for p, v in channels.items())
        head, mask = (meta, 2 | 4 | 8) if k == 0 else (b"", 8)
        out += b"TDSm" + struct.pack("<IIQQ", mask, 4713, len(head) + len(raw), len(head)) + head + raw
    return out


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
    yield w("float.tdms", {sensor: X.astype("f4")}, {sensor: rate}), [], 1.0
    scale = {**rate, "NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 1.0, "NI_Scale[0]_Scale_Type": "Linear",
             "NI_Scale[0]_Linear_Slope": 1e-4, "NI_Scale[0]_Linear_Y_Intercept": 0.0}
    yield w("scaled.tdms", {sensor: np.round(X * 1e4).astype("i4")}, {sensor: scale}), [], 1.0
    yield write(folder, "cut.tdms", tdms({sensor: X}, {sensor: rate})[:1000]), [], "cut.tdms"
