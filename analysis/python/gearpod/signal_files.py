"""Reads recordings of other programs for gearpod: MAT, TDMS, universal and sound files.

The program contains this file and starts it once for each recording: python -c SOURCE KIND PATH OUT. The
process writes an HDF5 file with a dataset for each channel, in doubles, one row per column of a matrix.
Attributes state name, unit, sampling rate, start and problems (mc/files/foreign_file.hpp). If the file cannot be
read, the process prints the reason and ends with exit code 3. Memory and time are limited.
"""

# mypy: ignore-errors

import collections
import decimal
import itertools
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
from types import SimpleNamespace

os.environ["OPENBLAS_NUM_THREADS"] = "1"

try:
    import h5py
    import numpy as np
except ImportError:
    pass  # main() names what is missing

FREE_MEMORY, MEMORY_PER_BYTE = 256 << 20, 1000
FREE_SECONDS, BYTES_PER_SECOND = 20, 10_000_000
REFUSED = 3
PACKAGES = {"mat": ("numpy", "h5py", "scipy.io"), "sound": ("numpy", "h5py", "soundfile")}
TIME_UNITS = {name: factor for names, factor in (
    ("s sec secs second seconds none n/a null", 1.0), ("ms msec msecs millisecond milliseconds", 1e-3),
    ("us µs μs usec usecs microsecond microseconds", 1e-6), ("ns nsec nanosecond nanoseconds", 1e-9),
    ("min mins minute minutes", 60.0), ("h hr hrs hour hours", 3600.0)) for name in names.split()} | {"": 1.0}
Recording = collections.namedtuple("Recording", "channels separator note", defaults=("/", ""))  # separator in names of channels


class Refusal(Exception):
    """Reason why a file cannot be read, after the file's name in the message."""


class Channel(SimpleNamespace):
    """Channel of a recording: a vector, or a matrix with a row for each column of the file's matrix, and statements
    (ForeignChannel in mc/files/foreign_file.hpp). Empty texts and None are not stated."""

    values = ()
    text = title = unit = unit_text = unit_by_lengths = quantity = times = note = problem = unreadable = ""
    lengths_per_metre = sampling_Hz = start_s = None


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
                return evaluated(channel, holder, int(count) - 1)
        return raw_values(channel)


def raw_values(channel, scale=None):
    """Raw values of a scale, or the first ones."""
    blocks = channel.raw[next(iter(channel.raw)) if scale is None else scale]
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


def evaluated(channel, holder, scale):
    chain = []  # coefficients, from the last scale to the first
    while scale != RAW_INPUT and not (channel.daqmx and scale in channel.raw):
        if len(chain) == MOST_SCALES:
            raise ValueError("its scales form a circle")
        coefficients, scale = scale_of(holder, f"NI_Scale[{scale}]_", scale)
        chain.append(coefficients)
    values = raw_values(channel, scale if channel.daqmx and scale in channel.raw else None)
    for coefficients in chain[::-1]:
        values = np.polynomial.polynomial.polyval(values, coefficients or [0.0])
    return values


def scale_of(holder, prefix, number):
    """Coefficients of a scale from the constant to the highest power, and its input."""
    kind = stated(holder, prefix + "Scale_Type", str) or ""
    if kind not in ("Linear", "Polynomial"):
        raise ValueError(f"its scaling {kind or f'{number} is not stated, which'} is not supported{EXPORT}")
    names, count = ["Linear_Y_Intercept", "Linear_Slope"], stated(holder, prefix + "Polynomial_Coefficients_Size")
    if kind == "Polynomial":
        names = [f"Polynomial_Coefficients[{i}]" for i in range(MOST_SCALES) if i < (4.0 if count is None else count)]
    for name in names:
        if stated(holder, prefix + name) is None:
            raise ValueError(f"its scaling lacks the property {prefix}{name}")
    source = stated(holder, f"{prefix}{kind}_Input_Source")
    return [holder[prefix + name] for name in names], int(source) if source is not None and 0 <= source < RAW_INPUT else RAW_INPUT


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
            channel.values, channel.unit = raw_values(source), "s"
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
ACCELERATION, TIME, SPEED = 12, 17, 19
LENGTHS = {"m": 1.0, "cm": 100.0, "mm": 1000.0, "um": 1e6, "in": 1 / 0.0254, "ft": 1 / 0.3048}
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
        if self.at >= len(self.data):
            return None
        end = self.data.find(b"\n", self.at)
        end = len(self.data) if end < 0 else end
        line, self.at = file_text(self.data[self.at:end]), end + 1
        return line

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


def unit_statements(function):
    """Statements about the ordinate. The program compares a label with dataset 164 and with the quantity."""
    ordinate, denominator, lengths = function.ordinate, function.denominator, function.lengths
    by_lengths = next((f"{name}/s^2" for name, count in LENGTHS.items() if lengths and abs(lengths / count - 1) < 1e-4),
                      f"1/{lengths:g} of m/s^2, by dataset 164" if lengths else "")
    if denominator.kind != 0 or denominator.unit:
        return {"unit": f"{ordinate.unit or ordinate.quantity} per {denominator.unit or denominator.quantity} by the function's "
                        "denominator"}
    if ordinate.kind in (TIME, SPEED):
        return {"unit": ordinate.unit or ("rpm" if ordinate.kind == SPEED else "")}
    if ordinate.kind not in (0, 1, ACCELERATION):
        return {"unit": ordinate.unit, "quantity": ordinate.quantity,
                "unit_text": f"{ordinate.text()}, ordinate data type {ordinate.kind}"}
    if ordinate.unit:
        return {"unit": ordinate.unit, "lengths_per_metre": lengths, "unit_by_lengths": by_lengths}
    if ordinate.kind == ACCELERATION:
        return {"unit": "rad/s^2" if function.rotational else by_lengths}
    return {"unit": f"not stated, with {lengths:g} units of length per metre by dataset 164" if lengths not in (None, 1) else ""}


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
                          **unit_statements(function))
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


def read_uff_responses(path):
    """Frequency responses: rows are the frequency, the real and the imaginary part."""
    functions = [f for f in UniversalFile(path).functions if f.kind in (4, 5)]
    require(functions, "contains no frequency response")
    return Recording([
        Channel(name=f.abscissa.text(), title=f.ordinate.text(), text=f.denominator.text(), unit=f.ordinate.unit,
                unit_text=f.denominator.unit, unreadable=f.unreadable, values=() if f.unreadable else np.stack(
                    [f.first + f.step * np.arange(len(f.values)) if f.even else f.abscissae, f.values,
                     f.imaginary if f.complex else np.zeros(len(f.values))])) for f in functions])


# The process


READERS = {"mat": read_mat, "sound": read_sound, "tdms": read_tdms, "uff": read_uff, "responses": read_uff_responses}


def write_recording(recording, path):
    with h5py.File(path, "w") as file:
        file.attrs["separator"], file.attrs["note"] = recording.separator, recording.note
        for i, channel in enumerate(recording.channels):
            dataset = file.create_dataset(f"{i:06}", data=np.atleast_2d(np.asarray(channel.values, dtype=np.float64)))
            for name, value in vars(channel).items():
                if name != "values" and value not in (None, ""):
                    dataset.attrs[name] = value.replace("\0", "?") if isinstance(value, str) else float(value)


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
        write_recording(READERS[kind](path), output)
    except (Refusal, MemoryError) as problem:
        print(problem if isinstance(problem, Refusal) else ": is damaged, or needs more memory than reading a file may use", end="")
        return REFUSED
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
