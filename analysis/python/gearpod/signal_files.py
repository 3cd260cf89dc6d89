"""Reads recordings of other programs for gearpod: MAT, TDMS, universal and sound files.

The program contains this file and starts it once for each recording: python -c SOURCE KIND PATH OUT. The
process writes an HDF5 file with a dataset for each channel, in doubles, one row per column of a matrix.
Attributes state name, unit, sampling rate, start and problems (mc/files/foreign_file.hpp). If the file cannot be
read, the process prints the reason and ends with exit code 3. Memory and time are limited.
"""

# mypy: ignore-errors

import collections
import dataclasses
import itertools
import math
import mmap
import os
import re
import resource
import signal
import struct
import sys
import warnings

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
TIME_UNITS = {"": 1.0, "none": 1.0, "n/a": 1.0, "null": 1.0}
for names, factor in (("s sec secs second seconds", 1.0), ("ms msec msecs millisecond milliseconds", 1e-3),
                      ("us µs μs usec usecs microsecond microseconds", 1e-6), ("ns nsec nanosecond nanoseconds", 1e-9),
                      ("min mins minute minutes", 60.0), ("h hr hrs hour hours", 3600.0)):
    TIME_UNITS.update(dict.fromkeys(names.split(), factor))


class Refusal(Exception):
    """Reason why a file cannot be read. `line` is its place in a text file."""

    def __init__(self, reason, line=0):
        super().__init__(f":{line}: {reason}" if line else f": {reason}")


@dataclasses.dataclass
class Channel:
    """Channel of a recording. Empty texts and None are not stated."""

    name: str
    values: object = ()  # vector, or matrix with a row for each column of the file's matrix
    text: str = ""  # name and shape in lists of channels
    title: str = ""  # another name
    unit: str = ""
    unit_text: str = ""  # unit that is none of `unit`'s kind, in words
    unit_by_lengths: str = ""  # unit of acceleration by the file's unit of length
    lengths_per_metre: float = None
    quantity: str = ""  # quantity other than an acceleration
    sampling_Hz: float = None
    start_s: float = None
    times: str = ""  # name of the channel with the times of the samples
    note: str = ""  # lines to report if the channel is used
    problem: str = ""  # reason why it is not a column of numbers
    unreadable: str = ""  # reason why its values cannot be read


@dataclasses.dataclass
class Recording:
    channels: list
    separator: str = "/"  # between the parts of a channel's name
    note: str = ""


def file_text(raw):
    """Text in UTF-8, or in Latin-1 as recorders under Windows write it."""
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def shown(values):
    return "".join(c if c.isprintable() else "?" for c in values)


# MAT files


# Array of a MAT file that is not a numeric matrix. `kind` describes it in lists of channels.
NotNumbers = collections.namedtuple("NotNumbers", "kind problem", defaults=("",))
OBJECT = NotNumbers("table or object", "is a table, timetable or object, which is not supported; in MATLAB, save its columns as a "
                    "struct: s = table2struct(T, 'ToScalar', true); save('FILE', 's')")
ELSEWHERE = NotNumbers("in another file", "is stored in another file, which is not supported; copy it into this file")
SPARSE = NotNumbers("sparse", "is a sparse matrix; save a real, full vector")
DEEPEST, MOST_ARRAYS = 16, 20000


def elements_name(name, count, element):
    return name if count == 1 else f"{name}({element})"


def level5_arrays(path):
    """Names and arrays of the variables of MATLAB 4 to 7.2, and the names that occur more than once."""
    import scipy.io
    from scipy.io import matlab
    from scipy.sparse import issparse

    def arrays(name, value, depth):
        if isinstance(value, matlab.MatlabFunction):
            yield name, NotNumbers("not numbers")
        elif isinstance(value, (matlab.MatlabOpaque, matlab.MatlabObject)):
            yield name, OBJECT
        elif issparse(value):
            yield name, SPARSE
        elif value.dtype.names and depth < DEEPEST:
            elements = value.flatten(order="F")
            for e, element in enumerate(elements, 1):
                for field in value.dtype.names:
                    yield from arrays(f"{elements_name(name, len(elements), e)}.{field}", element[field], depth + 1)
        elif value.dtype == object and depth < DEEPEST:
            for e, element in enumerate(value.flatten(order="F"), 1):
                yield from arrays(f"{name}{{{e}}}", element, depth + 1)
        elif value.dtype.kind == "U":
            yield name, "".join(value.flatten().tolist()) if value.size <= 1 else NotNumbers("text")
        else:
            yield name, value

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        variables = scipy.io.loadmat(path)
    repeated = [found[1] for w in caught if (found := re.search(r'Duplicate variable name "(.*?)"', str(w.message)))]
    return ((pair for name, value in variables.items() if not name.startswith("__") for pair in arrays(name, value, 0)),
            repeated)


def level73_arrays(path):
    """Names and arrays of the variables of MATLAB 7.3, which are HDF5 datasets. Links are not followed."""

    def elements(name, dataset, depth, field=""):
        references = dataset[()].flatten()
        for e, reference in enumerate(references, 1):
            element = elements_name(name, len(references), e) + field if field else f"{name}{{{e}}}"
            yield from arrays(element, dataset.file[reference], depth + 1)

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
            yield from elements(name, item, depth)
        elif "MATLAB_object_decode" in item.attrs or not re.fullmatch("|double|single|logical|char|cell|u?int(8|16|32|64)", kind):
            yield name, OBJECT
        elif item.attrs.get("MATLAB_empty", 0):
            yield name, np.empty([int(n) for n in item[()].flatten()])
        elif kind == "char":
            yield name, "".join(map(chr, item[()].flatten().tolist())) if item.size <= 1000 else NotNumbers("text")
        elif item.dtype.names:
            yield name, np.empty(item.shape[::-1], complex)
        else:
            yield name, item[()].T if item.dtype.kind in "fiub" else NotNumbers("not numbers")

    def members(group, prefix, depth):
        """Variables, or fields of a struct. Those of an array of structs are references, in the order of its elements."""
        for key in group:
            if not isinstance(group.get(key, getlink=True), h5py.HardLink):
                yield prefix + key, ELSEWHERE
            elif prefix and isinstance(group[key], h5py.Dataset) and group[key].dtype == h5py.ref_dtype and \
                    "MATLAB_class" not in group[key].attrs:
                yield from elements(prefix[:-1], group[key], depth, "." + key)
            elif prefix or not key.startswith("#"):
                yield from arrays(prefix + key, group[key], depth + bool(prefix))

    def variables():
        with h5py.File(path, "r") as file:
            yield from members(file, "", 0)

    return variables(), []


def matrix_of(shape):
    """Dimensions of time and of columns of an array, or None. Of two dimensions larger than 1, the longer one is time."""
    wide = [d for d, size in enumerate(shape) if size != 1]
    if not shape or len(wide) > 2 or (len(wide) == 2 and shape[wide[0]] == shape[wide[1]]):
        return None
    return (*wide, *[None] * 2)[:2] if len(wide) < 2 else sorted(wide, key=lambda d: -shape[d])


def mat_channel(name, value):
    """Channel of an array of numbers or of another kind, with its values as rows."""
    if isinstance(value, str):
        value = NotNumbers("text")
    elif isinstance(value, np.ndarray) and value.dtype.kind not in "fiubc":
        value = NotNumbers("not numbers")
    if isinstance(value, NotNumbers):
        text = f"{name} ({value.kind})"
        return Channel(name, text=text, problem=f"{name} {value.problem}" if value.problem else f"{text} is not a column of numbers")
    shape = " x ".join(map(str, value.shape))
    form = matrix_of(value.shape)
    if np.iscomplexobj(value):
        return Channel(name, text=f"{name} (complex, {shape})", problem=f"{name} is complex; save a real, full vector")
    if form is None:
        return Channel(name, text=f"{name} ({shape})", problem=f"{name} has the shape {shape}; a column must be a vector, or a "
                       "column of a matrix whose longer dimension is time")
    time, columns = form
    if columns is None:
        return Channel(name, value.flatten(), text=f"{name} ({shape})")
    count = value.shape[columns]
    rows = np.moveaxis(value, (columns, time), (0, 1)).reshape(count, -1)
    return Channel(name, rows, text=f"{name} ({shape}; {name}:1 to {name}:{count})",
                   problem=f"{name} is a matrix of {shape}; choose one of its columns, {name}:1 to {name}:{count}")


def read_mat(path):
    with open(path, "rb") as file:
        if file.read(64) == bytes(64):
            raise Refusal("begins with zeros, as if it had not been written to its end")
    try:
        found, repeated = (level73_arrays if h5py.is_hdf5(path) else level5_arrays)(path)
        arrays = list(itertools.islice(found, MOST_ARRAYS + 1))
        if not arrays:
            raise ValueError("no variables")
    except MemoryError:
        raise
    except Exception as error:
        raise Refusal(f"is not a MAT file, or is damaged ({type(error).__name__}: {shown(str(error))[:200]})") from error
    if len(arrays) > MOST_ARRAYS:
        raise Refusal(f"contains more than {MOST_ARRAYS} arrays")
    objects = [name for name, value in arrays if value is OBJECT]
    if objects and not any(isinstance(value, np.ndarray) for _, value in arrays):
        raise Refusal(f"{objects[0]} {OBJECT.problem}")
    channels = [mat_channel(name, value) for name, value in arrays]
    texts, signals = collections.defaultdict(dict), collections.Counter()
    for name, value in arrays:
        group, leaf = parts_of(name)
        if isinstance(value, str):
            texts[group][plain(leaf)] = name, value
        signals[group] += isinstance(value, np.ndarray) and value.size > 1
    for channel in channels:
        group, leaf = parts_of(channel.name)
        notes = [f"the variable {variable} occurs more than once; the last one is used, as in MATLAB" for variable in repeated
                 if re.match(re.escape(variable) + r"($|[.({])", channel.name)]
        own, of_group = ([texts[group][start + end] for end in ("unit", "units") if start + end in texts[group]]
                         for start in (plain(leaf), ""))
        if own or of_group and signals[group] == 1:
            channel.unit = (own or of_group)[0][1]
        elif of_group and of_group[0][1]:
            notes.append("{} = {} is not used, because it may belong to several columns".format(*of_group[0]))
        channel.note = "\n".join(notes)
    return Recording(channels, separator=".")


def parts_of(name):
    group, _, leaf = name.rpartition(".")
    return group, leaf


def plain(name):
    return re.sub("[^a-z0-9]", "", name.lower())


# Sound files


def missing_bytes(path):
    """Number of bytes that the header declares but the file lacks. libsndfile shortens such a recording without an error.

    Sources: RIFF, EBU Tech 3306 (RF64), Sony Wave64, AIFF."""
    unknown = 0xFFFFFFFF  # length of a recording that was written to a pipe
    with open(path, "rb") as file:
        data = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    at, name_width, form, alignment, samples = 12, 4, "<I", 2, b"data"
    if data[:4] == b"FORM":
        form, samples = ">I", b"SSND"
    elif data[:4] == b"riff":
        at, name_width, form, alignment = 40, 16, "<Q", 8
    elif data[:4] not in (b"RIFF", b"RF64"):
        return 0
    head = name_width + struct.calcsize(form)
    length_of_rf64 = unknown
    while len(data) - at >= head:
        name, length = data[at:at + 4], struct.unpack_from(form, data, at + name_width)[0]
        length -= min(length, head) if name_width == 16 else 0
        at += head
        if name == b"ds64" and len(data) - at >= 16:
            length_of_rf64 = struct.unpack_from("<Q", data, at + 8)[0]
        if name == samples and length == unknown:
            length = length_of_rf64
            if length == unknown:
                return 0
        if name == samples or length > len(data) - at:
            return max(0, length - (len(data) - at))
        at += -(-length // alignment) * alignment
    return 0


def read_sound(path):
    """Integers are fractions of the full scale."""
    import soundfile

    lossless = {"PCM_S8", "PCM_U8", "PCM_16", "PCM_24", "PCM_32", "FLOAT", "DOUBLE", "ALAC_16", "ALAC_20", "ALAC_24", "ALAC_32"}
    try:
        file = soundfile.SoundFile(path)
    except soundfile.LibsndfileError as error:
        if "SF_INFO struct incomplete" in str(error):
            raise Refusal("is damaged: its header states no valid sampling rate or no channels") from error
        raise Refusal(f"is not a sound file, or is damaged; libsndfile reports: {error.error_string}") from error
    if file.format not in ("WAV", "WAVEX", "RF64", "W64", "FLAC", "AIFF", "AU", "CAF"):
        raise Refusal("is not a WAV, RF64, W64, FLAC, AIFF, AU or CAF file")
    if file.subtype not in lossless:
        raise Refusal(f"is compressed with loss ({file.subtype_info}); save it as plain samples (PCM) or FLAC")
    if file.channels <= 0 or file.frames <= 0:
        raise Refusal("is a sound file without samples")
    missing = missing_bytes(path)
    if missing:
        raise Refusal(f"is truncated: {missing} bytes are missing")
    blocks, frames = [], 1 << 16
    try:
        while not blocks or len(blocks[-1]) == frames:
            block = np.empty((frames, file.channels))
            blocks.append(block[:file.buffer_read_into(block, "float64")])
    except soundfile.LibsndfileError as error:
        count = sum(map(len, blocks))
        raise Refusal(f"is damaged after {count} samples; libsndfile reports: {error.error_string}") from error
    values = np.concatenate(blocks)
    if file.frames < 2**63 - 1 and len(values) < file.frames:  # streamed FLAC does not state its length
        raise Refusal(f"is truncated: only {len(values)} of {file.frames} samples are present")
    names = ["sensor"] if file.channels == 1 else [f"channel{c + 1}" for c in range(file.channels)]
    return Recording([Channel(name, values[:, c], sampling_Hz=float(file.samplerate)) for c, name in enumerate(names)])


# TDMS files. Source: National Instruments, "TDMS File Format Internal Structure".

TDMS_TYPES = {1: "i1", 2: "i2", 3: "i4", 4: "i8", 5: "u1", 6: "u2", 7: "u4", 8: "u8", 9: "f4", 10: "f8", 0x19: "f4", 0x1A: "f8",
              0x21: "u1"}
TDMS_STRING, TDMS_TIME = 0x20, 0x44
TDMS_WIDTHS = {**{kind: int(code[1:]) for kind, code in TDMS_TYPES.items()}, TDMS_TIME: 16, 0x08000C: 8, 0x10000D: 16}
SCALER_TYPES = (5, 1, 6, 2, 7, 3, 8, 4, 9, 10)
META_DATA, NEW_OBJECTS, RAW_DATA, INTERLEAVED, BIG_ENDIAN = 2, 4, 8, 32, 64
NO_DATA, AS_BEFORE, FORMAT_CHANGING, DIGITAL_LINE = 0xFFFFFFFF, 0, 0x1269, 0x126A
NOT_CLOSED = 2**64 - 1
RAW_INPUT = 0xFFFFFFFF  # input of a scale
MOST_SCALES = 64


class Damage(Exception):
    """Problem with a segment of a TDMS file. The file may be undamaged if `unsupported`."""

    def __init__(self, reason, unsupported=False):
        super().__init__(reason)
        self.unsupported = unsupported


def time_type(order):
    """Seconds since 1904, and fractions of a second as multiples of 2^-64."""
    names = [("fraction", order + "u8"), ("seconds", order + "i8")]
    return np.dtype(names if order == "<" else names[::-1])


class Cursor:
    """Reads metadata of a TDMS segment."""

    def __init__(self, data, order):
        self.data, self.order, self.at = data, order, 0

    def bytes(self, length):
        if length > len(self.data) - self.at:
            raise Damage("its metadata end too early")
        self.at += length
        return self.data[self.at - length:self.at]

    def number(self, code="u4"):
        return np.frombuffer(self.bytes(int(code[1:])), self.order + code)[0].item()

    def text(self):
        return file_text(self.bytes(self.number()))

    def property(self):
        """A text, a number as float, or a time in 2^-64 s as int."""
        kind = self.number()
        if kind == TDMS_STRING:
            return self.text()
        if kind == TDMS_TIME:
            time = np.frombuffer(self.bytes(16), time_type(self.order))[0]
            return int(time["seconds"]) * 2**64 + int(time["fraction"])
        if kind not in TDMS_TYPES:
            raise Damage(f"a property has the unknown type {kind:#x}")
        return float(self.number(TDMS_TYPES[kind]))


@dataclasses.dataclass
class Index:
    """Data of an object in each chunk of a segment. DAQmx: `scalers` have type, buffer, offset and number of the scale."""

    kind: int
    count: int
    size: int = 0
    daqmx: bool = False
    scalers: list = dataclasses.field(default_factory=list)
    buffers: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class TdmsChannel:
    path: str
    group: str
    name: str
    kind: int = 0
    daqmx: bool = False
    raw: dict = dataclasses.field(default_factory=dict)  # by scale: blocks of position, stride, count, type, order
    properties: dict = dataclasses.field(default_factory=dict)


def read_index(cursor, length):
    kind, dimensions, count = cursor.number(), cursor.number(), cursor.number("u8")
    if dimensions != 1:
        raise Damage("a channel has arrays of several dimensions")
    if length == DIGITAL_LINE:
        raise Damage("it has raw data of DAQmx digital lines, which are not supported; save the file with scaled values, or "
                     "export it as CSV", True)
    if length == FORMAT_CHANGING:
        index = Index(kind, count, daqmx=True)
        for _ in range(cursor.number()):
            scaler, buffer, offset, _, scale = (cursor.number() for _ in range(5))
            if scaler >= len(SCALER_TYPES):
                raise Damage(f"its DAQmx data have the unknown type {scaler}")
            index.scalers.append((SCALER_TYPES[scaler], buffer, offset, scale))
        index.buffers = [cursor.number() for _ in range(cursor.number())]
        return index
    if kind == TDMS_STRING:
        return Index(kind, count, cursor.number("u8"))
    if kind not in TDMS_WIDTHS:
        raise Damage(f"a channel has the type {kind:#x}, which is not supported", True)
    return Index(kind, count, count * TDMS_WIDTHS[kind])


def path_names(path):
    """Names in a path such as /'group'/'channel'; a quote in a name is doubled."""
    if path != "/" and not re.fullmatch("(/'([^']|'')*'){1,2}", path, re.DOTALL):
        raise Damage("an object has an invalid path")
    return [name.replace("''", "'") for name in re.findall("/'((?:[^']|'')*)'", path)]


class TdmsFile:
    """Objects of a TDMS file, and the positions of their raw data."""

    def __init__(self, data):
        self.data, self.closed = data, True
        self.properties, self.groups, self.channels = {}, {}, {}
        self.indices, self.active = {}, []  # by path; paths with data in this segment
        at = 0
        while at < len(data):
            try:
                at = self.read_segment(at)
            except Damage as damage:
                how = "cannot be read because of the" if damage.unsupported else "is damaged or truncated in the"
                raise Refusal(f"{how} segment at byte {at}: {damage}") from damage

    def read_segment(self, at):
        """Returns the position of the next segment."""
        lead = self.data[at:at + 28]
        if len(lead) < 28:
            raise Damage("it ends too early")
        if lead[:4] != b"TDSm":
            raise Damage("it does not begin with TDSm")
        contents = struct.unpack_from("<I", lead, 4)[0]
        self.order = ">" if contents & BIG_ENDIAN else "<"
        length, raw = struct.unpack_from(self.order + "QQ", lead, 12)
        at += 28
        rest = len(self.data) - at
        # A program that ended while it was recording leaves the last segment without its length.
        self.closed = length != NOT_CLOSED
        length = length if self.closed else rest
        if length > rest:
            raise Damage(f"it lacks {length - rest} bytes")
        if raw > length:
            raise Damage("its raw data begin after its end")
        if contents & NEW_OBJECTS:
            self.active = []
        if contents & META_DATA:
            self.read_objects(Cursor(self.data[at:at + raw], self.order))
        if contents & RAW_DATA and length > raw:
            self.add_chunks(at + raw, length - raw, contents & INTERLEAVED)
        return at + length

    def read_objects(self, cursor):
        for _ in range(cursor.number()):
            path = cursor.text()
            names = path_names(path)
            length = cursor.number()
            properties = self.properties
            if len(names) == 2:
                channel = self.channels.setdefault(path, TdmsChannel(path, *names))
                properties = channel.properties
                self.update_index(cursor, length, path)
            elif length != NO_DATA:
                raise Damage("a group has raw data")
            elif names:
                properties = self.groups.setdefault(names[0], {})
            for _ in range(cursor.number()):
                name = cursor.text()
                properties[name] = cursor.property()

    def update_index(self, cursor, length, path):
        if length == NO_DATA:
            self.active = [other for other in self.active if other != path]
            return
        if length != AS_BEFORE:
            self.indices[path] = read_index(cursor, length)
        elif path not in self.indices:
            raise Damage("a channel refers to an earlier segment that lacks it")
        if path not in self.active:
            self.active.append(path)

    def chunks_in(self, length, chunk):
        """Number of chunks; the last one may be incomplete if the file was not closed."""
        if chunk == 0 or (self.closed and length % chunk != 0):
            raise Damage("its raw data are not a whole number of chunks")
        return length // chunk

    def add_chunks(self, at, length, interleaved):
        used = [(self.channels[path], self.indices[path]) for path in self.active]
        if any(index.daqmx for _, index in used):
            self.add_daqmx(at, length, used)
        elif interleaved:
            counts = {index.count for _, index in used}
            if len(counts) > 1 or any(index.kind == TDMS_STRING for _, index in used):
                raise Damage("its interleaved channels have different numbers of values")
            row, rows = sum(TDMS_WIDTHS[index.kind] for _, index in used), max(counts, default=0)
            rows = rows if row and length // row >= rows else 0
            count = self.chunks_in(length, row * rows) * rows if self.closed else length // max(1, row)
            for channel, index in used:
                self.add_block(channel, 0, at, row, count, index.kind)
                at += TDMS_WIDTHS[index.kind]
        else:
            for _ in range(self.chunks_in(length, sum(index.size for _, index in used))):
                for channel, index in used:
                    if index.kind != TDMS_STRING:
                        self.add_block(channel, 0, at, TDMS_WIDTHS[index.kind], index.count, index.kind)
                    at += index.size

    def add_daqmx(self, at, length, used):
        """A chunk has one buffer after another, and each buffer has rows of its width."""
        first = used[0][1]
        before = [sum(first.buffers[:b]) for b in range(len(first.buffers) + 1)]
        row = before[-1]
        for _, index in used:
            if not index.daqmx or index.count != first.count or index.buffers != first.buffers:
                raise Damage("its DAQmx channels have different numbers of values")
            for kind, buffer, offset, _ in index.scalers:
                if buffer >= len(first.buffers) or offset + TDMS_WIDTHS[kind] > first.buffers[buffer]:
                    raise Damage("a DAQmx channel lies outside of its buffer")
        if row == 0 or first.count == 0 or length // row < first.count:
            raise Damage("its raw data are not a whole number of chunks")
        for _ in range(self.chunks_in(length, row * first.count)):
            for channel, index in used:
                channel.daqmx = True
                for kind, buffer, offset, scale in index.scalers:
                    self.add_block(channel, scale, at + before[buffer] * first.count + offset, first.buffers[buffer], first.count,
                                   kind)
            at += row * first.count

    def add_block(self, channel, scale, first, stride, count, kind):
        if count == 0:
            return
        if channel.kind not in (0, kind) and not channel.daqmx:
            raise Damage("a channel changes its type")
        channel.kind = kind
        blocks = channel.raw.setdefault(scale, [])
        if blocks:
            last = blocks[-1]
            if last[0] + last[2] * last[1] == first and last[1:2] + last[3:] == [stride, kind, self.order]:
                last[2] += count
                return
        blocks.append([first, stride, count, kind, self.order])

    def arrays(self, blocks):
        for first, stride, count, kind, order in blocks:
            dtype = time_type(order) if kind == TDMS_TIME else np.dtype(order + TDMS_TYPES[kind])
            yield np.ndarray(count, dtype, self.data, first, stride)

    def numbers(self, blocks):
        return np.concatenate([array.astype(np.float64) for array in self.arrays(blocks)])

    def times(self, blocks):
        """Seconds from the first time."""
        seconds, fraction = (np.concatenate([array[part].astype(code) for array in self.arrays(blocks)])
                             for part, code in (("seconds", "i8"), ("fraction", "u8")))
        parts = (fraction >> np.uint64(11)).astype(np.float64)  # 53 bits are exact
        return seconds.astype(float) - float(seconds[0]) + np.ldexp(parts - parts[0], -53)

    def scaled(self, channel):
        """Values after the last of the channel's scales."""
        blocks = next(iter(channel.raw.values()))
        for holder in (channel.properties, self.groups.get(channel.group, {}), self.properties):
            count = number_of(holder, "NI_Number_Of_Scales")
            if count is None:
                continue
            status = text_of(holder, "NI_Scaling_Status")
            if status not in ("", "unscaled") and not channel.daqmx:
                if status == "scaled":
                    break
                raise Damage(f'its scaling status "{status}" is unknown')
            if not 0 <= count <= MOST_SCALES:
                raise Damage(f"{count:g} is not a valid number of scales")
            if count > 0:
                return self.evaluate(channel, holder, int(count) - 1)
        return self.numbers(blocks)

    def evaluate(self, channel, holder, scale):
        chain = []  # coefficients, from the last scale to the first
        while True:
            if channel.daqmx and scale in channel.raw:
                blocks = channel.raw[scale]
                break
            if scale == RAW_INPUT:
                blocks = next(iter(channel.raw.values()))
                break
            if len(chain) == MOST_SCALES:
                raise Damage("its scales form a circle")
            coefficients, scale = scale_of(holder, scale)
            chain.append(coefficients)
        values = self.numbers(blocks)
        for coefficients in chain[::-1]:
            total = 0.0
            for coefficient in coefficients[::-1]:
                total = total * values + coefficient
            values = total
        return values


def number_of(properties, name):
    value = properties.get(name)
    return value if isinstance(value, float) else None


def text_of(properties, name):
    value = properties.get(name)
    return value if isinstance(value, str) else ""


def scale_of(holder, number):
    """Coefficients of a scale from the constant to the highest power, and its input."""
    prefix = f"NI_Scale[{number}]_"
    kind = text_of(holder, prefix + "Scale_Type")

    def value(key):
        found = number_of(holder, prefix + key)
        if found is None:
            raise Damage(f"its scaling lacks the property {prefix}{key}")
        return found

    if kind not in ("Linear", "Polynomial"):
        raise Damage(f"its scaling {kind or f'{number} is not stated, which'} is not supported; save the file with scaled values, "
                     "or export it as CSV")
    source = number_of(holder, f"{prefix}{kind}_Input_Source")
    source = int(source) if source is not None and 0 <= source < RAW_INPUT else RAW_INPUT
    if kind == "Linear":
        return [value("Linear_Y_Intercept"), value("Linear_Slope")], source
    count = number_of(holder, prefix + "Polynomial_Coefficients_Size")
    count = 4.0 if count is None else count
    return [value(f"Polynomial_Coefficients[{i}]") for i in range(MOST_SCALES) if i < count], source


def sampling_of(properties, first_start):
    """Rate and start of a waveform; the rate is None if its abscissa is not time, the start counts from the first waveform."""
    step, second = number_of(properties, "wf_increment"), TIME_UNITS.get(text_of(properties, "wf_xunit_string").strip().lower())
    offset, start = number_of(properties, "wf_start_offset"), properties.get("wf_start_time")
    since = offset
    if isinstance(start, int):
        since = (start - first_start) / 2**64 + (offset or 0.0)
    if not step or second is None:
        return None, since
    seconds = step * second
    if not (seconds > 0 and 1 / seconds < float("inf")):
        raise Damage(f"{seconds:g} s is not a valid time step (wf_increment)")
    return 1.0 / seconds, since


def read_tdms(path):
    with open(path, "rb") as file:
        if not os.fstat(file.fileno()).st_size:
            raise Refusal("is empty")
        tdms = TdmsFile(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ))
    numeric = [c for c in tdms.channels.values() if c.raw and (c.kind in TDMS_TYPES or c.kind == TDMS_TIME)]
    if not numeric:
        others = ", ".join(tdms.channels)[:400] or "none"
        raise Refusal(f"has no channel with numbers or times; its channels are {others}")
    names = [f"{c.group}/{c.name}" for c in tdms.channels.values()]
    starts = [c.properties.get("wf_start_time") for c in tdms.channels.values()]
    first_start = next((start for start in starts if isinstance(start, int)), None)
    channels = []
    for source in numeric:
        name = f"{source.group}/{source.name}"
        channel = Channel(name if names.count(name) == 1 else source.path)
        channels.append(channel)
        if source.kind == TDMS_TIME:
            channel.values, channel.unit = tdms.times(next(iter(source.raw.values()))), "s"
            continue
        channel.unit = text_of(source.properties, "unit_string") or text_of(source.properties, "NI_UnitDescription")
        try:
            with np.errstate(all="ignore"):
                channel.values = tdms.scaled(source)
            channel.sampling_Hz, channel.start_s = sampling_of(source.properties, first_start)
        except Damage as damage:
            channel.unreadable = f"column {channel.name}: {damage}"
    note = "" if tdms.closed else "the file was not closed; values after the last complete ones are missing"
    return Recording(channels, note=note)


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
LENGTHS = ((1.0, "m"), (100.0, "cm"), (1000.0, "mm"), (1e6, "um"), (1 / 0.0254, "in"), (1 / 0.3048, "ft"))


def quantity_name(kind):
    return QUANTITIES[kind] if 0 <= kind < len(QUANTITIES) else f"specific data type {kind}"


def fortran_number(text):
    """Number whose exponent may begin with D, or have no letter if it has three digits. Raises ValueError."""
    return float(re.sub(r"(?<=[0-9.])([+-][0-9]+)$", r"E\1", text.strip().upper().replace("D", "E")))


FORTRAN_NUMBER = re.compile(rb"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)(E[+-]?[0-9]+|[+-][0-9]{3}(?![0-9.]))?")


def rounding_of(number):
    """Half a unit of the last written digit, for example 5e-10 of 1.95313E-04."""
    digits = re.match("[-+0-9.]*", number).group()
    try:
        power = fortran_number("1" + number[len(digits):])
    except ValueError:
        power = 1.0
    return 0.5 * power * 10.0 ** -len(digits.partition(".")[2])


@dataclasses.dataclass
class Axis:
    kind: int
    unit: str

    def text(self):
        return quantity_name(self.kind) + (f" in {self.unit}" if self.unit else "")


@dataclasses.dataclass
class Function:
    """Measured function of a dataset 58. Uneven ones have `abscissae`, complex ones `imaginary` parts."""

    title: str
    kind: int
    direction: int
    complex: bool
    even: bool
    first: float
    step: float
    rounding: float
    abscissa: Axis
    ordinate: Axis
    denominator: Axis
    lengths: float = None  # the file's units of length in a metre
    values: object = ()
    abscissae: object = ()
    imaginary: object = ()
    unreadable: str = ""

    def take(self, columns):
        """Takes the columns of a dataset: abscissae unless even, values, and the imaginary parts of complex ones."""
        self.abscissae = () if self.even else columns.pop(0)
        self.values, self.imaginary = columns[0], columns[-1] if self.complex else ()


def stated(text):
    """Text of a field; NONE means that it is not used."""
    text = text.strip()
    return "" if text == "NONE" else text


class UniversalFile:
    """Functions of a universal file, in its order."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = file.read()
        self.at = self.line = 0
        self.functions, lengths, first_lengths, others = [], None, None, []
        while (line := self.next()) is not None:
            if line.strip() != "-1" or (line := self.next()) is None:
                continue
            kind = line[:7].strip()
            if kind in ("58", "58b"):
                self.functions.append(self.read_function(line if kind == "58b" else ""))
                self.functions[-1].lengths = lengths
            elif kind == "164":
                lengths = self.read_lengths()
                first_lengths = first_lengths or lengths
            else:
                others.append(kind)
                self.skip()
        if not self.functions:
            which = f"; its datasets are {shown(', '.join(others)[:60])}" if others else ""
            raise Refusal(f"contains no measured function (dataset 58){which}")
        for function in self.functions:
            function.lengths = function.lengths or first_lengths

    def refuse(self, reason):
        raise Refusal(shown(reason), self.line)

    def next(self):
        self.line += 1
        if self.at >= len(self.data):
            return None
        end = self.data.find(b"\n", self.at)
        end = len(self.data) if end < 0 else end
        line, self.at = file_text(self.data[self.at:end]), end + 1
        return line

    def skip(self):
        while (line := self.next()) is not None and line.strip() != "-1":
            pass

    def end_dataset(self, count):
        while (line := self.next()) is not None and line.strip() != "-1":
            if line.strip():
                self.refuse(f"more than the {count} declared values are present")

    def number(self, text):
        try:
            return fortran_number(text)
        except ValueError:
            self.refuse(f'"{text.strip()[:40]}" is not a number')

    def whole(self, text):
        value = self.number(text)
        if not (abs(value) <= 1e9 and value == int(value)):
            self.refuse(f'"{text.strip()}" is not a valid code')
        return int(value)

    def read_lengths(self):
        """Factor of dataset 164 that converts SI to the file's units of length."""
        self.next()
        factors = self.next()
        if factors is None:
            self.refuse("ends within a dataset 164 (units)")
        lengths = self.number(factors[:25])
        if not 0 < lengths < float("inf"):
            self.refuse(f"{lengths:g} is not a valid factor of length")
        self.skip()
        return lengths

    def read_function(self, binary):
        records = [self.next() for _ in range(11)]
        if records[-1] is None:
            self.refuse("ends within the header of a dataset 58")
        form = records[6]
        kind, count, spacing = (self.whole(form[at:at + 10]) for at in (0, 10, 20))
        if kind not in (2, 4, 5, 6):
            self.refuse(f"{kind} is not a valid type of values (2, 4, 5 or 6)")
        if spacing not in (0, 1):
            self.refuse(f"{spacing} is not a valid spacing (0: uneven, 1: even)")
        if count < 1:
            self.refuse(f"{count} is not a valid number of values")
        try:
            direction = fortran_number(records[5][51:55])
        except ValueError:
            direction = 0.0
        axes = [Axis(self.whole(record[:10]), stated(record[46:67])) for record in records[7:10]]
        first = step = rounding = 0.0
        if spacing == 1:
            first, step, rounding = self.number(form[30:43]), self.number(form[43:56]), rounding_of(form[43:56].strip())
        function = Function(stated(records[0]), self.whole(records[5][:5]), int(direction) if abs(direction) <= 6 else 0, kind >= 5,
                            spacing == 1, first, step, rounding, *axes)
        if binary:
            self.read_bytes(function, count, 4 if kind in (2, 5) else 8, binary)
        else:
            self.read_text(function, count, 1 + function.complex + (not function.even))
        return function

    def read_text(self, function, count, parts):
        """Numbers separated by blanks, or next to each other in the formats E13.5 and E20.12."""
        wanted = count * parts
        end = re.compile(rb"\n *-1 *\r?(\n|$)").search(self.data, self.at - 1)
        text = self.data[self.at:end.start() if end else len(self.data)].upper().replace(b"D", b"E")
        try:
            numbers = np.array(text.split()).astype(np.float64)
        except ValueError:
            numbers = np.array([fortran_number(n.group().decode()) for n in FORTRAN_NUMBER.finditer(text)])
            other = re.search(rb"\S+", FORTRAN_NUMBER.sub(lambda number: b" " * len(number.group()), text))
            if other:
                self.line += text.count(b"\n", 0, other.start()) + 1
                self.refuse(f'"{file_text(other.group())[:40]}" is not part of a number')
        self.line += text.count(b"\n") + 1
        self.at = end.end() if end else len(self.data)
        problem = (f"only {len(numbers) // parts} of {count} values are present" if len(numbers) < wanted else
                   f"more than the {count} declared values are present" if len(numbers) > wanted else "")
        if problem and not function.complex:
            self.refuse(problem)
        function.unreadable = problem  # complex functions do not decide whether time histories are accepted
        if not problem:
            function.take(list(numbers.reshape(count, parts).T))

    def read_bytes(self, function, count, width, head):
        order, form, declared = self.whole(head[7:13]), self.whole(head[13:19]), self.number(head[31:43])
        parts = 2 if function.complex else 1
        # Abscissae are in single precision; some programs write them as the values.
        abscissa = 0 if function.even else width if declared == count * width * (parts + 1) else 4
        row = abscissa + parts * width
        if declared not in (0, count * row):
            self.refuse(f"declares {declared:g} bytes, but its {count} values take {count * row}")
        if len(self.data) - self.at < count * row:
            self.refuse(f"only {(len(self.data) - self.at) // row} of {count} values are present")
        start, self.at = self.at, self.at + count * row
        self.end_dataset(count)
        function.unreadable = (
            f"{order} is not a valid byte order (1 or 2)" if order not in (1, 2) else
            f"{form} is not a valid format of binary numbers" if form not in (1, 2, 3) else
            "its values are DEC VMS numbers of double precision or in reverse byte order, which are not supported"
            if form == 1 and (width == 8 or order == 2) else "")
        if not function.unreadable:
            code = (">" if order == 2 else "<") + ("f" if form == 2 else "u")
            widths = [abscissa] * (not function.even) + [width] * parts
            rows = np.frombuffer(self.data, [(str(i), f"{code}{w}") for i, w in enumerate(widths)], count, start)
            convert = {1: dec_numbers, 2: lambda raw, _: raw.astype(np.float64), 3: ibm_numbers}[form]
            function.take([convert(rows[str(i)], w) for i, w in enumerate(widths)])


def ibm_numbers(raw, width):
    """Hexadecimal numbers of IBM 370: an exponent to the base 16 and a fraction."""
    raw, bits = raw.astype(np.uint64), 8 * width - 8
    exponent = (raw >> np.uint64(bits) & np.uint64(127)).astype(int) - 64
    size = np.ldexp((raw & np.uint64(2**bits - 1)).astype(float), 4 * exponent - bits)
    return np.where(raw >> np.uint64(bits + 7) & np.uint64(1), -size, size)


def dec_numbers(raw, _):
    """F_floating numbers of DEC VAX: two little-endian words, the more significant one first."""
    raw = (raw & 0xFFFF).astype(np.int64) << 16 | raw.astype(np.int64) >> 16
    exponent = raw >> 23 & 255
    size = np.ldexp((raw & 0x7FFFFF | 0x800000).astype(float), exponent - 128 - 24)
    return np.where(exponent == 0, 0.0, np.where(raw >> 31 & 1, -size, size))


def other_kind(function):
    """Kind of a function that is not a real time history, otherwise "". """
    response = function.kind == 1
    over_time = function.abscissa.kind == TIME or (response and function.abscissa.kind in (0, 1) and
                                                   function.abscissa.unit.lower() in TIME_UNITS)
    if function.kind not in (0, 1):
        return FUNCTIONS[function.kind] if 0 <= function.kind < len(FUNCTIONS) else f"function type {function.kind}"
    if not over_time:
        return f"function of {quantity_name(function.abscissa.kind)}"
    return "complex time response" if function.complex else ""


def unrounded_rate(step, rounding):
    """Whole number of Hz that rounds to this step, if there is exactly one; otherwise the step's rate."""
    if not rounding < step:
        return 1.0 / step
    margin = 1e-9
    lowest, highest = math.ceil((1.0 - margin) / (step + rounding)), math.floor((1.0 + margin) / (step - rounding))
    return float(lowest) if lowest == highest else 1.0 / step


def acceleration_by_lengths(per_metre):
    for count, name in LENGTHS:
        if abs(per_metre / count - 1) < 1e-4:
            return f"{name}/s^2"
    return f"1/{per_metre:g} of m/s^2, by dataset 164"


def state_unit(channel, function):
    """Unit of the ordinate. The program compares a label with dataset 164 and with the quantity."""
    ordinate, denominator, lengths = function.ordinate, function.denominator, function.lengths
    channel.unit = ordinate.unit
    if denominator.kind != 0 or denominator.unit:
        channel.unit = (f"{ordinate.unit or quantity_name(ordinate.kind)} per {denominator.unit or quantity_name(denominator.kind)} by "
                        "the function's denominator")
    elif ordinate.kind == TIME:
        pass
    elif ordinate.kind == SPEED:
        channel.unit = ordinate.unit or "rpm"
    elif ordinate.kind not in (0, 1, ACCELERATION):
        channel.quantity = quantity_name(ordinate.kind)
        channel.unit_text = (f"{quantity_name(ordinate.kind)}{' in ' if ordinate.unit else ''}{ordinate.unit}, ordinate data type "
                             f"{ordinate.kind}")
    elif ordinate.unit:
        channel.lengths_per_metre, channel.unit_by_lengths = lengths, acceleration_by_lengths(lengths) if lengths else ""
    elif ordinate.kind == ACCELERATION and abs(function.direction) >= 4:
        channel.unit = "rad/s^2"
    elif ordinate.kind == ACCELERATION and lengths:
        channel.unit = acceleration_by_lengths(lengths)
    elif lengths and lengths != 1:
        channel.unit = f"not stated, with {lengths:g} units of length per metre by dataset 164"


def state_sampling(channel, function):
    second = TIME_UNITS.get(function.abscissa.unit.lower())
    if second is None:
        channel.unreadable = f"column {channel.name}: {function.abscissa.unit} is not a known unit of its times"
        return
    step = function.step * second
    if not (step > 0 and 1 / step < float("inf")):
        channel.unreadable = f"column {channel.name}: {step:g} s is not a valid time step"
        return
    channel.sampling_Hz, channel.start_s = unrounded_rate(step, function.rounding * second), function.first * second
    if channel.sampling_Hz != 1.0 / step:
        channel.note = f"the rate is {channel.sampling_Hz:.0f} Hz, which rounds to the time step {step:g} s"


def read_uff(path):
    functions = UniversalFile(path).functions
    kinds = [other_kind(function) for function in functions]
    if all(kinds):
        raise Refusal(f"contains no real time history; its functions are: {', '.join(dict.fromkeys(kinds))}")
    channels, times = [], []
    for i, function in enumerate(functions):
        if kinds[i]:
            continue
        alone = kinds.count("") == 1
        channel = Channel("sensor" if alone else f"function{i + 1}", function.values, title="" if alone else function.title)
        channel.text = channel.name + (f" ({channel.title})" if channel.title else "")
        channels.append(channel)
        state_unit(channel, function)
        if function.unreadable:
            channel.unreadable = f"column {channel.name}: {function.unreadable}"
        elif function.even:
            state_sampling(channel, function)
        else:
            same = next((t for t in times if np.array_equal(t.values, function.abscissae)), None)
            if same is None:
                first = not times and not any(f.even for f, kind in zip(functions, kinds) if not kind)
                same = Channel("time" if first else f"time of {channel.name}", function.abscissae, unit=function.abscissa.unit)
                times.append(same)
            channel.times = same.name
    return Recording(channels + times)


def read_uff_responses(path):
    """Frequency responses: rows are the frequency, the real and the imaginary part."""
    functions = [f for f in UniversalFile(path).functions if f.kind in (4, 5)]
    if not functions:
        raise Refusal("contains no frequency response")
    channels = []
    for function in functions:
        channel = Channel(function.abscissa.text(), title=function.ordinate.text(), text=function.denominator.text(),
                          unit=function.ordinate.unit, unit_text=function.denominator.unit, unreadable=function.unreadable)
        if not function.unreadable:
            count = len(function.values)
            frequency = function.first + function.step * np.arange(count) if function.even else function.abscissae
            channel.values = np.stack([frequency, function.values, function.imaginary if function.complex else np.zeros(count)])
        channels.append(channel)
    return Recording(channels)


# The process


READERS = {"mat": read_mat, "sound": read_sound, "tdms": read_tdms, "uff": read_uff, "responses": read_uff_responses}


def write_recording(recording, path):
    with h5py.File(path, "w") as file:
        file.attrs["separator"], file.attrs["note"] = recording.separator, recording.note
        for i, channel in enumerate(recording.channels):
            values = np.atleast_2d(np.asarray(channel.values, dtype=np.float64))
            dataset = file.create_dataset(f"{i:06}", data=values)
            for field in dataclasses.fields(channel):
                value = getattr(channel, field.name)
                if field.name != "values" and value not in (None, ""):
                    dataset.attrs[field.name] = value.replace("\0", "?") if isinstance(value, str) else float(value)


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
        if missing:
            raise Refusal(f"reading it needs the Python packages {', '.join(missing)}, which {sys.executable} lacks; on Debian: "
                          f"apt-get install {' '.join('python3-' + name for name in missing)}; GEARPOD_PYTHON names another Python")
        limit_resources(os.stat(path).st_size)
        warnings.simplefilter("ignore")
        write_recording(READERS[kind](path), output)
    except Refusal as refusal:
        print(refusal, end="")
        return REFUSED
    except MemoryError:
        print(": is damaged, or needs more memory than reading a file may use", end="")
        return REFUSED
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
