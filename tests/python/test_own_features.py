"""Checks features in Python: python3 test_own_features.py PROGRAM SOURCES [MPIEXEC]

Counterparts of the program's features in numpy must have their values, in runs that are split, resumed and
repeated. Files and functions with errors of every kind must give one message each.
"""

import hashlib
import json
import os
import re
import signal
import subprocess
import sys
import time
import unittest

from python_study_case import PROGRAM, PythonStudyCase, h5py, np

MPIEXEC = sys.argv[3] if len(sys.argv) > 3 else ""
FEW = ("--instances", 7, "--set", "ensemble.threshold_instances=8")
COUNTERPARTS = '''
import numpy as np
print("printed by the file")

def rms(record):
    """RMS of the sensor signal."""
    print("printed by a feature")
    return np.sqrt(np.mean(record.sensor ** 2))
rms.unit, rms.title = "m/s^2", "level in Python"

def kurtosis(record):
    x = record.te - record.te.mean()
    return np.mean(x ** 4) / np.mean(x ** 2) ** 2

def centre(record):
    amplitude = np.abs(np.fft.rfft(record.te))
    amplitude[1:(record.te.size + 1) // 2] *= 2  # all but order 0 and the Nyquist order
    return np.sum(np.arange(amplitude.size) * amplitude) / np.sum(amplitude)
centre.alarm = "low"

def ratio(record):
    return record.tooth_rms.max() / np.median(record.tooth_rms)

def crest(record):
    x = record.sensor_average
    x = x - x.mean(axis=-1, keepdims=True)
    return np.abs(x).max(axis=-1) / np.sqrt(np.mean(x ** 2, axis=-1))
crest.batch = True

def _not_a_feature(record):
    return 1 / 0

def no_feature(signal):
    return 1 / 0
'''
PAIRS = {"rms": "sensor_rms", "kurtosis": "te_kurtosis", "centre": "te_fc", "ratio": "window_ratio",
         "crest": "crest_factor"}
COMPARED = '''
import numpy as np
def level(x):
    return np.sqrt(np.mean(x ** 2))
def relative(record, baselines):
    return level(record.sensor) / np.mean([level(b.sensor) for b in baselines])
def added(record, change):
    return level(change.sensor)
'''
FOLDED = '''
import numpy as np
def kurtosis(record):
    return np.mean(record.te ** 4) / np.mean(record.te ** 2) ** 2
def ratio(record):
    return record.tooth_rms.max() / np.median(record.tooth_rms)
def no_sensor(record):
    return record.sensor is None
kurtosis.samples = ratio.samples = no_sensor.samples = False
'''

LIFE = '''
[life]
interval_h = 5
first_depth_mm = 1
last_depth_mm = 4
depth_steps = 2
paris_factor = 1.36e-7
paris_exponent = 2.25
records = 10
healthy_lives = 2
torque_scatter = 0.02
speed_scatter = 0.02
distinct_torques = 2
distinct_speeds = 2
[monitoring]
baseline_records = 3
'''


class OwnFeatures(PythonStudyCase):
    def assert_same(self, first, second):
        first, second = self.values(first), self.values(second)
        self.assertEqual(first.keys(), second.keys())
        for name, values in first.items():
            self.assertEqual(values.tobytes(), second[name].tobytes(), name)

    def test_twins_have_the_values_and_grades_of_the_program(self):
        study = self.study(COUNTERPARTS, use=json.dumps(list(PAIRS.values())))
        out = self.run_study(study, "a.h5")
        values = self.values(out)
        self.assertEqual(set(values), set(PAIRS) | set(PAIRS.values()))
        for own, built_in in PAIRS.items():
            np.testing.assert_allclose(values[own], values[built_in], rtol=1e-9, err_msg=own)
        self.program("report", out, "--json", self.folder / "a.json")
        report = json.loads((self.folder / "a.json").read_text())
        known = {one["name"]: one for one in report["features"]}
        self.assertEqual((known["rms"]["title"], known["rms"]["unit"], known["rms"]["doc"]),
                         ("level in Python", "m/s^2", "RMS of the sensor signal."))
        self.assertEqual(known["centre"]["alarm"], "low")
        graded = {one["name"]: one for one in report["detection"]["features"]}
        for own, built_in in PAIRS.items():
            for level, other in zip(graded[own]["levels"], graded[built_in]["levels"]):
                np.testing.assert_allclose(level["threshold"], other["threshold"], rtol=1e-9)
                self.assertEqual(level["sizes"], other["sizes"], own)

    def test_values_do_not_depend_on_how_a_run_is_split(self):
        study = self.study(COUNTERPARTS)
        whole = self.run_study(study, "whole.h5", "--set", "numerics.threads=1")
        self.assert_same(whole, self.run_study(study, "threads.h5", "--set", "numerics.threads=3"))
        for part in (1, 2):
            self.run_study(study, f"part{part}.h5", "--part", f"{part}/2")
        self.program("merge", self.folder / "part1.h5", self.folder / "part2.h5", "--out",
                     self.folder / "merged.h5")
        self.assert_same(whole, self.folder / "merged.h5")
        extended = self.run_study(study, "extended.h5", "--instances", "7")
        self.run_study(study, "extended.h5", "--resume")
        self.assert_same(whole, extended)
        if MPIEXEC:
            ranks = self.run_study(study, "ranks.h5", before=[MPIEXEC, "--oversubscribe", "-n", "2"],
                                   OMPI_ALLOW_RUN_AS_ROOT="1",
                                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
            self.assert_same(whole, ranks)

    def life_study(self, source, use='["te_rms"]'):
        study = self.study(source, use)
        text = study.read_text()
        for old, new in (("noise_levels = [0, 1]", "noise_levels = [1]"), ("\ninstances = 14", "\ninstances = 4"),
                         ("threshold_instances = 20", "threshold_instances = 3")):
            text = text.replace(old, new)
        study.write_text(text + LIFE)
        return study

    def test_lives_have_the_values_of_the_program(self):
        source = COUNTERPARTS + COMPARED + "def speed(record):\n    return record.speed_rpm\n"
        use = [*PAIRS.values(), "own_sensor_rms", "change_sensor_rms"]
        study = self.life_study(source, json.dumps(use))
        outs = [self.folder / f"{threads}.h5" for threads in (1, 2)]
        for threads, out in enumerate(outs, 1):
            self.program("lives", study, "--out", out, "--show-withheld", "--quiet", "--set",
                         f"numerics.threads={threads}")
        first, second = map(self.values, outs)
        for name, values in first.items():
            self.assertEqual(values.tobytes(), second[name].tobytes(), name)
        for own, built_in in {**PAIRS, "relative": "own_sensor_rms",
                              "added": "change_sensor_rms"}.items():
            self.assertGreater(np.isfinite(first[own]).sum(), 25)
            np.testing.assert_allclose(first[own], first[built_in], rtol=1e-9, err_msg=own)
        self.assertLess(0.01, np.nanstd(first["speed"]) / np.nanmean(first["speed"]))
        self.program("lives", study, "--set", "life.recordings=2", code=2)
        self.assertIn('"rms" needs the samples of one recording', self.output)

    def test_lives_name_the_record_in_which_a_feature_fails(self):
        study = self.life_study("def own(record):\n    return 1 / (record.torque_Nm < 0)\n")
        self.program("lives", study, "--out", self.folder / "a.h5", "--show-withheld")
        self.assertRegex(self.output, r"own.py:2: ZeroDivisionError.*gearbox \d+, record 1 of")

    def test_functions_without_samples_have_the_other_signals(self):
        source = FOLDED + "def peak(record):\n    return abs(record.sensor).max()\n"
        values = self.values(self.run_study(self.study(source), "a.h5"))
        use = '["te_kurtosis", "window_ratio", "sensor_rms"]'
        alone = self.values(self.run_study(self.study(FOLDED, use=use), "b.h5"))
        for own, built_in in PAIRS.items():
            if own in alone:
                np.testing.assert_allclose(alone[own], alone[built_in], rtol=1e-9, err_msg=own)
                np.testing.assert_allclose(alone[own], values[own], rtol=1e-9, err_msg=own)
        self.assertEqual({*alone} & {*PAIRS}, {"kurtosis", "ratio"})
        for found in (alone, values):
            self.assertTrue((found["no_sensor"] == 1).all())
        self.run_study(self.folder / "study.toml", "b.h5", "--resume")
        self.program("report", self.folder / "b.h5")

    def test_baselines_and_change_are_those_of_the_program(self):
        study = self.study(COMPARED, use='["own_sensor_rms", "change_sensor_rms"]')
        for more in ([], ["--set", "features.baseline_records=3"],
                     ["--set", "sensor.record_turns=4"]):
            values = self.values(self.run_study(study, "a.h5", "--force", *FEW, *more))
            if "features.baseline_records=3" not in more:
                np.testing.assert_allclose(values["relative"], values["own_sensor_rms"], rtol=1e-9)
            np.testing.assert_allclose(values["added"], values["change_sensor_rms"], rtol=1e-9)

    def test_results_are_read_without_the_file(self):
        study = self.study(COUNTERPARTS)
        out = self.run_study(study, "a.h5")
        first = self.program("report", out).stdout
        (self.folder / "own.py").unlink()
        self.assertEqual(self.program("report", out).stdout, first)
        self.program("report", out, "--json", self.folder / "a.json")
        examples = json.loads((self.folder / "a.json").read_text())["examples"]["gearboxes"]
        self.assertEqual([one["same_bits"] for one in examples], [True, True])
        self.program("compare", out, out)
        self.program("run", study, code=2)
        self.assertIn("own.py: cannot be read: No such file or directory", self.output)
        with h5py.File(out) as file:
            self.assertIn(hashlib.sha256(COUNTERPARTS.encode()).hexdigest(), str(file.attrs["study"]))

    def test_reading_results_runs_no_code(self):
        study = self.study(COUNTERPARTS)
        out = self.run_study(study, "a.h5", "--instances", "7")
        self.write("evil.py", f"open({str(self.folder / 'was-run')!r}, 'w')\n" + COUNTERPARTS)
        with h5py.File(out, "r+") as file:
            stored = file.attrs["study"]
            stored = stored if isinstance(stored, str) else stored.decode()
            file.attrs["study"] = re.sub(r"python = \[\n.*?\n\]",
                                         f'python = ["{self.folder}/evil.py"]', stored, flags=re.S)
        self.program("repair", out)
        self.program("report", out, "--json", self.folder / "a.json")
        self.program("misses", out, "--feature", "rms", "--size", 3, code=2)
        self.assertFalse((self.folder / "was-run").exists())

    def test_an_exception_names_gearbox_file_and_line_and_loses_nothing(self):
        source = ("import numpy as np\ncalls = [0]\ndef fragile(record):\n"
                  "    if record.torque_Nm > 440 and record.noise_level:\n"
                  "        raise ValueError('torque\\nis high')\n"
                  "    return record.torque_Nm\n")
        out = self.run_study(self.study(source), "a.h5")
        self.assertRegex(self.output, r"own\.py:5: ValueError: torque is high \(fragile, "
                                      r"(healthy|test) gearbox \d+, row \d+ of the results, "
                                      r"noise x 1\)")
        self.assertEqual(self.output.count("ValueError"), 1)
        values = self.values(out)["fragile"]
        with h5py.File(out) as file:
            torque = next(values[:] for name, values in file["instances"].items()
                          if "torque" in name)
        np.testing.assert_allclose(values[:, 0], torque)
        np.testing.assert_array_equal(np.isnan(values[:, 1]), torque > 440)
        self.program("report", out, "--json", self.folder / "a.json")
        counted = json.loads((self.folder / "a.json").read_text())["failures"]["no_value"]
        self.assertEqual({one["name"]: one["gearboxes"] for one in counted}["fragile"],
                         [0, int((torque > 440).sum())])

    def test_returns_that_are_no_numbers_are_reported(self):
        for returned, message in (("1j", "returned 1j, not a real number"),
                                  ("None", "returned None, not a real number"),
                                  ("'a' * 10**6", "returned 'aaaa"),
                                  ("record.te", "returned an array of shape"),
                                  ("[1.0]", "returned [1.0], not a real number"),
                                  ("exit(3)", "SystemExit: 3"),
                                  ("f(record)", "RecursionError"),
                                  ("record.sensor.__isub__(1)", "read-only")):
            study = self.study(f"def f(record):\n    return {returned}\n")
            out = self.run_study(study, "a.h5", "--force", *FEW)
            self.assertIn("own.py:", self.output)
            self.assertIn(message, self.output)
            self.assertTrue(np.isnan(self.values(out)["f"]).all())
        study = self.study("def f(record):\n    return [1.0]\nf.batch = True\n")
        self.run_study(study, "a.h5", "--force", *FEW)
        self.assertIn("own.py:1: TypeError: returned an array of shape (1,)", self.output)
        study = self.study("import numpy as np\ndef f(record):\n    return np.float32('inf')\n")
        out = self.run_study(study, "a.h5", "--force", *FEW)
        self.assertTrue(np.isnan(self.values(out)["f"]).all())

    def test_bad_files_are_refused_before_anything_is_computed(self):
        for source, message in (
                ("def f(record)\n    return 1\n", "own.py:1: SyntaxError: expected ':'"),
                ("import numpy\nimport not_there\n", "own.py:2: ModuleNotFoundError"),
                ("def f(signal):\n    return 1\n", "own.py: has no feature"),
                ("def sensor_rms(record):\n    return 1\n",
                 '"sensor_rms" is a feature of the program; rename the function'),
                ("def f(record, other):\n    return 1\n", "own.py:1: f: unknown parameter other"),
                ("def f(record):\n    return 1\nf.alarm = 'left'\n", "alarm = 'left'"),
                ("def f(record):\n    return 1\nf.unit = 3\n", "unit = 3, but it is a line of text"),
                ("def \u00fc(record):\n    return 1\n", "only ASCII letters"),
                ("def feature(record):\n    return 1\ndef own(record):\n    return 2\n",
                 "own.py:3: own: the file has another feature of this name"),
                ("raise SystemExit(0)\n", "own.py:1: SystemExit: 0"),
                ("import os\nos._exit(5)\n", "ended with exit code 5"),
                ("import os\nos.kill(os.getpid(), 11)\n", "was ended by signal 11"),
                ("\0", "own.py")):
            self.program("run", self.study(source), code=2)
            self.assertIn(message, self.output)
            self.assertRegex(self.output, r"study\.toml:\d+: features\.python: ")
            self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["own.py", "study.toml"])
        for files, message in (('["own.py", "own.py"]', "is also in"),
                               ('"own.py"', "must be a list of Python files"),
                               ("[1]", "must be a list of files, but contains an integer"),
                               ("[{ name = 'f' }]", "a table needs name, file and sha256"),
                               ('["none.py", "."]', "none.py: cannot be read"),
                               ('["/dev/zero"]', "/dev/zero: is not a regular file"),
                               ('["pipe"]', "pipe: is not a regular file")):
            if "pipe" in files:
                os.mkfifo(self.folder / "pipe")
            study = self.study("def f(record):\n    return 1\n", files=files)
            self.program("run", study, code=2)
            self.assertIn(message, self.output)
        self.program("describe", self.study("raise SystemExit(0)\n"), code=2)
        self.assertIn("own.py:1: SystemExit: 0", self.output)
        self.program("describe", self.study(COUNTERPARTS), code=2, GEARPOD_PYTHON="/no/python")
        self.assertIn("/no/python cannot be started", self.output)

    def test_output_cannot_disturb_the_protocol(self):
        source = ("import os, sys\ndef f(record):\n"
                  "    print('x' * 100000)\n    sys.stdout.write('y' * 100000)\n"
                  "    os.write(1, b'z' * 100000)\n    sys.stdin.read()\n    return 2.5\n")
        out = self.run_study(self.study(source), "a.h5")
        self.assertTrue((self.values(out)["f"] == 2.5).all())

    def start(self, study):
        self.errors = open(self.folder / "errors", "w+", encoding="utf-8")
        self.addCleanup(self.errors.close)
        process = subprocess.Popen([PROGRAM, "run", study, "--out", self.folder / "a.h5", "--set",
                                    "numerics.threads=1"], stderr=self.errors,
                                   stdout=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        marks = []
        end = time.monotonic() + 120
        while not marks and time.monotonic() < end:
            marks = list(self.folder.glob("hangs-*"))
            time.sleep(0.05)
        self.assertTrue(marks)
        return process, int(marks[0].name.split("-")[1])

    HANGS = ("import os, pathlib, time\ndef f(record):\n"
             "    (pathlib.Path(__file__).parent / f'hangs-{os.getpid()}').touch()\n"
             "    while True:\n        time.sleep(1)\n")

    def messages(self):
        self.errors.seek(0)
        return " ".join(self.errors.read().split())

    def is_gone(self, pid):
        for _ in range(100):
            try:
                os.kill(pid, 0)
            except ProcessLookupError:
                return True
            time.sleep(0.05)
        return False

    def test_a_feature_that_hangs_is_stopped(self):
        process, pid = self.start(self.study(self.HANGS))
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGUSR1, signal.SIGUSR2, signal.SIGXCPU, signal.SIGHUP):
            os.kill(pid, number)  # as batch queues and terminals do
        time.sleep(0.3)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 4)
        self.assertTrue(self.is_gone(pid))
        self.assertIn("continue with --resume", self.messages())

    def test_a_worker_that_is_killed_is_an_error(self):
        process, pid = self.start(self.study(self.HANGS))
        os.kill(pid, signal.SIGKILL)
        self.assertEqual(process.wait(60), 4)
        self.assertRegex(self.messages(), r"gearbox \d+, row \d+ of the results: the Python "
                                          r"process was ended by signal 9")

    def test_a_worker_ends_with_the_program(self):
        process, pid = self.start(self.study(self.HANGS))
        process.kill()
        process.wait(60)
        self.assertTrue(self.is_gone(pid))

    def test_describe_lists_features_and_is_not_stopped_by_one_that_hangs(self):
        self.program("describe", self.study(COUNTERPARTS), "--full", "--seconds", "2")
        self.assertIn("features in Python", self.output)
        self.assertIn("level in Python; unit m/s^2, high values alarm", self.output)
        self.program("describe", self.study(self.HANGS), "--full", "--seconds", "2")
        self.assertIn("not computed", self.output)

    def test_recordings_have_the_features(self):
        study = self.study(COUNTERPARTS, use='["sensor_rms"]')
        record = self.folder / "record.h5"
        self.program("simulate", study, "--instance", 20, "--meshes", 2511, "--out", record)
        self.program("features", record, "--study", study, "--json", self.folder / "f.json")
        found = json.loads((self.folder / "f.json").read_text())["features"]
        for own, built_in in PAIRS.items():
            self.assertAlmostEqual(found[own] / found[built_in], 1.0, places=9)
        self.write("own.py", "def broken(record):\n    return 1 / 0\n")
        self.program("features", record, "--study", study, "--json", self.folder / "f.json")
        self.assertIn("own.py:2: ZeroDivisionError",
                      json.loads((self.folder / "f.json").read_text())["unavailable"]["broken"])
        table = self.folder / "f.csv"
        self.program("features", record, record, "--study", study, "--csv", table)
        self.assertIn("broken: " + str(self.folder / "own.py") + ":2: ZeroDivisionError", self.output)

    def test_sweeps(self):
        study = self.study(COUNTERPARTS)
        self.program("sweep", study, "--vary", "sensor.noise_m_s2=[1,2]", "--out", self.folder / "s",
                     "--instances", "7")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
