"""Reads recordings of other programs for gearpod: MAT, TDMS, universal and sound files, and text tables other than plain CSV.

The program contains this file and starts it once for each recording: python -c SOURCE KIND PATH OUT. The
process writes an HDF5 file with a dataset for each channel, in doubles, one row per column of a matrix. An
attribute states name, unit, sampling rate, start and problems (mc/files/signal_foreign.cpp). Of a text table it writes
plain CSV. If the file cannot be read, the process prints the reason and ends with exit code 3. Memory and time are limited.
"""

# mypy: ignore-errors

import collections
import csv
import datetime
import decimal
import gzip
import itertools
import json
import math
import mmap
import os
import pathlib
import re
import resource
import signal
import struct
import sys
import warnings
import zlib
from types import SimpleNamespace

os.environ["OPENBLAS_NUM_THREADS"] = "1"

FREE_MEMORY, MEMORY_PER_BYTE = 256 << 20, 1000
FREE_SECONDS, BYTES_PER_SECOND = 20, 500_000
REFUSED = 3
PACKAGES = {"mat": ("numpy", "h5py", "scipy.io"), "sound": ("numpy", "h5py", "soundfile"), "text": ()}
TIME_UNITS = {name: factor for names, factor in (
    ("s sec secs second seconds none n/a null", 1.0), ("ms msec msecs millisecond milliseconds", 1e-3),
    ("us µs μs usec usecs microsecond microseconds", 1e-6), ("ns nsec nanosecond nanoseconds", 1e-9),
    ("min mins minute minutes", 60.0), ("h hr hrs hour hours", 3600.0)) for name in names.split()} | {"": 1.0}
Recording = collections.namedtuple("Recording", "channels separator note", defaults=("/", ""))  # separator in names of channels


class Refusal(Exception):
    """Reason why a file cannot be read, after the file's name in the message."""


class Channel(SimpleNamespace):
    """Channel of a recording: a vector, or a matrix with a row for each column of the file's matrix, and statements
    (ForeignChannel in mc/files/signal_foreign.cpp). Empty texts and None are not stated."""

    values = ()
    text = title = unit = times = note = problem = unreadable = ""
    sampling_Hz = start_s = None


def require(condition, reason):
    if not condition:
        raise Refusal(f": {reason}")


def file_text(raw):
    """Text in UTF-8, or in Latin-1 as recorders under Windows write it."""
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def shown(values):
    return "".join(c if c.isprintable() else "?" for c in values)


def rate_of(step, second, where=""):
    """Sampling rate of a time step in a unit of this many seconds."""
    if not (step * second > 0 and 1 / (step * second) < math.inf):
        raise ValueError(f"{step * second:g} s is not a valid time step{where}")
    return 1 / (step * second)


# MAT files. An array that is not a numeric matrix has a `kind` for lists of channels.

NotNumbers = collections.namedtuple("NotNumbers", "kind problem", defaults=("",))
OBJECT = NotNumbers("table or object", "is a table, timetable or object, which is not supported; in MATLAB, save its columns as a "
                    "struct: s = table2struct(T, 'ToScalar', true); save('FILE', 's')")
ELSEWHERE = NotNumbers("in another file", "is stored in another file, which is not supported; copy it into this file")
SPARSE, TEXT, OTHER = (NotNumbers("sparse", "is a sparse matrix; save a real, full vector"), NotNumbers("text"),
                       NotNumbers("not numbers"))
DEEPEST, MOST_ARRAYS = 16, 20000


def elements_of(name, items, cell=False):
    """Elements of an array of structs or cells with their names in MATLAB."""
    form = "{}{{{}}}" if cell else "{}" if len(items) == 1 else "{}({})"
    return [(form.format(name, i), item) for i, item in enumerate(items, 1)]


def level5_arrays(path):
    """Names and arrays of the variables of MATLAB 4 to 7.2, and the names that occur more than once."""
    import scipy.io
    from scipy.io import matlab
    from scipy.sparse import issparse

    def arrays(name, value, depth=0):
        if isinstance(value, matlab.MatlabFunction):
            yield name, OTHER
        elif isinstance(value, (matlab.MatlabOpaque, matlab.MatlabObject)) or issparse(value):
            yield name, SPARSE if issparse(value) else OBJECT
        elif depth < DEEPEST and value.dtype.hasobject:  # structs or cells
            for inner, element in elements_of(name, value.flatten(order="F"), value.dtype.names is None):
                for field in value.dtype.names or [None]:
                    yield from arrays(f"{inner}.{field}", element[field], depth + 1) if field else arrays(inner, element, depth + 1)
        elif value.dtype.kind == "U":
            yield name, "".join(value.flatten().tolist()) if value.size <= 1 else TEXT
        else:
            yield name, value

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        variables = scipy.io.loadmat(path)
    repeated = [found[1] for w in caught if (found := re.search(r'Duplicate variable name "(.*?)"', str(w.message)))]
    return (pair for name, value in variables.items() if not name.startswith("__") for pair in arrays(name, value)), repeated


def level73_arrays(path):
    """Names and arrays of the variables of MATLAB 7.3, which are HDF5 datasets. Links are not followed."""

    def elements(name, field, dataset, depth):
        for inner, reference in elements_of(name, dataset[()].flatten(), not field):
            yield from arrays(inner + field, dataset.file[reference], depth + 1)

    def arrays(name, item, depth):
        kind = item.attrs.get("MATLAB_class", b"")
        kind = kind.decode() if isinstance(kind, bytes) else str(kind)
        if isinstance(item, h5py.Group):
            if "MATLAB_sparse" in item.attrs:
                yield name, SPARSE
            elif depth < DEEPEST:
                yield from members(item, name + ".", depth)
        elif item.external or item.is_virtual:
            yield name, ELSEWHERE
        elif item.dtype == h5py.ref_dtype and depth < DEEPEST:
            yield from elements(name, "", item, depth)
        elif "MATLAB_object_decode" in item.attrs or not re.fullmatch("|double|single|logical|char|cell|u?int(8|16|32|64)", kind):
            yield name, OBJECT
        elif item.attrs.get("MATLAB_empty", 0):
            yield name, np.empty([int(n) for n in item[()].flatten()])
        elif kind == "char":
            yield name, "".join(map(chr, item[()].flatten().tolist())) if item.size <= 1000 else TEXT
        elif item.dtype.names:
            yield name, np.empty(item.shape[::-1], complex)
        else:
            yield name, item[()].T if item.dtype.kind in "fiub" else OTHER

    def members(group, prefix="", depth=0):
        """Variables, or fields of a struct. Those of an array of structs are references, in the order of its elements."""
        for key in group:
            if not isinstance(group.get(key, getlink=True), h5py.HardLink):
                yield prefix + key, ELSEWHERE
            elif prefix and getattr(group[key], "dtype", None) == h5py.ref_dtype and "MATLAB_class" not in group[key].attrs:
                yield from elements(prefix[:-1], "." + key, group[key], depth)
            elif prefix or not key.startswith("#"):
                yield from arrays(prefix + key, group[key], depth + bool(prefix))

    with h5py.File(path, "r") as file:
        return list(itertools.islice(members(file), MOST_ARRAYS + 1)), []


def mat_channel(name, value):
    """Channel of an array with its values as rows. Of two dimensions larger than 1, the longer one is time."""
    if isinstance(value, str) or isinstance(value, np.ndarray) and value.dtype.kind not in "fiubc":
        value = TEXT if isinstance(value, str) else OTHER
    if isinstance(value, NotNumbers):
        text = f"{name} ({value.kind})"
        return Channel(name=name, text=text, problem=f"{name} {value.problem}" if value.problem else f"{text} is not a column of numbers")
    shape, wide = " x ".join(map(str, value.shape)), [size for size in value.shape if size != 1]
    if np.iscomplexobj(value):
        return Channel(name=name, text=f"{name} (complex, {shape})", problem=f"{name} is complex; save a real, full vector")
    if not value.shape or len(wide) > 2 or len(wide) == 2 and wide[0] == wide[1]:
        return Channel(name=name, text=f"{name} ({shape})", problem=f"{name} has the shape {shape}; a column must be a vector, or a "
                       "column of a matrix whose longer dimension is time")
    if len(wide) < 2:
        return Channel(name=name, values=value.flatten(), text=f"{name} ({shape})")
    columns, rows = min(wide), value.reshape(wide)
    return Channel(name=name, values=rows if wide[0] == columns else rows.T, text=f"{name} ({shape}; {name}:1 to {name}:{columns})",
                   problem=f"{name} is a matrix of {shape}; choose one of its columns, {name}:1 to {name}:{columns}")


def read_mat(path):
    with open(path, "rb") as file:
        require(file.read(64) != bytes(64), "begins with zeros, as if it had not been written to its end")
    try:
        found, repeated = (level73_arrays if h5py.is_hdf5(path) else level5_arrays)(path)
        arrays = list(itertools.islice(found, MOST_ARRAYS + 1))
        if not arrays:
            raise ValueError("no variables")
    except MemoryError:
        raise
    except Exception as error:
        raise Refusal(f": is not a MAT file, or is damaged ({type(error).__name__}: {shown(str(error))[:200]})") from error
    require(len(arrays) <= MOST_ARRAYS, f"contains more than {MOST_ARRAYS} arrays")
    objects = [name for name, value in arrays if value is OBJECT]
    require(not objects or any(isinstance(value, np.ndarray) for _, value in arrays), f"{objects[0] if objects else ''} {OBJECT.problem}")

    def parts_of(name):
        group, _, leaf = name.rpartition(".")
        return group, re.sub("[^a-z0-9]", "", leaf.lower())

    texts = {parts_of(name): (name, value) for name, value in arrays if isinstance(value, str)}
    signals = collections.Counter(parts_of(name)[0] for name, value in arrays if isinstance(value, np.ndarray) and value.size > 1)
    channels = [mat_channel(name, value) for name, value in arrays]
    for channel in channels:
        group, leaf = parts_of(channel.name)
        notes = [f"the variable {variable} occurs more than once; the last one is used, as in MATLAB" for variable in repeated
                 if re.match(re.escape(variable) + r"($|[.({])", channel.name)]
        of_column, of_group = ([texts[group, start + end] for end in ("unit", "units") if (group, start + end) in texts]
                               for start in (leaf, ""))
        if of_column or of_group and signals[group] == 1:
            channel.unit = (of_column or of_group)[0][1]
        elif of_group and of_group[0][1]:
            notes.append("{} = {} is not used, because it may belong to several columns".format(*of_group[0]))
        channel.note = "\n".join(notes)
    return Recording(channels, separator=".")


# Sound files. Integers are fractions of the full scale.

CONTAINERS = ("WAV", "WAVEX", "RF64", "W64", "FLAC", "AIFF", "AU", "CAF")
LOSSLESS = "PCM_S8 PCM_U8 PCM_16 PCM_24 PCM_32 FLOAT DOUBLE ALAC_16 ALAC_20 ALAC_24 ALAC_32".split()
UNKNOWN_LENGTH = 0xFFFFFFFF  # of a recording that was written to a pipe


def check_length(log):
    """Refuses a truncated recording. libsndfile shortens it without an error, and states this in its log only."""
    for declared, present in re.findall(r"^ *(?:data|SSND|riff) *: (\d+) \(should be (\d+)\)", log, re.MULTILINE):
        missing = int(declared) - int(present)
        require(missing <= 0 or int(declared) == UNKNOWN_LENGTH, f"is truncated: {missing} bytes are missing")
    for present, declared in re.findall(r"frame count (\d+) does not match value from 'ds64' chunk of (\d+)", log):
        require(int(present) >= int(declared), f"is truncated: only {present} of {declared} samples are present")


def read_sound(path):
    import soundfile

    file, blocks, frames = None, [], 1 << 16
    try:
        file = soundfile.SoundFile(path)
        require(file.format in CONTAINERS, "is not a WAV, RF64, W64, FLAC, AIFF, AU or CAF file")
        require(file.subtype in LOSSLESS, f"is compressed with loss ({file.subtype_info}); save it as plain samples (PCM) or FLAC")
        require(file.channels > 0 and file.frames > 0, "is a sound file without samples")
        check_length(file.extra_info)
        while not blocks or len(blocks[-1]) == frames:
            block = np.empty((frames, file.channels))
            blocks.append(block[:file.buffer_read_into(block, "float64")])
    except soundfile.LibsndfileError as error:
        count = sum(map(len, blocks))
        require("SF_INFO struct incomplete" not in str(error), "is damaged: its header states no valid sampling rate or no channels")
        raise Refusal(f": is {f'damaged after {count} samples' if file else 'not a sound file, or is damaged'}; libsndfile reports: "
                      f"{error.error_string}") from error
    values = np.concatenate(blocks)
    require(file.frames == 2**63 - 1 or len(values) >= file.frames,  # streamed FLAC does not state its length
            f"is truncated: only {len(values)} of {file.frames} samples are present")
    names = ["sensor"] if file.channels == 1 else [f"channel{c + 1}" for c in range(file.channels)]
    return Recording([Channel(name=name, values=values[:, c], sampling_Hz=float(file.samplerate)) for c, name in enumerate(names)])


# TDMS files. Source: National Instruments, "TDMS File Format Internal Structure".

TDMS_NUMBERS = {1: "i1", 2: "i2", 3: "i4", 4: "i8", 5: "u1", 6: "u2", 7: "u4", 8: "u8", 9: "f4", 10: "f8", 0x19: "f4", 0x1A: "f8",
                0x21: "u1"}
TDMS_STRING, TDMS_TIME, U64 = 0x20, 0x44, 8
TDMS_WIDTHS = {kind: int(code[1:]) for kind, code in TDMS_NUMBERS.items()} | {TDMS_TIME: 16, 0x08000C: 8, 0x10000D: 16}
SCALER_TYPES = (5, 1, 6, 2, 7, 3, 8, 4, 9, 10)
META_DATA, NEW_OBJECTS, RAW_DATA, INTERLEAVED, BIG_ENDIAN = 2, 4, 8, 32, 64
NO_DATA, AS_BEFORE, FORMAT_CHANGING, DIGITAL_LINE = 0xFFFFFFFF, 0, 0x1269, 0x126A
NOT_CLOSED, RAW_INPUT, MOST_SCALES = 2**64 - 1, 0xFFFFFFFF, 64  # length of a segment; input of a scale
EXPORT = "; save the file with scaled values, or export it as CSV"


class TdmsFile:
    """Objects of a TDMS file, and the positions of their raw data."""

    def __init__(self, data):
        self.data, self.segment, self.closed = data, 0, True
        self.properties, self.groups, self.channels = {}, {}, {}
        self.indices, self.active = {}, []  # by path; paths with data in this segment
        while self.segment < len(data):
            self.segment = self.read_segment()

    def require(self, condition, reason, how="is damaged or truncated in the"):
        require(condition, f"{how} segment at byte {self.segment}: {reason}")

    def bytes(self, length):
        self.require(length <= self.meta_end - self.at, "its metadata end too early")
        self.at += length
        return self.data[self.at - length:self.at]

    def dtype(self, kind, order=None):
        """Times are seconds since 1904, and fractions of a second as multiples of 2^-64."""
        order = order or self.order
        parts = [("fraction", order + "u8"), ("seconds", order + "i8")]
        return np.dtype((parts if order == "<" else parts[::-1]) if kind == TDMS_TIME else order + TDMS_NUMBERS[kind])

    def number(self, kind=7):
        return np.frombuffer(self.bytes(TDMS_WIDTHS[kind]), self.dtype(kind))[0].item()

    def numbers(self, count):
        return [self.number() for _ in range(count)]

    def text(self):
        return file_text(self.bytes(self.number()))

    def property(self):
        """A text, a number as float, or a time in 2^-64 s as int."""
        kind = self.number()
        if kind == TDMS_STRING:
            return self.text()
        self.require(kind in TDMS_NUMBERS or kind == TDMS_TIME, f"a property has the unknown type {kind:#x}")
        value = self.number(kind)
        if kind == TDMS_TIME:
            fraction, seconds = value if self.order == "<" else value[::-1]
            return seconds * 2**64 + fraction
        return float(value)

    def read_segment(self):
        """Returns the position of the next segment."""
        lead, begin = self.data[self.segment:self.segment + 28], self.segment + 28
        self.require(len(lead) == 28, "it ends too early")
        self.require(lead[:4] == b"TDSm", "it does not begin with TDSm")
        contents = struct.unpack_from("<I", lead, 4)[0]
        self.order, rest = ">" if contents & BIG_ENDIAN else "<", len(self.data) - begin
        length, raw = struct.unpack_from(self.order + "QQ", lead, 12)
        # A program that ended while it was recording leaves the last segment without its length.
        self.closed = length != NOT_CLOSED
        length = length if self.closed else rest
        self.require(length <= rest, f"it lacks {length - rest} bytes")
        self.require(raw <= length, "its raw data begin after its end")
        self.at, self.meta_end = begin, begin + raw
        if contents & NEW_OBJECTS:
            self.active = []
        for _ in range(self.number() if contents & META_DATA else 0):
            self.read_object()
        if contents & RAW_DATA and length > raw:
            self.add_chunks(begin + raw, length - raw, contents & INTERLEAVED)
        return begin + length

    def read_object(self):
        path = self.text()  # such as /'group'/'channel'; a quote in a name is doubled
        self.require(path == "/" or re.fullmatch("(/'([^']|'')*'){1,2}", path, re.DOTALL), "an object has an invalid path")
        names = [name.replace("''", "'") for name in re.findall("/'((?:[^']|'')*)'", path)]
        length, properties = self.number(), self.groups.setdefault(names[0], {}) if names else self.properties
        if len(names) == 2:
            properties = self.channels.setdefault(path, SimpleNamespace(
                path=path, group=names[0], name="/".join(names), kind=0, daqmx=False, raw={}, properties={})).properties
            if length not in (NO_DATA, AS_BEFORE):
                self.indices[path] = self.index(length)
            self.require(length == NO_DATA or path in self.indices, "a channel refers to an earlier segment that lacks it")
            if length == NO_DATA or path not in self.active:
                self.active = [other for other in self.active if other != path] + [path] * (length != NO_DATA)
        else:
            self.require(length == NO_DATA, "a group has raw data")
        for _ in range(self.number()):
            name = self.text()
            properties[name] = self.property()

    def index(self, length):
        """Data of an object in each chunk of a segment. DAQmx: `scalers` have type, buffer, offset and number of the scale."""
        kind, dimensions, count = *self.numbers(2), self.number(U64)
        self.require(dimensions == 1, "a channel has arrays of several dimensions")
        how = "cannot be read because of the"
        self.require(length != DIGITAL_LINE, "it has raw data of DAQmx digital lines, which are not supported" + EXPORT, how)
        if length == FORMAT_CHANGING:
            scalers = [self.numbers(5) for _ in range(self.number())]
            for scaler in scalers:
                self.require(scaler[0] < len(SCALER_TYPES), f"its DAQmx data have the unknown type {scaler[0]}")
            return SimpleNamespace(kind=kind, count=count, size=0, buffers=self.numbers(self.number()), scalers=[
                (SCALER_TYPES[scaler], buffer, offset, scale) for scaler, buffer, offset, _, scale in scalers])
        self.require(kind in TDMS_WIDTHS or kind == TDMS_STRING, f"a channel has the type {kind:#x}, which is not supported", how)
        size = self.number(U64) if kind == TDMS_STRING else count * TDMS_WIDTHS[kind]
        return SimpleNamespace(kind=kind, count=count, size=size, buffers=None, scalers=[])

    def add_chunks(self, at, length, interleaved):
        """Adds the blocks of a segment, which repeat in each chunk. The last chunk may be incomplete if the file was not closed."""
        used = [(self.channels[path], self.indices[path]) for path in self.active]
        blocks, chunk = [], 0  # channel, scale, position, stride, count and type
        if any(index.buffers is not None for _, index in used):
            blocks, chunk = self.daqmx_blocks(used)
        elif interleaved:
            counts = {index.count for _, index in used}
            self.require(len(counts) < 2 and all(index.kind != TDMS_STRING for _, index in used),
                         "its interleaved channels have different numbers of values")
            row = sum(TDMS_WIDTHS[index.kind] for _, index in used)
            count = max(counts, default=0) if self.closed else length // max(1, row)
            for channel, index in used:
                blocks.append((channel, 0, chunk, row, count, index.kind))
                chunk += TDMS_WIDTHS[index.kind]
            chunk *= count
        else:
            for channel, index in used:
                if index.kind != TDMS_STRING:
                    blocks.append((channel, 0, chunk, TDMS_WIDTHS[index.kind], index.count, index.kind))
                chunk += index.size
        self.require(chunk and (not self.closed or length % chunk == 0), "its raw data are not a whole number of chunks")
        for channel, scale, first, stride, count, kind in blocks:
            self.require(channel.kind in (0, kind) or channel.daqmx, "a channel changes its type")
            if count and length >= chunk:
                channel.kind = kind
                channel.raw.setdefault(scale, []).append(
                    np.ndarray((length // chunk, count), self.dtype(kind), self.data, at + first, (chunk, stride)))

    def daqmx_blocks(self, used):
        """A chunk has one buffer after another, and each buffer has rows of its width."""
        blocks, count, buffers = [], used[0][1].count, used[0][1].buffers
        for channel, index in used:
            self.require(None is not index.buffers == buffers and index.count == count,
                         "its DAQmx channels have different numbers of values")
            channel.daqmx = True
            for kind, buffer, offset, scale in index.scalers:
                self.require(buffer < len(buffers) and offset + TDMS_WIDTHS[kind] <= buffers[buffer],
                             "a DAQmx channel lies outside of its buffer")
                blocks.append((channel, scale, sum(buffers[:buffer]) * count + offset, buffers[buffer], count, kind))
        return blocks, sum(buffers) * count

    def scaled(self, channel):
        """Values after the last of the channel's scales."""
        for holder in (channel.properties, self.groups.get(channel.group, {}), self.properties):
            count, status = stated(holder, "NI_Number_Of_Scales"), stated(holder, "NI_Scaling_Status", str)
            if count is None:
                continue
            if status == "scaled" and not channel.daqmx:
                break
            if status not in (None, "", "unscaled") and not channel.daqmx:
                raise ValueError(f'its scaling status "{status}" is unknown')
            if not 0 <= count <= MOST_SCALES:
                raise ValueError(f"{count:g} is not a valid number of scales")
            if count > 0:
                return scaled_values(channel, holder, int(count) - 1)
        return raw_values(channel, next(iter(channel.raw)))


def raw_values(channel, scale):
    blocks = channel.raw[scale]
    if channel.kind != TDMS_TIME:
        return np.concatenate([block.astype(np.float64).ravel() for block in blocks])
    seconds, fraction = (np.concatenate([block[part].astype(code).ravel() for block in blocks])
                         for part, code in (("seconds", "i8"), ("fraction", "u8")))
    parts = (fraction >> np.uint64(11)).astype(np.float64)  # 53 bits are exact
    return seconds.astype(float) - float(seconds[0]) + np.ldexp(parts - parts[0], -53)  # seconds from the first time


def stated(properties, name, kind=float):
    """Property of a kind: a number (float), a text (str) or a time (int); None if there is none."""
    value = properties.get(name)
    return value if isinstance(value, kind) else None


def scaled_values(channel, holder, scale, depth=0):
    """Values after a scale, whose input is another scale or the raw values."""
    if not 0 <= scale < RAW_INPUT or channel.daqmx and scale in channel.raw:
        return raw_values(channel, scale if scale in channel.raw and channel.daqmx else next(iter(channel.raw)))
    if depth == MOST_SCALES:
        raise ValueError("its scales form a circle")
    prefix = f"NI_Scale[{int(scale)}]_"
    kind, count = stated(holder, prefix + "Scale_Type", str) or "", stated(holder, prefix + "Polynomial_Coefficients_Size")
    if kind not in ("Linear", "Polynomial"):
        raise ValueError(f"its scaling {kind or f'{scale:g} is not stated, which'} is not supported{EXPORT}")
    names = ["Linear_Y_Intercept", "Linear_Slope"] if kind == "Linear" else \
        [f"Polynomial_Coefficients[{i}]" for i in range(MOST_SCALES) if i < (4.0 if count is None else count)]
    coefficients, source = [stated(holder, prefix + name) for name in names], stated(holder, f"{prefix}{kind}_Input_Source")
    if None in coefficients:
        raise ValueError(f"its scaling lacks the property {prefix}{names[coefficients.index(None)]}")
    values = scaled_values(channel, holder, RAW_INPUT if source is None else source, depth + 1)
    return np.polynomial.polynomial.polyval(values, coefficients or [0.0])


def tdms_sampling(properties, first_start):
    """Rate and start of a waveform; the rate is None if its abscissa is not time, the start counts from the first waveform."""
    step, start = stated(properties, "wf_increment"), stated(properties, "wf_start_time", int)
    second = TIME_UNITS.get((stated(properties, "wf_xunit_string", str) or "").strip().lower())
    since = stated(properties, "wf_start_offset")
    if start is not None:
        since = (start - first_start) / 2**64 + (since or 0.0)
    return rate_of(step, second, " (wf_increment)") if step and second is not None else None, since


def read_tdms(path):
    with open(path, "rb") as file:
        require(os.fstat(file.fileno()).st_size, "is empty")
        tdms = TdmsFile(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
    sources, channels = list(tdms.channels.values()), []
    names, starts = [c.name for c in sources], [stated(c.properties, "wf_start_time", int) for c in sources]
    for source in sources:
        if not source.raw or source.kind not in (*TDMS_NUMBERS, TDMS_TIME):
            continue
        channel = Channel(name=source.name if names.count(source.name) == 1 else source.path)
        channels.append(channel)
        if source.kind == TDMS_TIME:
            channel.values, channel.unit = raw_values(source, 0), "s"
            continue
        channel.unit = stated(source.properties, "unit_string", str) or stated(source.properties, "NI_UnitDescription", str) or ""
        try:
            with np.errstate(all="ignore"):
                channel.values = tdms.scaled(source)
            first_start = next((start for start in starts if start is not None), None)
            channel.sampling_Hz, channel.start_s = tdms_sampling(source.properties, first_start)
        except ValueError as problem:
            channel.unreadable = f"column {channel.name}: {problem}"
    require(channels, f"has no channel with numbers or times; its channels are {', '.join(tdms.channels)[:400] or 'none'}")
    return Recording(channels, note="" if tdms.closed else
                     "the file was not closed; values after the last complete ones are missing")


# Universal files: dataset 58 as text or with binary values (58b), and the units of dataset 164. Source: University of
# Cincinnati, SDRL, "Universal File Formats for Modal Analysis Testing".

QUANTITIES = ("unknown,general,stress,strain,4,temperature,heat flux,7,displacement,reaction force,10,velocity,acceleration,"
              "excitation force,14,pressure,mass,time,frequency,rotational speed,order,sound pressure,sound intensity,"
              "sound power").split(",")
FUNCTIONS = ("general function,time response,auto spectrum,cross spectrum,frequency response function,transmissibility,coherence,"
             "auto correlation,cross correlation,power spectral density,energy spectral density,probability density,spectrum,"
             "cumulative distribution,peaks and valleys,stress cycles,strain cycles,orbit,mode indicator function,force pattern,"
             "partial power,partial coherence,eigenvalue,eigenvector,shock response spectrum,impulse response filter,"
             "multiple coherence,order function,phase compensation").split(",")
ACCELERATION, FORCE, TIME, FREQUENCY, SPEED = 12, 13, 17, 18, 19
LENGTHS = {"m": 1.0, "cm": 100.0, "mm": 1000.0, "um": 1e6, "in": 1 / 0.0254, "ft": 1 / 0.3048}
ANGULAR = {"displacement": "[mu]?rad|deg|degrees|°|arcmin|arcsec|turns?|revs?",
           "velocity": "(rad|deg|turns?|revs?)/s(ec)?|(turns?|revs?|r|1)/min|rpm|k?hz"}  # units of rotation
FORTRAN_NUMBER = re.compile(rb"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)(E[+-]?[0-9]+|[+-][0-9]{3}(?![0-9.]))?")
DATASET_END = re.compile(rb"\n *-1 *\r?(\n|$)")


def python_number(text):
    """Fortran's number, whose exponent may begin with D, or have no letter if it has three digits, as Python writes it."""
    return re.sub(r"(?<=[0-9.])([+-][0-9]+)$", r"E\1", text.strip().upper().replace("D", "E"))


def field(text):
    """Text of a field; NONE means that it is not used."""
    return text.strip() if text.strip() != "NONE" else ""


class Axis(collections.namedtuple("Axis", "kind unit")):
    @property
    def quantity(self):
        return QUANTITIES[self.kind] if 0 <= self.kind < len(QUANTITIES) else f"specific data type {self.kind}"

    def text(self):
        return self.quantity + (f" in {self.unit}" if self.unit else "")


class UniversalFile:
    """Functions of a universal file, in its order. Uneven ones have `abscissae`, complex ones `imaginary` parts, and `lengths` are
    the file's units of length in a metre."""

    def __init__(self, path):
        self.data, self.at, self.line = pathlib.Path(path).read_bytes(), 0, 0
        self.functions, lengths, first_lengths, others = [], None, None, []
        while (line := self.next()) is not None:
            if line.strip() != "-1" or (line := self.next()) is None:
                continue
            kind = line[:7].strip()
            if kind in ("58", "58b"):
                self.functions.append(self.function(line if kind == "58b" else ""))
                self.functions[-1].lengths = lengths
                continue
            if kind == "164":
                lengths = self.number([self.next(), self.next()][1], 0, 25, "ends within a dataset 164 (units)")
                self.require(0 < lengths < math.inf, f"{lengths:g} is not a valid factor of length")
                first_lengths = first_lengths or lengths
            others += [kind] * (kind != "164")
            self.rest_of_dataset()
        which = f"; its datasets are {shown(', '.join(others)[:60])}" if others else ""
        require(self.functions, f"contains no measured function (dataset 58){which}")
        for function in self.functions:
            function.lengths = function.lengths or first_lengths

    def require(self, condition, reason):
        if not condition:
            raise Refusal(f":{self.line}: {shown(reason)}")

    def next(self):
        self.line += 1
        end = self.data.find(b"\n", self.at) + 1 or len(self.data)
        line, self.at = self.data[self.at:end], end
        return file_text(line).removesuffix("\n") if line else None

    def rest_of_dataset(self, problem=""):
        """Skips lines; `problem` if any of them is not blank."""
        while (line := self.next()) is not None and line.strip() != "-1":
            self.require(not problem or not line.strip(), problem)

    def number(self, line, begin=0, end=None, missing=""):
        self.require(line is not None, missing)
        text = line[begin:end]
        try:
            return float(python_number(text))
        except ValueError:
            self.require(False, f'"{text.strip()[:40]}" is not a number')

    def whole(self, line, begin, end):
        value = self.number(line, begin, end)
        self.require(abs(value) <= 1e9 and value == int(value), f'"{line[begin:end].strip()}" is not a valid code')
        return int(value)

    def function(self, binary):
        records = [self.next() for _ in range(11)]
        self.require(records[-1] is not None, "ends within the header of a dataset 58")
        form = records[6]
        kind, count, spacing = (self.whole(form, begin, begin + 10) for begin in (0, 10, 20))
        self.require(kind in (2, 4, 5, 6), f"{kind} is not a valid type of values (2, 4, 5 or 6)")
        self.require(spacing in (0, 1), f"{spacing} is not a valid spacing (0: uneven, 1: even)")
        self.require(count >= 1, f"{count} is not a valid number of values")
        function = SimpleNamespace(
            title=field(records[0]), kind=self.whole(records[5], 0, 5), complex=kind >= 5, even=spacing == 1, first=0.0, step=0.0,
            rotational=bool(re.fullmatch(r"\s*[+-]?[456](\.0*)?\s*", records[5][51:55])), values=(), abscissae=(), imaginary=(),
            **{axis: Axis(self.whole(record, 0, 10), field(record[46:67]))
               for axis, record in zip(("abscissa", "ordinate", "denominator"), records[7:10])})
        if function.even:
            function.first, function.step = self.number(form, 30, 43), self.number(form, 43, 56)
            # Half a unit of the last written digit, for example 5e-10 of 1.95313E-04.
            function.rounding = 0.5 * 10.0 ** decimal.Decimal(python_number(form[43:56])).as_tuple().exponent \
                if math.isfinite(function.step) else 0.0
        columns, function.unreadable = self.bytes(function, count, 4 if kind in (2, 5) else 8, binary) if binary else \
            self.text(count, 1 + function.complex + (not function.even))
        # Complex functions do not decide whether time histories are accepted.
        self.require(not function.unreadable or function.complex or binary, function.unreadable)
        if not function.unreadable:
            function.abscissae = () if function.even else columns.pop(0)
            function.values, function.imaginary = columns[0], columns[-1] if function.complex else ()
        return function

    def text(self, count, parts):
        """Columns of numbers separated by blanks, or next to each other in the formats E13.5 and E20.12; or a problem."""
        end = DATASET_END.search(self.data, self.at - 1)
        text = self.data[self.at:end.start() if end else len(self.data)].upper().replace(b"D", b"E")
        try:
            numbers = np.array(text.split()).astype(np.float64)
        except ValueError:
            numbers = np.array([float(python_number(n.group().decode())) for n in FORTRAN_NUMBER.finditer(text)])
            if other := re.search(rb"\S+", FORTRAN_NUMBER.sub(lambda number: b" " * len(number.group()), text)):
                self.line += text.count(b"\n", 0, other.start()) + 1
                self.require(False, f'"{file_text(other.group())[:40]}" is not part of a number')
        self.line += text.count(b"\n") + 1
        self.at = end.end() if end else len(self.data)
        if len(numbers) != count * parts:
            return [], (f"only {len(numbers) // parts} of {count} values are present" if len(numbers) < count * parts else
                        f"more than the {count} declared values are present")
        return list(numbers.reshape(count, parts).T), ""

    def bytes(self, function, count, width, head):
        """Columns of binary numbers, or a problem."""
        order, form, declared = self.whole(head, 7, 13), self.whole(head, 13, 19), self.number(head, 31, 43)
        widths = [width] * (1 + function.complex)
        if not function.even:  # abscissae are in single precision; some programs write them as the values
            widths.insert(0, width if declared == count * (sum(widths) + width) else 4)
        row, start, left = sum(widths), self.at, len(self.data) - self.at
        self.require(declared in (0, count * row), f"declares {declared:g} bytes, but its {count} values take {count * row}")
        self.require(left >= count * row, f"only {left // row} of {count} values are present")
        self.at += count * row
        self.rest_of_dataset(f"more than the {count} declared values are present")
        if order not in (1, 2) or form not in (1, 2, 3):
            return [], (f"{form} is not a valid format of binary numbers" if order in (1, 2) else
                        f"{order} is not a valid byte order (1 or 2)")
        if form == 1 and (width == 8 or order == 2):
            return [], "its values are DEC VMS numbers of double precision or in reverse byte order, which are not supported"
        code = " <>"[order] + ("f" if form == 2 else "u")
        rows = np.frombuffer(self.data, [(str(i), f"{code}{w}") for i, w in enumerate(widths)], count, start)
        convert = {1: dec_numbers, 2: lambda raw: raw.astype(np.float64), 3: ibm_numbers}[form]
        return [convert(rows[str(i)]) for i in range(len(widths))], ""


def ibm_numbers(raw):
    """Hexadecimal numbers of IBM 370: an exponent to the base 16 and a fraction."""
    bits, raw = 8 * raw.dtype.itemsize - 8, raw.astype(np.uint64)
    exponent = (raw >> np.uint64(bits) & np.uint64(127)).astype(int) - 64
    size = np.ldexp((raw & np.uint64(2**bits - 1)).astype(float), 4 * exponent - bits)
    return np.where(raw >> np.uint64(bits + 7) & np.uint64(1), -size, size)


def dec_numbers(raw):
    """F_floating numbers of DEC VAX: two little-endian words, the more significant one first."""
    raw = (raw & 0xFFFF).astype(np.int64) << 16 | raw.astype(np.int64) >> 16
    size = np.ldexp((raw & 0x7FFFFF | 0x800000).astype(float), (raw >> 23 & 255) - 128 - 24)
    return np.where(raw >> 23 & 255, np.where(raw >> 31 & 1, -size, size), 0.0)


def other_kind(function):
    """Kind of a function that is not a real time history, otherwise "". """
    kind, axis = function.kind, function.abscissa
    if kind not in (0, 1):
        return FUNCTIONS[kind] if 0 <= kind < len(FUNCTIONS) else f"function type {kind}"
    if axis.kind != TIME and not (kind == 1 and axis.kind in (0, 1) and axis.unit.lower() in TIME_UNITS):
        return f"function of {axis.quantity}"
    return "complex time response" if function.complex else ""


def unit_of(function):
    """Unit of the ordinate, or why there is none: its label must agree with its quantity and with dataset 164."""
    ordinate, denominator, lengths = function.ordinate, function.denominator, function.lengths
    label, unit = ordinate.unit.lower(), ordinate.unit
    by_lengths = next((f"{name}/s^2" for name, count in LENGTHS.items() if lengths and abs(lengths / count - 1) < 1e-4),
                      f"1/{lengths:g} of m/s^2, by dataset 164" if lengths else "")
    if denominator.kind != 0 or denominator.unit:
        return f"{unit or ordinate.quantity} per {denominator.unit or denominator.quantity} by the function's denominator"
    if ordinate.kind in (TIME, SPEED):
        return unit or ("rpm" if ordinate.kind == SPEED else "")
    if ordinate.kind not in (0, 1, ACCELERATION):
        return unit if re.fullmatch(ANGULAR.get(ordinate.quantity, ""), label) and unit else \
            f"{ordinate.text()}, ordinate data type {ordinate.kind}"
    if unit:
        length = re.match("(mm|cm|um|in|ft|m)[ ./*]*s", label)
        agrees = not lengths or (abs(lengths / LENGTHS[length[1]] - 1) < 1e-4 if length else
                                 lengths == 1 or not re.fullmatch("m?g|gn|g_n|g0", label))
        return unit if agrees else f"{unit} by the function's label, but {by_lengths} by dataset 164"
    if ordinate.kind == ACCELERATION:
        return "rad/s^2" if function.rotational else by_lengths
    return f"not stated, with {lengths:g} units of length per metre by dataset 164" if lengths not in (None, 1) else ""


def state_sampling(channel, function):
    """States the whole number of Hz that rounds to the step, if there is exactly one; otherwise the step's rate."""
    second, margin = TIME_UNITS.get(function.abscissa.unit.lower()), 1e-9
    if second is None:
        raise ValueError(f"{function.abscissa.unit} is not a known unit of its times")
    rate, step, rounding = rate_of(function.step, second), function.step * second, function.rounding * second
    lowest = math.ceil((1.0 - margin) / (step + rounding))
    whole = rounding < step and lowest == math.floor((1.0 + margin) / (step - rounding))
    channel.sampling_Hz, channel.start_s = float(lowest) if whole else rate, function.first * second
    if channel.sampling_Hz != rate:
        channel.note = f"the rate is {channel.sampling_Hz:.0f} Hz, which rounds to the time step {step:g} s"


def read_uff(path):
    functions = UniversalFile(path).functions
    kinds = [other_kind(function) for function in functions]
    require(not all(kinds), f"contains no real time history; its functions are: {', '.join(dict.fromkeys(kinds))}")
    histories = [(f"function{i}", function) for i, (function, kind) in enumerate(zip(functions, kinds), 1) if not kind]
    channels, times, alone = [], [], len(histories) == 1
    for name, function in histories:
        name, title = ("sensor", "") if alone else (name, function.title)
        channel = Channel(name=name, values=function.values, title=title, text=name + (f" ({title})" if title else ""),
                          unit=unit_of(function))
        channels.append(channel)
        try:
            if function.unreadable:
                raise ValueError(function.unreadable)
            if function.even:
                state_sampling(channel, function)
        except ValueError as problem:
            channel.unreadable = f"column {name}: {problem}"
        if not function.even and not function.unreadable:
            same = [t for t in times if np.array_equal(t.values, function.abscissae)]
            if not same:
                first = not times and not any(f.even for _, f in histories)
                same = [Channel(name="time" if first else f"time of {name}", values=function.abscissae, unit=function.abscissa.unit)]
                times += same
            channel.times = same[0].name
    return Recording(channels + times)


def si_factor(axis):
    """Quantity and unit of an axis after multiplication by the factor: m/s^2 or N if it can be converted."""
    length = re.fullmatch(r"(mm|cm|um|in|ft|m)(/s(ec)?(\^|\*\*)?[2²]|/s/s| ?s\^?-2)", axis.unit.lower())
    if axis.kind in (0, 1, ACCELERATION) and (length or axis.unit.lower() in ("g", "")):
        return "acceleration in m/s^2", 1 / LENGTHS[length[1]] if length else 9.80665 if axis.unit else 1.0
    if axis.kind == FORCE and not axis.unit or axis.kind in (0, 1, FORCE) and axis.unit in ("N", "kN"):
        return "excitation force in N", 1e3 if axis.unit == "kN" else 1.0
    return axis.text(), 1.0


def write_uff_responses(path, output):
    """Frequency responses as a table with the axes in place of units."""
    columns, functions = {}, [f for f in UniversalFile(path).functions if f.kind in (4, 5)]
    require(functions, "contains no frequency response")
    for i, f in enumerate(functions, 1):
        (above, factor), (below, divisor), end = si_factor(f.ordinate), si_factor(f.denominator), f" {i}" * (len(functions) > 1)
        values = np.array(f.values, complex) + (1j * np.asarray(f.imaginary) if f.complex else 0)
        if bool(f.ordinate.unit) != bool(f.denominator.unit):  # one unit alone does not state the ratio
            above, below = f.ordinate.text(), f.denominator.text()
        known = f.abscissa.kind in (0, 1, FREQUENCY) and f.abscissa.unit.lower() in ("", "hz")
        for name, axes, numbers in (("frequency", "frequency in Hz" if known else f.abscissa.text(),
                                     f.first + f.step * np.arange(len(values)) if f.even else f.abscissae),
                                    ("gain", f"{above} over {below}", factor / divisor * abs(values)),
                                    ("phase", f"{above} over {below}", np.degrees(np.angle(values)))):
            columns[f"{name}{end} [{f.unreadable or axes}]"] = np.asarray(numbers).tolist()
    with open(output, "w", encoding="utf-8", newline="\n") as file:
        csv.writer(file, lineterminator="\n").writerows([columns, *itertools.zip_longest(*columns.values(), fillvalue="")])


# Text tables. The output is plain CSV: the names in a line before the first one, then each row in the line where it begins.

FREE_TEXT, TEXT_PER_BYTE = 64 << 20, 200  # of compressed files: recordings shrink to a third or a twentieth
SAMPLE_LINES, SAMPLE_BYTES, LONGEST_FIELD = 200, 1 << 19, 1 << 22
BLANKS, ONE_FIELD, SEPARATORS = " ", "", (";", "\t", ",", " ", "")  # runs of blanks; none
END = "\x1a"  # line after the last one
MISSING = {"", *"- -- NA N/A n/a #N/A NaN nan NAN null NULL None <NA>".split()}
NUMBER = re.compile(r"[+-]?(([0-9]+[.,]?[0-9]*|[.,][0-9]+)(e[+-]?[0-9]+)?|inf(inity)?|nan)", re.IGNORECASE)
GROUPED = re.compile(r"[+-]?[1-9][0-9]{0,2}(,[0-9]{3})+")  # may have thousands separators
TIME_STAMP = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}[T ][0-9]{2}:")
UNIT_TERM = ("(?:1|[mkuµμ]?(?:m|s|g|rad|V|Hz|N|Nm|Pa|W|A|bar)|cm|in|ft|MPa|GPa|m?sec|usec|seconds?|min|minutes?|h|hours?|deg|degrees|"
             r"[°%]|°[CF]|degC|K|turns?|revs?|revolutions|r|U|rpm|RPM|G|dB|[vV]olts?)(?:(?:\^|\*\*)?[-⁻]?[0-9²³¹])?")
UNIT = re.compile(rf"{UNIT_TERM}(?:[ */·.]\(?{UNIT_TERM})*\)?(?: ?\(.*\))?")
Record = collections.namedtuple("Record", "first last fields named")  # its lines; `named`: fields up to the last one with text


def is_number(text):
    return NUMBER.fullmatch(text) is not None


def bare(text):
    """Text without brackets around all of it."""
    return re.sub(r"^[\[(](.*)[\])]$", r"\1", text)


def is_comment(line):
    return line.lstrip(' \t"').startswith("#")


def text_lines(path):
    """Lines of a file in UTF-8, Latin-1 or UTF-16, perhaps compressed with gzip."""
    with open(path, "rb") as file:
        zipped = file.read(2) == b"\x1f\x8b"
    opened, characters = gzip.open if zipped else open, 0
    most = FREE_TEXT + TEXT_PER_BYTE * os.stat(path).st_size
    try:
        with opened(path, "rb") as file:
            wide = file.read(2) in (b"\xff\xfe", b"\xfe\xff")
        with opened(path, "rt", encoding="utf-16" if wide else "utf-8-sig", errors="strict" if wide else "surrogateescape") as file:
            for number, line in enumerate(file, 1):
                characters += len(line)
                require(not zipped or characters <= most,
                        f"holds more than {most >> 20} MB of text, over {TEXT_PER_BYTE} times its size: not a recording")
                if "\0" in line:
                    raise Refusal(f":{number}: is not a line of text (UTF-16 needs a byte order mark)")
                yield line
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        how = "end too early: the file is truncated" if isinstance(error, EOFError) else f"are damaged ({error})"
        raise Refusal(f": the compressed data {how}") from error
    except UnicodeDecodeError as error:
        raise Refusal(": is not valid UTF-16") from error


def split_lines(lines, separator):
    """First line, last line and fields of each record. Quoted fields may have ends of lines, unless blanks separate."""
    lines = ("\n" if "#" in line and is_comment(line) else line for line in lines)
    if separator in (BLANKS, ONE_FIELD):
        for number, line in enumerate(lines, 1):
            # A unit in brackets belongs to the name before it.
            yield number, number, re.split(r"\s+(?![\[(\s])", line.strip()) if separator else [line.strip(' \t\n"')]
        return
    reader, last = csv.reader(lines, delimiter=separator, skipinitialspace=True), 0
    try:
        for fields in reader:
            yield last + 1, reader.line_num, [field.strip() for field in fields]
            last = reader.line_num
    except csv.Error as error:
        raise Refusal(f":{last + 1}: a quotation mark is not closed, or the line is longer than {LONGEST_FIELD} bytes") from error


def records(lines, separator):
    """Records of a table without comments, blank lines and rows of empty fields."""
    for first, last, fields in split_lines(lines, separator):
        if any(fields):
            named = fields if fields[-1] else fields[:max(i for i, field in enumerate(fields, 1) if field)]
            yield Record(first, last, fields, named)


class Layout:
    """Names of a table's columns, found in its first lines, if `separator` separates its fields."""

    def __init__(self, lines, separator):
        self.lines, self.separator, self.rows = lines, separator, list(records(lines, separator))
        self.header = self.units = None
        half = [row.fields for row in self.rows[len(self.rows) // 2:]]
        self.width = max(collections.Counter(map(len, half)).items(), key=lambda item: item[::-1])[0]
        columns = [[fields[c] for fields in half if c < len(fields) and fields[c] not in MISSING] for c in range(self.width)]
        self.numeric = [c for c, texts in enumerate(columns) if texts and 2 * sum(map(is_number, texts)) >= len(texts)]
        self.find_header()
        before = [i for i, line in enumerate(lines[:self.rows[0].first - 1], 1) if line.strip()]
        self.comment = before[-1] if before and is_comment(lines[before[-1] - 1]) else None
        names = next(records([lines[self.comment - 1].split("#", 1)[1]], separator), None) if self.comment else None
        # Names may be in a comment directly before the first row. Columns of numbers alone are called 1, 2, ...
        self.other_names = names.named if names and len(names.named) == self.width and not any(map(is_number, names.named)) else \
            [str(i + 1) for i in range(len(self.rows[0].named))] if len({len(row.named) for row in self.rows}) == 1 and \
            all(is_number(field) for row in self.rows for field in row.named) else []
        self.found = self.header is not None or bool(self.other_names)

    def fits(self, row):
        """True if the row has the usual number of fields, apart from empty ones at its end."""
        return len(row.fields) == self.width or len(row.named) <= self.width < len(row.fields)

    def is_row(self, row):
        return self.fits(row) and all(row.fields[c] in MISSING or is_number(row.fields[c]) for c in self.numeric)

    def is_names(self, row):
        return (self.fits(row) or len(row.named) in (self.width, self.width - 1)) and \
            not any(is_number(field) or field.endswith(":") for field in row.named)

    def find_header(self):
        """Numbers follow the names, perhaps after a line of units. Texts do not show where a header ends."""
        if self.numeric:
            first = next((i for i, row in enumerate(self.rows) if self.is_row(row)), 0)
            names = [i for i in range(first) if self.is_names(self.rows[i])]
            self.header = names[-1] if names else None
            if self.header and self.header - 1 in names and any(UNIT.fullmatch(bare(f)) for f in self.rows[self.header].named):
                self.header, self.units = self.header - 1, self.header
        else:
            self.header = next((i for i, row in enumerate(self.rows) if self.is_names(row) and
                                (i == 0 and self.fits(row) or all(map(self.fits, self.rows[i:])))), None)

    def consistency(self):
        """Share of the rows, names included, that fit."""
        rows = self.rows[self.header or 0:]
        return sum(map(self.fits, rows)) / len(rows)

    def has_decimal_commas(self):
        """True if there is one name above numbers with commas."""
        rows = self.rows[self.header or 0:]
        return self.separator == "," and len(rows[0].named) == 1 and not any("." in f for row in rows[1:] for f in row.fields)

    def has_row_names(self):
        """True if the rows begin with names that the header does not name, as R writes them: quoted, or counted from 1."""
        header = self.rows[self.header or 0]
        rows = self.rows[(self.units or self.header or 0) + 1:]
        return len(header.fields) == len(header.named) == self.width - 1 and bool(rows) and all(
            row.fields[-1] and (row.fields[0] == str(i) or self.lines[row.first - 1].startswith('"')) for i, row in enumerate(rows, 1))

    def names(self):
        """Names with their units, the numbers of their lines, and that of the last line before the rows."""
        if self.header is None and self.other_names:
            return self.other_names, {self.comment}, self.rows[0].first - 1
        header, own = self.rows[self.header or 0], []
        names, last = [""] * self.has_row_names() + header.named, header.last
        if self.units:
            own, last = self.rows[self.units], self.rows[self.units].last
            for i, unit in enumerate(map(bare, own.fields), len(names) - len(header.named)):
                if unit in ("", "-") or i >= len(names) or not names[i]:
                    continue
                stated = re.search(r"\[(.*)\]$|\((.*)\)$", names[i])
                given = stated and (stated[1] or UNIT.fullmatch(stated[2] or "") and stated[2])
                if given and given != unit:
                    raise Refusal(f":{last}: column {names[i]}: unit {unit}, but the line before states {given}")
                names[i] += "" if given else f" [{unit}]"
            own = range(own.first, last + 1)
        return names, {*range(header.first, header.last + 1), *own}, last


def decimal_comma_columns(rows, count, separator):
    """Columns whose commas are decimal commas. Those that may be thousands separators stay, and are no numbers."""
    points, commas, groups, plain = set(), set(), set(), set()
    for fields in rows:
        for c, text in enumerate(fields[:count]):
            if "," in text:
                if c not in commas and NUMBER.fullmatch(text):
                    (groups if GROUPED.fullmatch(text) else commas).add(c)
            elif c not in points and ("." in text or c not in plain) and NUMBER.fullmatch(text):
                (points if "." in text else plain).add(c)
    doubtful = groups if points or separator == "," else groups & plain
    return (commas | groups - doubtful) - points


def seconds_since(start, text):
    """Seconds between two time stamps; the text if it is none."""
    try:
        return repr((datetime.datetime.fromisoformat(text) - datetime.datetime.fromisoformat(start)).total_seconds())
    except (ValueError, TypeError):
        return text


def table_layout(lines):
    """Layout with the separator that is stated, or that splits most of the first lines into equal numbers of fields."""
    stated = re.match(r'\s*"?sep=(.)"?\s*$', "".join(lines[:1]))
    lines = ["\n", *lines[1:]] if stated else lines
    require(any(re.search(r'[^,;\s"]', line) and not is_comment(line) for line in lines),
            "is empty; a header line of column names must come first")
    if stated:
        return Layout(lines, stated[1])
    *split, blanks, single = (Layout(lines, separator) for separator in SEPARATORS)
    good = [layout for layout in split if layout.width > 1 and layout.found and not layout.has_decimal_commas()]
    if good:
        return max(good, key=Layout.consistency)
    if blanks.found and len(blanks.names()[0]) > 1 and blanks.consistency() == 1:
        return blanks
    header = single.rows[single.header or 0].fields[0]  # names that no row fits: the message about the first row states it
    return next((layout for layout in split if layout.separator in header), single)


def write_plain_csv(path, output):
    csv.field_size_limit(LONGEST_FIELD)
    lines, size, sampled = [], 0, 0
    for line in text_lines(path):
        lines.append(line)
        size, sampled = size + len(line), sampled + bool(line.strip() and not is_comment(line))
        if size > SAMPLE_BYTES or sampled == SAMPLE_LINES:
            break
    layout = table_layout(lines)
    names, own_lines, last = layout.names()

    def rows():
        for record in records(itertools.chain(text_lines(path), [END]), layout.separator):
            if record.named == [END]:
                return
            if record.first > last:
                yield record
        raise Refusal(f":{record.first}: a quotation mark is not closed")

    commas = decimal_comma_columns((row.fields for row in rows()), len(names), layout.separator)
    times = {c: text for row in itertools.islice(rows(), 1) for c, text in enumerate(row.fields[:len(names)])
             if TIME_STAMP.match(text) and "time" in names[c].lower()}
    with open(output, "w", encoding="utf-8", errors="surrogateescape", newline="\n") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([name.replace("\n", " ") + " [s]" * (c in times and "[" not in name) for c, name in enumerate(names)])
        file.writelines("#" + ("\n" if number in own_lines else line.strip() + "\n") for number, line in enumerate(lines[:last], 1))
        written = last
        for row in rows():
            fields = row.fields[:len(names)] if len(row.named) <= len(names) else row.fields
            if len(fields) == len(names):
                for c in commas:
                    fields[c] = fields[c].replace(",", ".")
                for c in times:
                    fields[c] = seconds_since(times[c], fields[c])
            file.write("#\n" * (row.first - 1 - written))
            writer.writerow(fields if row.first == row.last else [field.replace("\n", " ") for field in fields])
            written = row.first


# The process


READERS = {"mat": read_mat, "sound": read_sound, "tdms": read_tdms, "uff": read_uff}
TABLES = {"text": write_plain_csv, "responses": write_uff_responses}


def write_recording(recording, path):
    """Writes the values, and all statements as JSON."""
    channels = []
    with h5py.File(path, "w") as file:
        for i, channel in enumerate(recording.channels):
            dataset = file.create_dataset(f"{i:06}", data=np.atleast_2d(np.asarray(channel.values, dtype=np.float64)))
            channels.append({"text": channel.name, "shape": dataset.shape})
            for name, value in vars(channel).items():
                if isinstance(value, str) and value:
                    channels[-1][name] = value.replace("\0", "?").encode(errors="replace").decode()
                elif isinstance(value, float) and math.isfinite(value):
                    channels[-1][name] = value
        file.attrs["recording"] = json.dumps({"separator": recording.separator, "note": recording.note, "channels": channels})


def load_libraries():
    global h5py, np
    import h5py
    import numpy as np


def limit_resources(size):
    with open("/proc/self/statm", encoding="ascii") as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    seconds = FREE_SECONDS + size // BYTES_PER_SECOND
    for what, most in ((resource.RLIMIT_AS, used + FREE_MEMORY + MEMORY_PER_BYTE * size), (resource.RLIMIT_CPU, seconds),
                       (resource.RLIMIT_FSIZE, FREE_MEMORY + MEMORY_PER_BYTE * size), (resource.RLIMIT_CORE, 0)):
        hard = resource.getrlimit(what)[1]
        resource.setrlimit(what, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    signal.alarm(4 * seconds)


def main(kind, path, output):
    missing = []
    for name in PACKAGES.get(kind, ("numpy", "h5py")):
        try:
            __import__(name)
        except ImportError:
            missing.append(name.partition(".")[0])
    try:
        require(not missing, f"reading it needs the Python packages {', '.join(missing)}, which {sys.executable} lacks; on Debian: "
                f"apt-get install {' '.join('python3-' + name for name in missing)}; GEARPOD_PYTHON names another Python")
        limit_resources(os.stat(path).st_size)
        warnings.simplefilter("ignore")
        if kind != "text":
            load_libraries()
        if kind in TABLES:
            TABLES[kind](path, output)
        else:
            write_recording(READERS[kind](path), output)
    except (Refusal, MemoryError) as problem:
        print(problem if isinstance(problem, Refusal) else ": is damaged, or needs more memory than reading a file may use", end="")
        return REFUSED
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
