#!/usr/bin/env python3
"""Checks the reader of other programs' recordings (analysis/python/gearpod/signal_files.py). Usage: test_signal_files.py SOURCES

Files are written from the formats' specifications, or by scipy, h5py and soundfile. Every value read must equal the value
written."""

import json
import pathlib
import random
import struct
import sys
import tempfile
import unittest

try:
    import h5py
    import numpy as np
    import scipy.io
    import soundfile
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(sys.argv.pop(1)) / "analysis/python/gearpod"))
sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "recordings"))
import signal_files  # noqa: E402
from written_recordings import TdmsBytes, dataset_58, uff164, uff58  # noqa: E402

signal_files.load_libraries()

SIX = np.array([1.0, -2.0, 3.0, -4.0, 5.0, -6.0])
SINES = 30 * np.sin(0.37 * np.arange(1001))


class Case(unittest.TestCase):
    kind = ""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "a"

    def read(self, data=None):
        """The recording, and its channels by name."""
        if data is not None:
            self.path.write_bytes(data.encode("latin-1") if isinstance(data, str) else data)
        recording = signal_files.READERS[self.kind](str(self.path))
        return recording, {channel.name: channel for channel in recording.channels}

    def values(self, name, data=None):
        return np.asarray(self.read(data)[1][name].values).tolist()

    def refused(self, words, data=None):
        with self.assertRaises(signal_files.Refusal) as caught:
            self.read(data)
        self.assertIn(words, str(caught.exception))


class MatFiles(Case):
    kind = "mat"

    def saved(self, values, **options):
        scipy.io.savemat(self.path, values, appendmat=False, **options)
        return self.read()[1]

    def test_structs_cells_and_matrices(self):
        structs = np.zeros((1, 2), dtype=[("Name", object), ("Data", object)])
        structs[0, 0], structs[0, 1] = ("force", 7 * SIX), ("vibration", SIX)
        cell = np.empty((1, 2), dtype=object)
        cell[0, 0], cell[0, 1] = 8 * SIX, SIX
        for options in ({}, {"do_compression": True}):
            channels = self.saved({"run": {"acc": {"sensor": SIX, "time": SIX[:, None]}, "Fs": 5120.0}, "Y": structs, "c": cell,
                                   "data": SIX.reshape(3, 2), "wide": SIX.reshape(2, 3)}, **options)
            for name in ("run.acc.sensor", "run.acc.time", "Y(2).Data", "c{2}"):
                self.assertEqual(channels[name].values.tolist(), SIX.tolist(), name)
            self.assertEqual(channels["run.Fs"].values.tolist(), [5120.0])
            self.assertEqual(channels["data"].values.tolist(), [[1, 3, 5], [-2, -4, -6]])
            self.assertEqual(channels["wide"].values.tolist(), SIX.reshape(2, 3).tolist())
            self.assertEqual(channels["data"].text, "data (3 x 2; data:1 to data:2)")
            self.assertIn("data is a matrix of 3 x 2; choose one of its columns", channels["data"].problem)
            self.assertEqual(channels["Y(1).Name"].problem, "Y(1).Name (text) is not a column of numbers")

    def test_all_number_classes_of_all_versions(self):
        for kind in ("f8", "f4", "i8", "u8", "i4", "u4", "i2", "u2", "i1", "u1"):
            values = np.array([3, 5, 120 if kind[0] == "u" else -120]).astype(kind)
            for options in ({"format": "5"},) if kind in ("i8", "u8", "i1", "u4") else ({"format": "5"}, {"format": "4"}):
                self.assertEqual(self.saved({"a": values}, **options)["a"].values.tolist(), values.tolist(), kind)

    def test_units_next_to_a_column(self):
        channels = self.saved({"sensor": SIX, "sensor_unit": "g", "s": {"data": SIX, "units": "mm/s^2"},
                               "t": {"a": SIX, "b": SIX, "unit": "V"}})
        self.assertEqual([channels[name].unit for name in ("sensor", "s.data", "t.a")], ["g", "mm/s^2", ""])
        self.assertEqual(channels["t.a"].note, "t.unit = V is not used, because it may belong to several columns")

    def test_the_last_variable_of_a_name_counts(self):
        self.saved({"sensor": 0 * SIX, "te": SIX})
        first = self.path.read_bytes()
        self.saved({"sensor": SIX})
        channels = self.read(first + self.path.read_bytes()[128:])[1]
        self.assertEqual(channels["sensor"].values.tolist(), SIX.tolist())
        self.assertIn("the variable sensor occurs more than once; the last one is used", channels["sensor"].note)
        self.assertEqual(channels["te"].note, "")

    def test_arrays_that_are_no_columns(self):
        channels = self.saved({"z": SIX + 1j, "s": scipy.sparse.eye(4), "square": np.eye(3), "empty": []})
        self.assertIn("z is complex", channels["z"].problem)
        self.assertIn("s is a sparse matrix", channels["s"].problem)
        self.assertIn("square has the shape 3 x 3", channels["square"].problem)
        self.assertIn("a column must be a vector", channels["empty"].problem)

    def version_73(self, fill):
        with h5py.File(self.path, "w", userblock_size=512) as file:
            fill(file)
        with open(self.path, "r+b") as file:
            file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
        return self.read()

    def test_version_73(self):
        def put(group, name, values, kind="double", **attributes):
            item = group.create_dataset(name, data=values)
            for key, value in {"MATLAB_class": np.bytes_(kind), **attributes}.items():
                item.attrs[key] = value
            return item

        def fill(file):
            run = file.create_group("run")
            run.attrs["MATLAB_class"] = np.bytes_("struct")
            put(run, "sensor", SIX[:, None])
            put(file, "count", np.array([[3]], "i2"), "int16")
            put(file, "word", np.array([[ord(c)] for c in "hello"], "u2"), "char", MATLAB_int_decode=2)
            put(file, "data", SIX.reshape(2, 3))  # 3 x 2 in MATLAB
            put(file, "z", np.zeros(3, dtype=[("real", "f8"), ("imag", "f8")]))
            parts = [put(file, f"#refs#/{i}", (i + 1) * SIX[:, None]) for i in range(2)]
            put(file, "c", np.array([p.ref for p in parts], dtype=h5py.ref_dtype)[:, None], "cell")
            many = file.create_group("Y")
            many.attrs["MATLAB_class"] = np.bytes_("struct")
            many.create_dataset("Data", data=np.array([p.ref for p in parts], dtype=h5py.ref_dtype)[:, None])
            put(file, "T", np.array([[0xDD000000, 2, 1]], "u4"), "table", MATLAB_object_decode=3)
            put(file, "none", np.array([0, 0], "u8"), "double", MATLAB_empty=1)
            file["outside"] = h5py.ExternalLink("/dev/zero", "/sensor")

        channels = self.version_73(fill)[1]
        self.assertEqual(channels["run.sensor"].values.tolist(), SIX.tolist())
        self.assertEqual(channels["count"].values.tolist(), [3])
        self.assertEqual(channels["data"].text, "data (3 x 2; data:1 to data:2)")
        self.assertEqual(channels["data"].values.tolist(), SIX.reshape(2, 3).tolist())
        for name in ("c{2}", "Y(2).Data"):
            self.assertEqual(channels[name].values.tolist(), (2 * SIX).tolist())
        for name, words in (("T", "table2struct"), ("z", "is complex"), ("word", "word (text) is not"), ("none", "the shape 0 x 0"),
                            ("outside", "stored in another file")):
            self.assertIn(words, channels[name].problem)
        with self.assertRaisesRegex(signal_files.Refusal, "T is a table, timetable or object"):
            self.version_73(lambda file: put(file, "T", np.zeros(3, "u4"), "table", MATLAB_object_decode=3))

    def test_damage(self):
        for compressed in (False, True):
            self.saved({"sensor": SINES, "te": SINES}, do_compression=compressed)
            whole = self.path.read_bytes()
            for share in (0.3, 0.6, 0.9, 0.999):
                self.refused("or is damaged (OSError: could not read bytes)", whole[:int(share * len(whole))])
        self.refused("begins with zeros", bytes(300))
        self.refused("is not a MAT file, or is damaged", 200 * b"\x01")


class SoundFiles(Case):
    kind = "sound"

    def written(self, form, subtype, values, channels=1):
        soundfile.write(self.path, values.reshape(-1, channels), 25600, format=form, subtype=subtype)
        return self.path.read_bytes()

    def test_integers_are_fractions_of_the_full_scale(self):
        for subtype, bits in (("PCM_U8", 8), ("PCM_16", 16), ("PCM_24", 24), ("PCM_32", 32)):
            whole = np.round(2.0 ** (bits - 1) * 0.03 * SINES)
            shifted = (whole.astype("i8") << (32 - bits)).astype("i4")
            self.written("WAV", subtype, shifted)
            self.assertEqual(self.values("sensor"), (whole * 2.0 ** (1 - bits)).tolist(), subtype)
        self.written("WAV", "DOUBLE", SINES)
        self.assertEqual(self.values("sensor"), SINES.tolist())

    def test_containers_give_the_same_values(self):
        values = (np.arange(10000) * 7919 - 30000).astype("i2")
        expected = (values / 32768.0).reshape(-1, 2)
        for form in ("WAV", "RF64", "W64", "FLAC", "AIFF", "AU", "CAF"):
            whole = self.written(form, "PCM_16", values, 2)
            channels = self.read()[1]
            self.assertEqual(list(channels), ["channel1", "channel2"], form)
            self.assertEqual(channels["channel2"].values.tolist(), expected[:, 1].tolist(), form)
            self.assertEqual(channels["channel1"].sampling_Hz, 25600.0)
            for share in (0.4, 0.99) if form in ("RF64", "W64", "FLAC", "AIFF") else ():
                with self.assertRaisesRegex(signal_files.Refusal, "is truncated|is damaged"):
                    self.read(whole[:int(share * len(whole))])

    def test_headers(self):
        wav = self.written("WAV", "PCM_16", 0.03 * SINES)
        at = wav.index(b"data") + 4

        def changed(position, data):
            return wav[:position] + data + wav[position + len(data):]

        self.refused("is truncated: 1002 bytes are missing", wav[:-1002])
        self.refused("is truncated", changed(at, b"\xf0\xff\xff\x7f"))
        self.refused("its header states no valid sampling rate", changed(24, bytes(4)))
        self.refused("damaged", changed(22, b"\xff\xff"))
        piped = changed(4, b"\xff" * 4)
        self.assertEqual(len(self.values("sensor", piped[:at] + b"\xff" * 4 + piped[at + 4:])), 1001)
        self.assertEqual(len(self.values("sensor", changed(34, b"\x0c"))), 1001)  # 12 bits in 16
        self.written("WAV", "IMA_ADPCM", 0.03 * SINES)
        self.refused("is compressed with loss (IMA ADPCM)")


class TdmsFiles(Case):
    kind = "tdms"
    A, B = "/'g'/'a'", "/'g'/'b'"

    def test_both_byte_orders(self):
        for big in (False, True):
            to = TdmsBytes(big)
            data = to.segment(to.ALL, [("/", to.NO_INDEX), ("/'V'", to.NO_INDEX),
                                       ("/'V'/'sensor'", to.index(10, 3), {"wf_increment": 1 / 1024, "wf_start_offset": 0.5,
                                                                           "unit_string": "g"})], to.pack("3d", 1, -2, 3))
            channel = self.read(data)[1]["V/sensor"]
            self.assertEqual(channel.values.tolist(), [1, -2, 3])
            self.assertEqual((channel.unit, channel.sampling_Hz, channel.start_s), ("g", 1024.0, 0.5))

    def test_segments_repeat_change_and_omit_indices(self):
        to, big = TdmsBytes(), TdmsBytes(True)
        words = "/'g'/'words'"
        text = lambda word: to.pack("II", 2, 5) + word
        data = to.segment(to.ALL, [(self.A, to.index(10, 2)), (words, to.pack("IIIQQ", 28, 0x20, 1, 2, 13)), (self.B, to.index(2, 1))],
                          to.pack("2d", 1, 2) + text(b"hello") + to.pack("h", -1) + to.pack("2d", 3, 4) + text(b"world") +
                          to.pack("h", 7))
        data += to.segment(to.RAW, [], to.pack("2d", 5, 6) + text(b"again") + to.pack("h", 8))
        data += big.segment(to.META | to.RAW, [(self.A, big.index(10, 1)), (words, to.NO_INDEX)], big.pack("dh", 7, -2))
        data += to.segment(to.ALL, [(self.B, to.SAME_INDEX)], to.pack("2h", 10, 11))
        channels = self.read(data)[1]
        self.assertEqual(list(channels), ["g/a", "g/b"])
        self.assertEqual(channels["g/a"].values.tolist(), [1, 2, 3, 4, 5, 6, 7])
        self.assertEqual(channels["g/b"].values.tolist(), [-1, 7, 8, -2, 10, 11])

    def test_interleaved_channels_and_all_integers(self):
        for big in (False, True):
            to = TdmsBytes(big)
            raw = b"".join(to.pack("if", i - 3, 0.5 * i) for i in range(6))
            channels = self.read(to.segment(to.ALL | to.INTERLEAVED, [(self.A, to.index(3, 3)), (self.B, to.index(9, 3))], raw))[1]
            self.assertEqual(channels["g/a"].values.tolist(), [-3, -2, -1, 0, 1, 2])
            self.assertEqual(channels["g/b"].values.tolist(), [0, 0.5, 1, 1.5, 2, 2.5])
        to = TdmsBytes()
        for kind, code in enumerate("bhiqBHIQ", 1):
            first = -1 if kind <= 4 else 2 ** (8 * struct.calcsize(code)) - 1
            self.assertEqual(self.values("g/a", to.segment(to.ALL, [(self.A, to.index(kind, 2))], to.pack("2" + code, first, 3))),
                             [float(first), 3])

    def test_scales(self):
        to = TdmsBytes()
        scales = {"NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 2, "NI_Scale[0]_Scale_Type": "Polynomial",
                  "NI_Scale[0]_Polynomial_Coefficients_Size": 3, "NI_Scale[0]_Polynomial_Coefficients[0]": 1.0,
                  "NI_Scale[0]_Polynomial_Coefficients[1]": 2.0, "NI_Scale[0]_Polynomial_Coefficients[2]": 4.0,
                  "NI_Scale[0]_Polynomial_Input_Source": 0xFFFFFFFF, "NI_Scale[1]_Scale_Type": "Linear",
                  "NI_Scale[1]_Linear_Slope": 0.5, "NI_Scale[1]_Linear_Y_Intercept": -3.0, "NI_Scale[1]_Linear_Input_Source": 0}

        def channel(**changes):
            stated = {**scales, **changes}
            return self.read(to.segment(to.ALL, [(self.A, to.index(2, 3), stated)], to.pack("3h", 0, 1, -2)))[1]["g/a"]

        self.assertEqual(channel().values.tolist(), [-2.5, 0.5, 3.5])
        self.assertIn("column g/a: its scaling Thermocouple is not supported",
                      channel(**{"NI_Scale[1]_Scale_Type": "Thermocouple"}).unreadable)
        self.assertIn("its scales form a circle", channel(**{"NI_Scale[1]_Linear_Input_Source": 1}).unreadable)
        del scales["NI_Scale[1]_Linear_Slope"]
        self.assertIn("lacks the property NI_Scale[1]_Linear_Slope", channel().unreadable)
        self.assertEqual(channel(NI_Scaling_Status="scaled").values.tolist(), [0, 1, -2])

    def test_daqmx(self):
        to = TdmsBytes()
        daqmx = lambda offset, form=0x1269: to.pack("IIIQIIIIIIII", form, 0xFFFFFFFF, 1, 3, 1, 3, 0, offset, 0, 0, 1, 4)
        scales = {"NI_Scaling_Status": "unscaled", "NI_Number_Of_Scales": 2, "NI_Scale[1]_Scale_Type": "Linear",
                  "NI_Scale[1]_Linear_Slope": 0.25, "NI_Scale[1]_Linear_Y_Intercept": 1.0, "NI_Scale[1]_Linear_Input_Source": 0}
        raw = to.pack("12h", *(sign * i for i in range(1, 7) for sign in (1, -1)))
        channels = self.read(to.segment(to.ALL | 128, [(self.A, daqmx(0), scales), (self.B, daqmx(2))], raw))[1]
        self.assertEqual(channels["g/a"].values.tolist(), [1.25, 1.5, 1.75, 2, 2.25, 2.5])
        self.assertEqual(channels["g/b"].values.tolist(), [-1, -2, -3, -4, -5, -6])
        self.refused("DAQmx digital lines, which are not supported", to.segment(to.ALL, [(self.A, daqmx(0, 0x126A))], raw))
        self.refused("lies outside of its buffer", to.segment(to.ALL, [(self.A, daqmx(3))], raw))

    def test_times_and_starts(self):
        for big in (False, True):
            to = TdmsBytes(big)
            stamp = lambda second, part: to.pack("qQ", second, part) if big else to.pack("Qq", part, second)
            raw = stamp(3800000000, 3 << 62) + stamp(3800000001, 1 << 62) + stamp(3800000001, 3 << 62)
            channel = self.read(to.segment(to.ALL, [("/'g'/'time'", to.index(0x44, 3))], raw))[1]["g/time"]
            self.assertEqual((channel.values.tolist(), channel.unit), ([0, 0.5, 1], "s"))
            channels = self.read(to.segment(to.ALL, [
                (self.A, to.index(10, 1), {"wf_increment": 0.5, "wf_start_time": (5, 0)}),
                (self.B, to.index(10, 1), {"wf_increment": 500.0, "wf_xunit_string": "ms", "wf_start_time": (5, 1 << 63)})],
                to.pack("2d", 1, 2)))[1]
            self.assertEqual([channels[n].sampling_Hz for n in ("g/a", "g/b")], [2.0, 2.0])
            self.assertEqual([channels[n].start_s for n in ("g/a", "g/b")], [0.0, 0.5])

    def test_a_file_that_was_not_closed_gives_its_complete_values(self):
        to = TdmsBytes()
        for contents in (to.ALL, to.ALL | to.INTERLEAVED):
            recording, channels = self.read(to.segment(contents, [(self.A, to.index(10, 1)), (self.B, to.index(10, 1))],
                                                       to.pack("5d", 1, 2, 3, 4, 5), False))
            self.assertEqual([channels[n].values.tolist() for n in ("g/a", "g/b")], [[1, 3], [2, 4]])
            self.assertIn("the file was not closed", recording.note)

    def test_damage(self):
        to = TdmsBytes()
        whole = to.segment(to.ALL, [(self.A, to.index(10, 4), {"unit_string": "g"})], to.pack("4d", 1, 2, 3, 4))
        for kept in range(len(whole)):
            if kept:
                self.refused("is damaged or truncated in the segment at byte 0", whole[:kept])
        self.refused(f"segment at byte {len(whole)}: it lacks", whole + whole[:60])
        for words, path, index, raw in (("not a whole number of chunks", self.A, to.index(10, 3), to.pack("4d", 1, 2, 3, 4)),
                                        ("refers to an earlier segment that lacks it", self.A, to.SAME_INDEX, to.pack("d", 1)),
                                        ("type 0xb, which is not supported", self.A, to.index(11, 1), to.pack("d", 1)),
                                        ("not a whole number of chunks", self.A, to.index(10, 1 << 61), to.pack("d", 1)),
                                        ("an invalid path", "/'g'/a", to.index(10, 1), to.pack("d", 1)),
                                        ("has no channel with numbers", "/'g'", to.NO_INDEX, b"")):
            self.refused(words, to.segment(to.ALL if raw else to.META, [(path, index)], raw))


def binary_58(order, form, size):
    return f"b{order:6d}{form:6d}{11:12d}{size:12d}{0:6d}{0:6d}{0:12d}{0:12d}"


class UniversalFiles(Case):
    kind = "uff"

    def sensor(self, **fields):
        return self.read(dataset_58(**fields))[1]["sensor"]

    def test_numbers_of_fortran(self):
        for data in (uff58(SINES), uff58(SINES, exponent="D"), uff58(SINES, exponent="d").replace("\n", "\r\n")):
            self.assertEqual(self.values("sensor", data), [float(f"{v:.11E}") for v in SINES])
        for kind, data, expected in ((4, "   1.0D+00  -2.0d+00   3.50000000000-101   4.00000000000+100\n", [1, -2, 3.5e-101, 4e100]),
                                     (2, "-1.00000E+000-2.00000E+000-3.50000E+000-4.00000E+000          \r\n", [-1, -2, -3.5, -4])):
            self.assertEqual(self.sensor(kind=kind, data=data).values.tolist(), expected)
        for data, words in (("  1.0e+00  2.x\n", ":14: "), ("1.0 2.0 3.0 4.0\n5.0 6.0\n", "more than the 4 declared values"),
                            ("1.0 2.0 3.0\n", "only 3 of 4 values are present")):
            self.refused(words, dataset_58(data=data))

    def test_binary_numbers(self):
        for order, form, raw, expected in (
                (1, 2, struct.pack("<3f", 1, -2.5, 0.5), [1, -2.5, 0.5]), (2, 2, struct.pack(">3f", 1, -2.5, 0.5), [1, -2.5, 0.5]),
                (2, 3, b"\x41\x10\0\0\xC2\x76\xA0\0\x40\x80\0\0", [1, -118.625, 0.5]),
                (1, 3, b"\0\0\x10\x41\0\xA0\x76\xC2\0\0\x80\x40", [1, -118.625, 0.5]),
                (1, 1, b"\x80\x40\0\0\x20\xC1\0\0\0\0\0\0", [1, -2.5, 0])):
            for end in ("\n", ""):
                self.assertEqual(self.sensor(count=3, binary=binary_58(order, form, 12), data=raw.decode("latin-1") + end)
                                 .values.tolist(), expected)
        raw = "\x80\x40\0\0\x20\xC1\0\0\0\0\0\0"
        self.assertIn("its values are DEC VMS", self.sensor(count=3, binary=binary_58(2, 1, 12), data=raw).unreadable)
        self.assertIn("4 is not a valid format", self.sensor(count=3, binary=binary_58(1, 4, 12), data=raw).unreadable)
        self.refused("declares 16 bytes, but its 3 values", dataset_58(count=3, binary=binary_58(1, 2, 16), data=raw))
        self.refused("of 4 values are present", dataset_58(count=4, binary=binary_58(1, 2, 16), data=raw)[:-8])

    def test_units(self):
        for lengths, fields, unit in ((None, {}, ""), (1.0, {}, "m/s^2"), (1000.0, {}, "mm/s^2"), (1 / 0.0254, {}, "in/s^2"),
                                      (17.0, {}, "1/17 of m/s^2, by dataset 164"), (1000.0, {"direction": 4}, "rad/s^2"),
                                      (1000.0, {"quantity": 0}, "not stated, with 1000 units of length per metre by dataset 164"),
                                      (1.0, {"quantity": 0}, ""), (None, {"quantity": 19}, "rpm"),
                                      (None, {"denominator": "N", "unit": "m/s^2"}, "m/s^2 per N by the function's denominator")):
            set58 = dataset_58(**{"unit": "NONE", **fields})
            for data in ((uff164(lengths) + set58, set58 + uff164(lengths), uff164(1.0) + uff164(lengths) + set58)
                         if lengths else (set58,)):
                self.assertEqual(self.read(data)[1]["sensor"].unit, unit, (lengths, fields))
        for label, unit in (("mm/s^2", "mm/s^2 by the function's label, but m/s^2 by dataset 164"), ("M/SEC**2", "M/SEC**2")):
            self.assertEqual(self.read(uff164(1.0) + dataset_58(unit=label))[1]["sensor"].unit, unit)
        self.assertEqual([self.sensor(quantity=q, unit=u).unit for q, u in ((8, "deg"), (11, "rpm"))], ["deg", "rpm"])
        for quantity, unit, text in ((11, "m/s", "velocity in m/s, ordinate data type 11"),
                                     (11, "NONE", "velocity, ordinate data type 11"), (99, "N", "specific data type 99 in N, "
                                                                                       "ordinate data type 99")):
            self.assertEqual(self.sensor(quantity=quantity, unit=unit).unit, text)

    def test_other_functions(self):
        response = dataset_58(function=4, kind=5, count=2, abscissa=18)
        spectrum = dataset_58(function=9, kind=5, count=2, abscissa=18, binary=binary_58(1, 2, 16),
                              data="\0\0\0\0\n-1\n" + 8 * "\0")
        self.assertEqual(self.values("sensor", response + spectrum + dataset_58()), [1, -2, 3.5, 4])
        self.refused("its functions are: frequency response function, power spectral density", response + spectrum)
        self.refused("contains no measured function (dataset 58); its datasets are 15, 82",
                     "    -1\n    15\n1\n    -1\n    -1\n    82\n    -1\n")
        self.refused("complex time response", dataset_58(kind=5, count=2))

    def test_several_functions(self):
        channels = self.read(dataset_58(title="sensor") + dataset_58(title="Mic", step=0.25) + dataset_58(title="Mic", start=3.0))[1]
        self.assertEqual([c.text for c in channels.values()], ["function1 (sensor)", "function2 (Mic)", "function3 (Mic)"])
        self.assertEqual([(c.sampling_Hz, c.start_s) for c in channels.values()], [(2.0, 0.0), (4.0, 0.0), (2.0, 3.0)])

    def test_times(self):
        data = " 1.00000E+00 5.00000E+00 1.50000E+00 6.00000E+00 2.00000E+00 7.00000E+00\n"
        raw = b"".join(struct.pack("<fd", *pair) for pair in ((1, 5), (1.5, 6), (2, 7))).decode("latin-1")
        for fields in ({"data": data}, {"kind": 4, "data": data}, {"kind": 4, "binary": binary_58(1, 2, 36), "data": raw}):
            channels = self.read(dataset_58(spacing=0, count=3, **fields))[1]
            self.assertEqual([channels[n].values.tolist() for n in ("sensor", "time")], [[5, 6, 7], [1, 1.5, 2]])
            self.assertEqual((channels["sensor"].times, channels["time"].unit), ("time", "s"))
        self.assertEqual(self.sensor(abscissa_unit="ms").sampling_Hz, 2000.0)
        self.assertIn("furlong is not a known unit of its times", self.sensor(abscissa_unit="furlong").unreadable)
        self.assertIn("0 s is not a valid time step", self.sensor(abscissa_unit="NONE", step=0.0).unreadable)

    def test_rounded_steps(self):
        for step, rate in ((1.95313e-4, 5120), (1.52588e-5, 65536), (3.90625e-5, 25600), (1.23456e-3, 1 / 1.23456e-3), (2.5, 0.4)):
            self.assertEqual(self.sensor(step=step).sampling_Hz, rate)
        self.assertEqual(self.sensor(step=1.95313e-4).note, "the rate is 5120 Hz, which rounds to the time step 0.000195313 s")


class Process(Case):
    def test_damaged_files_are_read_or_refused(self):
        """Random damage gives a recording or a reason, never another exception."""
        to = TdmsBytes()
        genuine = {"tdms": to.segment(to.ALL, [(TdmsFiles.A, to.index(10, 4), {"wf_increment": 0.5, "unit_string": "g"})],
                                      to.pack("4d", 1, 2, 3, 4)) + to.segment(to.RAW, [], to.pack("4d", 1, 2, 3, 4)),
                   "uff": dataset_58().encode()}
        scipy.io.savemat(self.path, {"s": {"sensor": SIX}, "Fs": 5.0}, appendmat=False)
        genuine["mat"] = self.path.read_bytes()
        soundfile.write(self.path, 0.03 * SINES, 5120, format="WAV", subtype="PCM_16")
        genuine["sound"] = self.path.read_bytes()
        genuine["text"] = "Rig;2\n\"Zeit [s]\";g\n0;2,5\n0,5;1.5\n1;\"3\"\n".encode("utf-16")
        dice = random.Random(7)
        for self.kind, whole in genuine.items():
            for _ in range(150):
                data = bytearray(whole)
                for _ in range(dice.randint(1, 4)):
                    data[dice.randrange(len(data))] = dice.choice((0, 255, dice.randrange(256)))
                self.path.write_bytes(data[:dice.choice((len(data), dice.randint(1, len(data))))])
                try:
                    signal_files.write_plain_csv(str(self.path), f"{self.path}.csv") if self.kind == "text" else self.read()
                except (signal_files.Refusal, MemoryError):
                    pass

    def test_attributes_of_the_file_that_is_handed_over(self):
        self.path.write_text(dataset_58(step=1.95313e-4, unit="m/s\0"))
        output = self.path.with_name("out.h5")
        signal_files.write_recording(signal_files.read_uff(str(self.path)), output)
        with h5py.File(output) as file:
            self.assertEqual(file["000000"][()].tolist(), [[1, -2, 3.5, 4]])
            channel = json.loads(file.attrs["recording"])["channels"][0]
            self.assertEqual((channel["name"], channel["sampling_Hz"], channel["shape"]), ("sensor", 5120.0, [1, 4]))
            self.assertNotIn("times", channel)


if __name__ == "__main__":
    unittest.main()
