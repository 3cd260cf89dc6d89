"""Checks the compiled module: python3 test_library.py PROGRAM SOURCES

Every function is compared with the program's own output. PROGRAM is gearpod in its build folder.
Exits with 77 without the module (Debian: pybind11-dev, python3-dev) or h5py.
"""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

PROGRAM, SOURCES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
sys.path.insert(0, str(SOURCES / "analysis" / "python"))
os.environ["GEARPOD_PROGRAM"] = str(PROGRAM)

try:
    import h5py
    import numpy as np

    import gearpod
    from gearpod.library import compiled
    compiled()
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

STUDY = SOURCES / "studies" / "planet-crack-ideal.toml"
LIFE = {"life.interval_h": 5, "life.first_depth_mm": 1, "life.last_depth_mm": 4,
        "life.depth_steps": 2, "life.paris_factor": 5e-7, "life.paris_exponent": 2.25,
        "life.records": 20, "life.healthy_lives": 2, "monitoring.baseline_records": 8,
        "monitoring.false_alarms_per_1000_h": 5, "sensor.noise_levels": "[1]",
        "features.use": '["window_ratio"]', "ensemble.instances": 2,
        "ensemble.threshold_instances": 4}


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True,
                          text=True).stdout


class Library(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.study = gearpod.Study(STUDY)

    def path(self, name):
        return pathlib.Path(self.folder.name, name)

    def test_stiffness(self):
        for option, transmission_error in ([], False), (["--te"], True):
            rows = list(csv.reader(program("stiffness", STUDY, "--csv", "-", *option).splitlines()))
            columns = self.study.stiffness(transmission_error=transmission_error)
            self.assertEqual(list(columns), rows[0])
            np.testing.assert_allclose(np.transpose(list(columns.values())),
                                       np.array(rows[1:], dtype=float), rtol=1e-8)
        self.assertEqual(columns.units["phase"], "mesh periods")
        self.assertEqual(gearpod.stiffness(STUDY, points=7)["phase"].shape, (7,))

    def test_modes(self):
        printed = json.loads(program("modes", STUDY, "--json", "-"))["frequencies_Hz"]
        np.testing.assert_array_equal(self.study.modes(), printed)

    def test_description(self):
        printed = program("describe", STUDY, "--full", "--seconds", "0.1")
        described = gearpod.describe(STUDY)
        self.assertEqual(list(described), ["gearbox", "effects simulated", "effects omitted"])
        self.assertIn(described["gearbox"]["mesh frequency"], printed)
        self.assertIn("tooth errors", described["effects omitted"])

    def test_commands_return_values(self):
        stage = {"sun": 21, "planet": 39, "ring": 99, "module": 12, "power": 1500, "speed": 18}
        options = [word for name, value in stage.items() for word in (f"--{name}", value)]
        self.assertEqual(gearpod.new("planetary", **stage), program("new", "planetary", *options))
        self.assertEqual(gearpod.check(STUDY), [])
        bad = self.path("bad.toml")
        bad.write_text("[gearbox]\nsun_teth = 19\n")
        self.assertIn("gearbox.sun_teth: unknown key", "\n".join(gearpod.check(STUDY, bad)))
        few = {"ensemble.threshold_instances": 40, "sensor.noise_levels": [1],
               "features.use": ["window_ratio"], "ensemble.instances": 28}
        out = self.path("points")
        swept = gearpod.sweep(STUDY, {"sensor.noise_m_s2": [1, 2]}, set=few, out=out, quiet=True)
        self.assertEqual(len(swept["points"]), 2)
        compared = gearpod.compare(*sorted(out.glob("*.h5")))
        self.assertEqual(len(compared["files"]), 2)
        measured = gearpod.accuracy(STUDY, set=few, gearboxes=0, repeats=1, seconds=2)
        self.assertTrue(measured["settings"])
        with self.assertRaisesRegex(gearpod.Failed, "--gearboxes"):
            gearpod.accuracy(STUDY, gearboxes=-1)

    def test_simulation(self):
        written = self.path("one.h5")
        program("simulate", STUDY, "--instance", 1, "--out", written)
        several = self.study.simulate([0, 1])
        one = gearpod.simulate(STUDY, 1)
        with h5py.File(written) as file:
            self.assertEqual(set(one.signals), set(file["signals"]))
            for name, values in one.signals.items():
                np.testing.assert_array_equal(values, file["signals"][name][()], name)
                np.testing.assert_array_equal(several.signals[name][1], values, name)
                self.assertEqual(one.signals.units[name], file["signals"][name].attrs["unit"])
            for name, values in one.features.items():
                np.testing.assert_array_equal(values, file["features"][name][()], name)
                np.testing.assert_array_equal(several.features[name][1], values, name)
            np.testing.assert_array_equal(one.noise_levels, file["noise_levels"][()])

    def test_meshes(self):
        short = self.study.simulate(0, meshes=3).signals
        whole = self.study.simulate(0).signals
        np.testing.assert_array_equal(short["sensor"], whole["sensor"][:len(short["sensor"])])
        self.assertLess(len(short["sensor"]), len(whole["sensor"]))

    def test_features(self):
        signals = self.study.simulate(0, meshes=310).signals
        written = self.path("recording.csv")
        np.savetxt(written, np.transpose([signals["time"], signals["sensor"]]), fmt="%.17g",
                   delimiter=",", header="time [s],sensor [m/s^2]", comments="")
        report = json.loads(program("features", written, "--study", STUDY, "--json", "-"))
        columns = {"time": signals["time"], "sensor [m/s^2]": signals["sensor"]}
        for measured in (columns, written):
            found = self.study.features(measured)
            self.assertEqual(found, report["features"])
            self.assertEqual(found.unavailable.keys(), report["unavailable"].keys())
        rate = 1 / (signals["time"][1] - signals["time"][0])
        plain = gearpod.features(signals["sensor"], STUDY, sampling_Hz=rate)
        self.assertAlmostEqual(plain["fm4"] / found["fm4"], 1, places=6)
        with self.assertRaisesRegex(gearpod.Failed, "signal: too short for every feature: 0 mesh"):
            self.study.features(signals["sensor"][:20], sampling_Hz=rate)
        with self.assertRaisesRegex(TypeError, "unknown option sampling; available: .*sampling_Hz"):
            self.study.features(columns, sampling=1)

    def test_pod(self):
        size = np.repeat(np.arange(1.0, 21.0), 3)
        chance = np.random.default_rng(1).random(size.size)
        hit = (chance < 1 / (1 + np.exp(8 - size))).astype(float)
        response = 2 + 3 * np.log(size) + 4 * (chance - 0.5)
        table = self.path("table.csv")
        np.savetxt(table, np.transpose([size, hit, response]), fmt="%.17g", delimiter=",",
                   header="size [mm],hit,response", comments="")
        columns = {"size [mm]": size, "hit": hit, "response": response}
        for option, options in (["--link", "logit"], {"link": "logit"}), (
                ["--response", "response", "--threshold", "9"],
                {"response": "response", "threshold": 9}):
            text = program("pod", table, "--json", "-", *option)
            report = json.loads(text)
            for given, name in ((table, str(table)), (columns, "table")):
                found = gearpod.pod(given, **options)
                self.assertEqual(found.report, json.loads(text.replace(str(table), name)))
            fit = report["hit_miss"] or report["signal_response"]
            self.assertEqual(found.a90[0], fit["a90"]["estimate"]["size"])
            self.assertEqual(list(found.curve["pod"]), fit["band"]["pod"])
            self.assertEqual(found.curve.units["size"], "mm")
        with self.assertRaisesRegex(gearpod.Failed, "table:2: column hit: 2 is neither"):
            gearpod.pod({"size": [1, 2, 3], "hit": [0, 2, 1]})
        with self.assertRaisesRegex(gearpod.Failed, "--convention: must be .*, but is both"):
            gearpod.pod(columns, convention="both")

    def test_frames(self):
        try:
            import pandas
            import xarray  # noqa: F401
        except ImportError as error:
            self.skipTest(str(error))
        simulated = self.study.simulate([0, 1], meshes=2).signals
        self.assertEqual(simulated.dataset()["sensor"].dims, ("row", "sample"))
        self.assertEqual(simulated.dataset()["sensor"].attrs["units"], "m/s^2")
        np.testing.assert_array_equal(simulated.frame().loc[1, "sensor"], simulated["sensor"][1])
        frame = pandas.DataFrame({"size": np.arange(1.0, 13.0),
                                  "hit": [0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 1]})
        self.assertEqual(gearpod.pod(frame).a90, gearpod.pod(dict(frame)).a90)

    def test_studies_in_memory(self):
        import tomllib
        text = STUDY.read_text(encoding="utf-8")
        expected = gearpod.stiffness(STUDY, points=5)
        for study in (text, tomllib.loads(text)):
            columns = gearpod.stiffness(study, points=5)
            self.assertEqual(list(columns), list(expected))
            np.testing.assert_array_equal(columns["sp1"], expected["sp1"])
        softer = gearpod.Study(STUDY, set={"gearbox.face_width_mm": 10}).stiffness(points=5)
        self.assertLess(softer["sp1"][0], expected["sp1"][0])

    def test_all_problems_are_raised(self):
        wrong = {"gearbox": {"sun_teth": 19}, "operation": {"torque": 1}}
        with self.assertRaises(gearpod.Failed) as caught:
            gearpod.Study(wrong)
        lines = str(caught.exception).splitlines()
        self.assertEqual(caught.exception.code, 2)
        self.assertTrue(any(line.startswith("study: gearbox.sun_teth: unknown key")
                            for line in lines), lines)
        self.assertTrue(any("operation.torque: unknown key" in line for line in lines), lines)
        written = self.path("wrong.toml")
        written.write_text("[gearbox]\nsun_teth = 19\n[operation]\ntorque = 1\n", encoding="utf-8")
        shown = subprocess.run([PROGRAM, "stiffness", written], capture_output=True, text=True,
                               check=False).stderr
        with self.assertRaises(gearpod.Failed) as caught:
            gearpod.stiffness(written)
        self.assertEqual(str(caught.exception), shown.strip())
        with self.assertRaisesRegex(gearpod.Failed, "nothing.toml: cannot be read"):
            gearpod.modes("nothing.toml")
        with self.assertRaisesRegex(gearpod.Failed, "must be a row of the results, 0 to"):
            self.study.simulate([0, 10**6])

    def test_other_threads_run_meanwhile(self):
        count, done = 0, threading.Event()
        thread = threading.Thread(
            target=lambda: (self.study.simulate(range(8)), done.set()))
        thread.start()
        while not done.wait(0.002):
            count += 1
        thread.join()
        self.assertGreater(count, 3)

    def test_own_values_are_graded_like_features(self):
        results = gearpod.run(STUDY, set={"ensemble.threshold_instances": 60}, instances=140,
                              progress=False, out=self.path("graded.h5"))
        report = results.report()
        at = results.level(1.0)
        for name in ("te_fc", "window_ratio"):
            graded = results.pod(results.feature(name, 1.0), name=name,
                                 alarm=results.alarms[name])
            detection = next(entry for entry in report["detection"]["features"]
                             if entry["name"] == name)["levels"][at]
            self.assertEqual(graded.report["detection"]["level"], detection)
            reliability = next(entry for entry in report["reliability"]["features"]
                               if entry["name"] == name)["levels"][at]
            self.assertEqual(graded.report["reliability"]["auc"], reliability["auc"])
            self.assertEqual(graded.report["reliability"]["hit_miss"], reliability["hit_miss"])
        with self.assertRaisesRegex(gearpod.Failed, "has 200 rows, but values has 3 values"):
            results.pod([1, 2, 3])
        with self.assertRaisesRegex(ValueError, "contains no lives"):
            _ = results.lives

    def test_lives(self):
        written = self.path("lives.h5")
        options = [text for key, value in LIFE.items() for text in ("--set", f"{key}={value}")]
        program("lives", STUDY, "--quiet", *options, "--out", written)
        results = gearpod.open(written)
        lives = results.lives
        self.assertEqual(results.features, ["window_ratio"])
        self.assertEqual(lives.crack_depth.shape, (8, 20))
        self.assertEqual(results.feature("window_ratio").shape, (8, 20))
        np.testing.assert_array_equal(lives.hours, 5.0 * np.arange(20))
        for row in range(8):
            depths = lives.crack_depth[row, :lives.records[row]]
            self.assertTrue(np.all(np.isfinite(depths)) and np.all(np.diff(depths) >= 0))
        with self.assertRaisesRegex(ValueError, "contains lives"):
            _ = results.reference

    def test_wheel(self):
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        environment["GEARPOD_BUILD"] = str(PROGRAM.parent)
        subprocess.run([sys.executable, "-m", "pip", "wheel", SOURCES / "analysis" / "python",
                        "--no-build-isolation", "--no-deps", "--no-index", "--quiet",
                        "--wheel-dir", self.folder.name], check=True, env=environment)
        wheel, = self.path("").glob("gearpod-*.whl")
        place = self.path("environment")
        made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", place],
                              capture_output=True, check=False)
        if made.returncode != 0:
            self.skipTest("no venv (Debian: python3-venv)")
        python = place / "bin" / "python"
        subprocess.run([python, "-m", "pip", "install", "--no-index", "--no-deps", "--quiet",
                        wheel], check=True)
        environment["GEARPOD_PROGRAM"] = "/nonexistent"
        output = subprocess.run(
            [python, "-c", "import gearpod, sys; print(gearpod.__file__); "
             "print(gearpod.modes(sys.argv[1])[-1])", STUDY],
            check=True, capture_output=True, text=True, cwd=self.folder.name,
            env=environment).stdout.split()
        self.assertTrue(output[0].startswith(str(place)), output)
        self.assertEqual(float(output[1]), self.study.modes()[-1])


if __name__ == "__main__":
    warnings.simplefilter("error", ResourceWarning)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
