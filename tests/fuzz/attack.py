#!/usr/bin/env python3
"""Attacks the built program with mutated studies, damaged files with valid checksums, hostile signals and hostile options.

    attack.py GEARPOD all|KIND SEED SECONDS [MOST]

Checks: no signal, no hang, no memory above 2 GB, only documented exit codes, no NaN or infinity among the numbers of a
success, no input overwritten, no refusal that names neither a file nor a key nor an option. README.md lists the kinds."""
import collections
import concurrent.futures
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import h5py
import numpy as np

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path += [str(TESTS / "python"), str(TESTS / "recordings")]
import rexs_models  # noqa: E402
from mutation import mutated  # noqa: E402
from written_recordings import tdms, uff58, wav16  # noqa: E402

# A call that needs more processor time (in seconds), or does nothing for so long, does not end.
LIMITED, LONGEST_S = ["prlimit", f"--as={2 << 30}", "--cpu=25:30", "--core=0"], 600
NUMBERS_OF_SEED = 10**9
SMALL_STUDY = TESTS / "features/reference/small.toml"
NUMBERS = [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1e-9, 1e-30, 1e-300, 1e9, 1e18, 1e19, 1e150, 1e300, -1e300, np.nan, np.inf, -np.inf,
           5e-324, 4.0, 1e6, -20.0, 1e12, 3.0]


class Attack:
    """One call of the program (or of another one), and the files that must stay unchanged."""

    def __init__(self, *arguments, inputs=(), prints_numbers=False, program=None):
        self.arguments, self.inputs = [str(a) for a in arguments], inputs
        self.prints_numbers, self.program = prints_numbers, program


def call(program, arguments):
    """Exit code (None: it hung) and both output streams."""
    try:
        done = subprocess.run([*LIMITED, program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LONGEST_S,
                              check=False)
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, done.stdout.decode("utf-8", "replace")


def verdict(code, output, attack):
    """Description of a violated promise, or ""."""
    if code is None or code == -signal.SIGXCPU:
        return "does not end"
    if code < 0:
        return f"ends by signal {-code}"
    if code not in (0, 2, 3, 4):
        return f"ends with {code}"
    for raw in ("std::", "bad_alloc", "json.exception", "Traceback", "terminate"):
        if raw in output:
            return f"says {raw}"
    if code == 2 and not output:
        return "refuses and says nothing"
    names_its_cause = (any(a and a in output for a in attack.arguments)
                       or re.search(r"--[a-z]|[a-z_]+\.[a-z_]+|\[[a-z_]+\]", output))
    if code == 2 and not names_its_cause:
        return "refuses and names neither a file nor a key"
    if code == 0 and attack.prints_numbers and re.search(r"(?<![A-Za-z0-9])(nan|inf)(?![A-Za-z0-9])", output):
        return "prints a number that is none"
    return ""


def damaged(data, dice):
    """Bytes with flipped bits, replaced numbers, and stretches cleared, copied, cut off or inserted."""
    data = bytearray(data)
    for _ in range(dice.randint(1, 6)):
        if len(data) <= 16:
            break
        at = dice.randrange(len(data) - 8)
        length = dice.randint(1, min(64, len(data) - at - 1))
        kind = dice.randrange(8)
        if kind == 0:
            data[at:at + length] = bytes([dice.choice((0, 255))]) * length
        elif kind == 1:
            data[at // 8 * 8:at // 8 * 8 + 8] = np.float64(dice.choice(NUMBERS)).tobytes()
        elif kind == 2:
            begin = dice.randrange(len(data) - length)
            data[at:at + length] = data[begin:begin + length]
        elif kind == 3:
            del data[at if dice.randrange(4) == 0 else len(data):]
        elif kind == 4:
            data[at:at] = bytes([dice.randrange(256)]) * length
        else:
            data[at] ^= 1 << dice.randrange(8)
    return bytes(data)


def update_checksum(path):
    """Replaces the checksum of a results file (FNV-1a, in the user block) by the one of its bytes."""
    data = bytearray(path.read_bytes())
    data[512 + 20] &= ~1  # the flag "open for writing" does not count
    total = 0xcbf29ce484222325
    for byte in data[16:]:
        total = (total ^ byte) * 0x100000001b3 & 0xffffffffffffffff
    with open(path, "r+b") as file:
        file.write(b"gearpod\n" + total.to_bytes(8, "little"))


def exchange(group, name, dice):
    """Replaces numbers of a dataset, or changes their count."""
    values = np.array(group[name], dtype=float)
    if dice.randrange(3) == 0:
        rows = dice.randrange(5) if dice.randrange(2) == 0 else 3 * len(values)
        values = np.concatenate([values.ravel(), np.ones(3 * values.size + 5)])[:rows * values[:1].size].reshape(
            rows, *values.shape[1:])
    for _ in range(dice.randint(1, 4) if values.size else 0):
        values.flat[dice.randrange(values.size)] = dice.choice(NUMBERS)
    attributes = dict(group[name].attrs)
    del group[name]
    group.create_dataset(name, data=values).attrs.update(attributes)


def in_dialect(table, dice):
    """The same table as other programs write it: other separators, decimal commas, units, missing values, quotes, preambles,
    index columns and encodings, any of them wrong now and then."""
    units = [" [g (peak)]", " (m/s**2)", " [mV]", " [\xb5m]", " [r/min]", " []", " [m/s\xb2]", " [kg m/s^2/kg]", " [[g]", " [sec]", ""]
    missing = ["NA", "NaN", "", "-", "null", "#N/A", "1,5", "1.234,5", "1e", "inf"]
    separator = dice.choice([",", ";", "\t", " ", ", ", "|"])
    end = dice.choice(["\n", "\r\n", "\r", ",\n", ";\n"])
    comma, quoted, index = dice.randrange(3) == 0, dice.randrange(4) == 0, dice.randrange(4) == 0
    out = dice.choice(["sep=;\n", "# made by\n", "\xef\xbb\xbf", "Recorder;7\n\n", "\n\n"]) if dice.randrange(3) == 0 else ""
    for line, row in enumerate(table.decode().splitlines()):
        fields = row.split(",")
        for i, field in enumerate(fields):
            if line == 0 and dice.randrange(3) == 0:
                fields[i] = field.partition(" [")[0] + dice.choice(units)
            elif line > 0 and dice.randrange(500) == 0:
                fields[i] = dice.choice(missing)
            if comma and line > 0:
                fields[i] = fields[i].replace(".", ",")
        out += (f"{line}{separator}" if index and line > 0 else "") + separator.join(f'"{f}"' if quoted else f for f in fields) + end
    if dice.randrange(8) == 0:
        return out.encode("utf-16")
    data = out.encode("latin-1", "replace")
    return damaged(data, dice) if dice.randrange(4) == 0 else data


def hostile_csv(dice):
    """Rows of numbers, some of them hostile, with a sampling rate and a speed that may be hostile, too."""
    columns = [c for c in ("time", "mesh_phase", "speed_rpm", "sensor", "te") if dice.randrange(3) != 0]
    names = [dice.choice(["time", "te", "sensor", "mesh_phase", "speed_rpm", "", "1", "x"]) if dice.randrange(30) == 0 else c
             for c in columns]
    count = dice.randrange(20) if dice.randrange(4) == 0 else 200 + dice.randrange(8000)
    speed = dice.choice(NUMBERS) if dice.randrange(3) == 0 else 60.0
    size = dice.choice(NUMBERS) if dice.randrange(3) == 0 else 1e-3
    row = np.arange(count)
    clock = 10.0 ** (-1 - dice.randrange(4)) * row
    with np.errstate(all="ignore"):
        values = np.array([clock if n in ("time", "mesh_phase") else np.full(count, speed) if n == "speed_rpm"
                           else size * np.sin(0.7 * row) for n in names]).reshape(len(names), count)
    if count and dice.randrange(4) == 0:
        values[:, dice.randrange(count)] = [dice.choice(NUMBERS) for _ in names]
    rows = (",".join("%.9g" % v for v in values[:, i]) for i in range(count))
    return "\n".join([",".join(names), *rows, ""]).encode()


class Arsenal:
    """Small valid files from which attacks are made; the program creates them once. Each method makes an attack in a folder."""

    def __init__(self, program, folder):
        self.program = program

        def make(code, *arguments):
            found, output = call(program, arguments)
            if found != code:
                sys.exit(f"the program does not make the genuine files:\n{output}")

        at = folder / "genuine"
        at.mkdir()
        make(0, "run", SMALL_STUDY, "--instances", "4", "--out", at / "r.h5")
        make(4, "run", SMALL_STUDY, "--instances", "200000", "--time-limit", "00:00:01", "--out", at / "p.h5")
        for form in ("csv", "h5"):
            make(0, "simulate", SMALL_STUDY, "--instance", "0", "--meshes", "400", "--out", at / f"x.{form}")
        self.results, self.checkpoint = (at / "r.h5").read_bytes(), (at / "p.h5.part").read_bytes()
        self.csv = (at / "x.csv").read_bytes()
        sensor = 0.5 * np.sin(0.7 * np.arange(4000))
        path = "/'g'/'sensor'"
        self.signals = {"x.h5": (at / "x.h5").read_bytes(), "x.wav": wav16(sensor, 280), "x.csv": self.csv,
                        "x.tdms": tdms({path: sensor}, {path: {"wf_increment": 1 / 280, "unit_string": "g"}}),
                        "x.uff": uff58(sensor, 6, kind=2, unit="g", step=1 / 280).encode()}
        self.gear_units = [rexs_models.planetary().text(), rexs_models.two_pairs().text()]
        self.inspections = [(TESTS / f"analysis/reference/inspections_{name}.csv").read_bytes() for name in ("hits", "responses")]

    def written(self, folder, **files):
        """Paths of files with these bytes; a name has its ending behind an underscore."""
        paths = [folder / name.replace("_", ".") for name in files]
        for path, data in zip(paths, files.values()):
            path.write_bytes(data)
        return paths

    def study(self, folder, number, dice):
        path, = self.written(folder, s_toml=mutated(number))
        command = dice.choice(["stiffness", "modes", "describe", "describe"])
        # The budget of a description is processor time; less than the limit of an attack.
        return Attack(command, path, *["--seconds", "4"] * (command == "describe"), prints_numbers=command == "modes")

    def edit(self, path, number, dice):
        """Changes a results file through HDF5 and updates its checksum."""
        with h5py.File(path, "r+") as file:
            kind = dice.randrange(4)
            if kind == 0:
                file.attrs["study"] = mutated(number).replace(b"\0", b"?").decode("utf-8", "replace")
            elif kind == 1:
                exchange(file, "noise_levels", dice)
            elif kind == 2:
                group = file[dice.choice(["instances", "features", "timing", "/"])]
                del group[dice.choice(list(group))]
            else:
                group = file[dice.choice(["instances", "features"])]
                name = dice.choice(list(group))
                if name != "group":
                    exchange(group, name, dice)
        update_checksum(path)

    def results_file(self, folder, number, dice):
        path, genuine = self.written(folder, r_h5=self.results, genuine_h5=self.results)
        kind = dice.randrange(4)
        if kind == 0:
            path.write_bytes(damaged(self.results, dice))
        elif kind == 1:
            self.edit(path, number, dice)
        else:  # changed bytes under a valid checksum
            data = bytearray(self.results)
            for _ in range(dice.randint(1, 4)):
                # Most of what describes the data lies in the first part.
                most = 8192 if dice.randrange(2) == 0 else len(data) - 512
                data[512 + dice.randrange(min(most, len(data) - 512))] = dice.randrange(256)
            path.write_bytes(data)
            update_checksum(path)
        python = ("import sys; sys.path.insert(0, sys.argv[1]); import gearpod\n"
                  "try: r = gearpod.open(sys.argv[2]); [r.feature(f) for f in r.features]\n"
                  "except (ValueError, OSError, KeyError) as e: print(sys.argv[2], e); exit(2)")
        commands = [
            ["run", SMALL_STUDY, "--instances", "5", "--resume", "--quiet", "--out", path],
            ["report", path, "--html", folder / "r.html"],
            ["report", path, "--by", "torque_N_m"],
            ["compare", genuine, path],
            ["merge", path, "--out", folder / "m.h5"],
            ["repair", path],
            ["misses", path, "--feature", "te_rms", "--size", "1", "--quiet", "--gearboxes", "2", "--records", "2"],
            ["rare", path, "--feature", "te_rms", "--rate", "0.1", "--quiet", "--gearboxes", "2"]]
        kind = dice.randrange(4)
        if kind == 0:
            return Attack("report", path, "--json", "-", inputs=[genuine])  # the output quotes the mutated study
        if kind == 1:
            return Attack("-c", python, TESTS.parent / "analysis/python", path, inputs=[genuine], program="/usr/bin/python3")
        return Attack(*dice.choice(commands), inputs=[genuine])

    def checkpoint_file(self, folder, _, dice):
        self.written(folder, r_h5_part=damaged(self.checkpoint, dice))
        return Attack("run", SMALL_STUDY, "--instances", "200000", "--time-limit", "00:00:01", "--resume", "--quiet", "--out",
                      folder / "r.h5", prints_numbers=True)

    def signal(self, folder, _, dice):
        kind = dice.randrange(12)
        name = list(self.signals)[kind] if kind < len(self.signals) else "x.csv"
        path = folder / name
        path.write_bytes(damaged(self.signals[name], dice) if kind < len(self.signals)
                         else hostile_csv(dice) if kind < 8 else in_dialect(self.csv, dice))
        arguments = ["features", path, "--study", SMALL_STUDY]
        arguments += ["--json", "-"] if dice.randrange(2) == 0 else []
        arguments += ["--healthy", path] if dice.randrange(8) == 0 else []
        if dice.randrange(6) == 0:
            arguments += ["--sampling-Hz", dice.choice(["1e-320", "1e-300", "1", "50", "5000", "1e18", "1e300", "nan", "inf"])]
        return Attack(*arguments, prints_numbers=True)

    def table(self, folder, _, dice):
        """Tables of inspections, and lists of recordings, some of which exist."""
        path = folder / "t.csv"
        if dice.randrange(3) != 0:
            options = ["--link=logit", "--link=probit", "--link=cloglog", "--link=loglog", "--bounds=wald", "--size-scale=log",
                       "--size-scale=linear"]
            path.write_bytes((damaged if dice.randrange(2) == 0 else in_dialect)(dice.choice(self.inspections), dice))
            # The output quotes the table's names.
            return Attack("pod", path, "--json", "-", *(dice.choice(options) for _ in range(dice.randrange(3))))
        self.written(folder, a_csv=self.csv, b_csv=hostile_csv(dice))
        path.write_bytes(damaged(b"file,gearbox,time,label,size [mm],load\na.csv,one,1,healthy,0,100\nb.csv,one,2,faulty,1.5,110\n"
                                 b"a.csv,two,3,healthy,0,90\nc.csv,two,4,,,95\n", dice))
        return Attack("features", "--manifest", path, "--study", SMALL_STUDY, "--quiet", "--out", folder / "f.h5")

    def rexs(self, folder, _, dice):
        values = ["0", "1", "-1", "1e300", "nan", "true", "9999999", "0.001", "1,5", "none", "mum", "deg", "", "-8.4", "20 28", "&#x1;"]
        model = dice.choice(self.gear_units)
        for _ in range(dice.randint(1, 3)):
            places = [m for m in re.finditer(dice.choice(['"([^"<]*)["<]', '>([^"<]*)["<]', '>([^"<]*)["<]']), model)]
            begin, end = dice.choice(places).span(1)
            model = model[:begin] + dice.choice(values) + model[end:]
        path = folder / "m.rexs"
        path.write_bytes(damaged(model.encode(), dice) if dice.randrange(4) == 0 else model.encode())
        options = ["--torque=100", "--speed=1000", "--addendum=1", "--stage=1", "--stage=2", "--shaft=50", "--quality=6"]
        return Attack("new", "--rexs", path, *(dice.choice(options) for _ in range(dice.randrange(4))), inputs=[path])

    def options(self, folder, _, dice):
        return dice.choice([self.hostile_numbers, self.other_kinds])(folder, dice)

    def hostile_numbers(self, folder, dice):
        """A command with one or two numeric options."""
        hostile = ["nan", "-nan", "inf", "-inf", "NAN(1)", "1e400", "0x10", "1,5", "", " 5", "5 ", "5x", "+-1", "1e-320", "1e308",
                   "-1", "0", "99999999999999999999", "1e18", "0.5", "2", "1e3", ".", "\x1b[2J"]
        table, recording, results = self.written(folder, t_csv=dice.choice(self.inspections), x_csv=self.csv, r_h5=self.results)
        words, options = dice.choice([
            (["pod", table, "--json", "-"], "floor confidence target threshold false-call-rate left right response-scale"),
            (["features", recording, "--study", SMALL_STUDY], "sampling-Hz samples-per-mesh pulses-per-turn noise-level"),
            (["new", "planetary", "--sun=19", "--planet=31", "--module=2", "--torque=100"],
             "speed power helix pressure-angle face-width addendum sun-shift centre-distance sun-tip quality planets ring"),
            (["report", results], "alarm-cost miss-cost fault-share"),
            (["simulate", SMALL_STUDY], "instance"),
            (["stiffness", SMALL_STUDY], "points"),
            (["describe", SMALL_STUDY], "ranks seed instances set=operation.torque_N_m")])
        for _ in range(dice.randint(1, 2)):
            option, value = "--" + dice.choice(options.split()), dice.choice(hostile)
            words += [f"{option}={value}"] if value else [option, value]
        return Attack(*words, inputs=[results, recording, table])

    def other_kinds(self, folder, dice):
        """An output over a file of another kind, which must stay unchanged."""
        study, recording, results, table = self.written(folder, s_toml=SMALL_STUDY.read_bytes(), x_csv=self.csv, r_h5=self.results,
                                                        t_csv=self.inspections[0])
        aim = folder / ("aim" + dice.choice([".h5", ".csv", ".json", ".html", ".dat"]))
        aim.write_bytes(dice.choice([self.results, self.csv, self.signals["x.h5"][:500], b"years of work\n", self.signals["x.wav"]]))
        features = ["features", recording, "--study", study]
        return Attack(*dice.choice([
            features + ["--quiet", "--out", aim], features + ["--quiet", "--csv", aim], features + ["--json", aim],
            ["stiffness", study, "--points", "10", "--csv", aim],
            ["modes", study, "--json", aim],
            *(["report", results, option, aim] for option in ("--json", "--html", "--pdf")),
            ["compare", results, results, "--html", aim],
            ["pod", table, "--json", aim]]), inputs=[aim, study, recording, results, table])


KINDS = {"study": Arsenal.study, "results": Arsenal.results_file, "checkpoint": Arsenal.checkpoint_file, "signal": Arsenal.signal,
         "table": Arsenal.table, "rexs": Arsenal.rexs, "options": Arsenal.options}


class Campaign:
    """Runs attacks first, first + 1, ... in several threads until the time is over or all are done."""

    def __init__(self, arsenal, kind, first, most, seconds, folder):
        self.arsenal, self.kind, self.folder = arsenal, kind, folder
        self.numbers, self.until = iter(range(first, first + most)), time.monotonic() + seconds
        self.codes, self.bad, self.lock = collections.Counter(), 0, threading.Lock()

    def work(self, worker):
        folder = self.folder / f"w{worker}"
        while time.monotonic() < self.until:
            with self.lock:
                number = next(self.numbers, None)
            if number is None:
                return
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            self.attack(folder, number)

    def attack(self, folder, number):
        attack = KINDS[self.kind](self.arsenal, folder, number, random.Random(number))
        before = [path.read_bytes() for path in attack.inputs]
        code, output = call(attack.program or self.arsenal.program, attack.arguments)
        wrong = verdict(code, output, attack)
        for path, data in zip(attack.inputs, before):
            if path.read_bytes() != data:
                wrong = f"writes over {path}"
        with self.lock:
            self.codes[code] += 1
            if wrong:
                self.bad += 1
                print(f"attack {number}: gearpod {' '.join(attack.arguments)}\n{wrong}:\n{output[:2000]}", file=sys.stderr, flush=True)

    def run(self):
        """True if every promise was kept."""
        count = os.cpu_count() or 1
        with concurrent.futures.ThreadPoolExecutor(count) as pool:
            list(pool.map(self.work, range(count)))
        codes = " ".join(f"{code}: {count}" for code, count in sorted(self.codes.items(), key=str))
        print(f"{self.kind}: {self.codes.total()} attacks, {self.bad} failures; exit codes {codes}", flush=True)
        return self.bad == 0 and self.codes.total() > 0


def main():
    if len(sys.argv) not in (5, 6) or sys.argv[2] not in ("all", *KINDS):
        sys.exit(__doc__)
    kinds = list(KINDS) if sys.argv[2] == "all" else [sys.argv[2]]
    seed, seconds = int(sys.argv[3]), float(sys.argv[4]) / len(kinds)
    first = seed if seed >= NUMBERS_OF_SEED else seed * NUMBERS_OF_SEED  # a seed this large is the number of an attack
    with tempfile.TemporaryDirectory(prefix="gearpod-attack-") as name:
        folder = pathlib.Path(name)
        arsenal = Arsenal(pathlib.Path(sys.argv[1]).resolve(), folder)
        most = int(sys.argv[5]) if len(sys.argv) > 5 else NUMBERS_OF_SEED
        kept = [Campaign(arsenal, kind, first, most, seconds, folder).run() for kind in kinds]
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
