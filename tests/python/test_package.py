"""Checks the Python package: python3 test_package.py PROGRAM SOURCES

PROGRAM is gearpod, SOURCES its sources. Exits with 77 without h5py (Debian: python3-h5py).
"""

import importlib.util
import os
import pathlib
import sys
import tempfile
import unittest
import warnings

PROGRAM, SOURCES = (pathlib.Path(argument) for argument in sys.argv[1:3])
PACKAGE = SOURCES / "analysis" / "python"
sys.path.insert(0, str(PACKAGE))
os.environ["GEARPOD_PROGRAM"] = str(PROGRAM)

try:
    import h5py
    import numpy as np
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-h5py)")
    sys.exit(77)
import gearpod  # noqa: E402
from gearpod.program import toml_value  # noqa: E402

STUDY = SOURCES / "studies" / "planet-crack-ideal.toml"
SMALL = {"ensemble.threshold_instances": 60, "sensor.noise_levels": [0, 1]}


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.results = gearpod.run(STUDY, set=SMALL, instances=140, progress=False,
                                  out=pathlib.Path(cls.folder.name, "r.h5"))

    def test_values_match_the_file(self):
        results = self.results
        self.assertEqual(len(results), 200)
        self.assertEqual(results.reference, 1.0)
        with h5py.File(results.path) as file:
            np.testing.assert_array_equal(results.size, file["instances/fault_depth_m"][()])
            np.testing.assert_array_equal(results.feature("te_fc", 1.0),
                                          file["features/te_fc"][:, 1])
            np.testing.assert_array_equal(results.rows("graded"),
                                          np.flatnonzero(file["instances/group"][()] == 1))
        self.assertIn("noise_levels = [0, 1]", results.study)
        self.assertEqual(results.units["fault_depth_m"], "m")

    def test_rates_follow_from_the_values(self):
        rates = self.results.detection_columns()
        graded = self.results.rows("graded")
        for i in range(len(rates["feature"])):
            name = rates["feature"][i]
            side = 1.0 if self.results.alarms[name] == "high" else -1.0
            values = self.results.feature(name, rates["noise_level"][i])[graded]
            here = np.isclose(self.results.size[graded], rates["size_high"][i])
            self.assertEqual(rates["detected"][i],
                             np.sum(side * values[here] > side * rates["threshold"][i]), name)
        self.assertEqual(self.results.alarms["te_fc"], "low")

    def test_frames(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not there")
        frame = self.results.frame()
        self.assertEqual(len(frame), 200)
        np.testing.assert_array_equal(frame["te_fc"], self.results.feature("te_fc", 1.0))
        self.assertEqual(set(self.results.detection()["noise_level"]), {0.0, 1.0})

    def test_dataset(self):
        try:
            import xarray  # noqa: F401
        except ImportError:
            self.skipTest("xarray is not there")
        dataset = self.results.dataset()
        self.assertEqual(dict(dataset.sizes), {"gearbox": 200, "noise": 2})
        np.testing.assert_array_equal(dataset["te_fc"].sel(noise=1.0), self.results.feature("te_fc", 1.0))
        self.assertEqual(dataset["sensor_rms"].attrs["units"], "m/s^2")
        self.assertEqual(int((dataset["group"] == 0).sum()), 60)

    def test_variants_give_the_findings_of_the_report(self):
        """Alarms of another fault and areas of all sensors, computed again."""
        bearing = {"fault": "outer", "shaft": "sun", "elements": 9, "diameter_ratio": 0.2,
                   "amplitude_m_s2": 5, "resonance_Hz": 500, "role": "other_fault"}
        results = gearpod.run(
            STUDY, instances=140, progress=False, out=pathlib.Path(self.folder.name, "v.h5"),
            set={**SMALL, "sensor.bearings": [bearing],
                 "sensor.additional": [{"name": "side", "angle_deg": 90}]})
        self.assertEqual(list(results.variants), ["sensor_side", "other_fault"])
        with self.assertRaisesRegex(KeyError, "available: sensor_side, other_fault"):
            results.variant("sensor_top", "window_ratio")
        report = results.report()
        healthy = results.rows("threshold")
        for found in report["other_fault"]:
            level = results.level(found["noise_level"])
            values = results.variant("other_fault", found["feature"])[healthy, level]
            detection = next(f for f in report["detection"]["features"]
                             if f["name"] == found["feature"])
            threshold = detection["levels"][level]["threshold"]
            side = 1.0 if results.alarms[found["feature"]] == "high" else -1.0
            self.assertEqual(found["alarms"], np.sum(side * values > side * threshold))
        first = next(f for f in report["sensors"] if f["name"] == "first")
        mean = next(f for f in report["sensors"] if f["name"] == "mean of all")
        level = results.level(1.0)
        graded = results.rows("graded")[results.size[results.rows("graded")] > 0]
        sound = np.setdiff1d(np.arange(len(results)), graded)

        def deviations(values):
            centre = np.median(values[healthy])
            return (values - centre) / (1.4826 * np.median(np.abs(values[healthy] - centre)))

        def area(values):
            above = values[graded][:, None] - values[sound][None, :]
            return np.mean(above > 0) + 0.5 * np.mean(above == 0)

        sensors = [deviations(results.feature(mean["feature"], 1.0)),
                   deviations(results.variant("sensor_side", mean["feature"])[:, level])]
        change = area(np.mean(sensors, axis=0)) - area(results.feature(first["feature"], 1.0))
        self.assertAlmostEqual(mean["auc"]["difference"], change, places=9)

    def test_signals_give_the_features(self):
        row = int(self.results.rows("graded")[-1])
        computed = self.results.signals(row)
        te = computed["te"] - np.mean(computed["te"])
        rms = np.sqrt(np.mean(te ** 2))
        self.assertAlmostEqual(rms / self.results.feature("te_rms", 0.0)[row], 1.0, delta=0.02)
        stored = gearpod.run(STUDY, set={**SMALL}, instances=140, progress=False, force=True,
                             out=pathlib.Path(self.folder.name, "same.h5"))
        np.testing.assert_array_equal(stored.signals(row)["sensor"], computed["sensor"])
        with self.assertRaises(IndexError):
            self.results.signals(200)

    def test_errors_are_reported(self):
        with self.assertRaisesRegex(KeyError, "available: .*te_fc"):
            self.results.feature("te_xx")
        with self.assertRaisesRegex(KeyError, "available: 0, 1"):
            self.results.feature("te_fc", 3.0)
        with self.assertRaisesRegex(gearpod.Failed, "sensor.noise: unknown key") as caught:
            gearpod.run(STUDY, set={"sensor.noise": 1}, progress=False,
                        out=pathlib.Path(self.folder.name, "none.h5"))
        self.assertEqual(caught.exception.code, 2)
        other = pathlib.Path(self.folder.name, "other.h5")
        h5py.File(other, "w").close()
        with self.assertRaisesRegex(ValueError, "not a results file"):
            gearpod.open(other)
        # HDF5 crashes on a text of 2^51 bytes, in a child process.
        damaged = bytearray(self.results.path.read_bytes())
        damaged[damaged.find(b"gearpod results") - 2] = 8
        other.write_bytes(damaged)
        with self.assertRaisesRegex(ValueError, "other.h5: is damaged"):
            gearpod.open(other)
        other.write_bytes(self.results.path.read_bytes())
        with h5py.File(other, "r+") as file:
            del file["noise_levels"]
            file["noise_levels"] = h5py.ExternalLink("elsewhere.h5", "/noise_levels")
        with self.assertRaisesRegex(ValueError, "other.h5: is damaged"):
            gearpod.open(other)
        with self.assertRaises(OSError):
            gearpod.open(other.with_name("nothing.h5"))

    def test_report_and_figures(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not there")
        matplotlib.use("agg")
        report = self.results.report()
        found = self.results.smallest_fault()
        self.assertEqual(found[0], report["reliability"]["levels"][1]["smallest_fault"]["size"])
        for draw in (gearpod.figures.detection, gearpod.figures.pod, gearpod.figures.roc,
                     gearpod.figures.scatter):
            axes = draw(self.results, "window_ratio", 1.0)
            self.assertIs(draw(self.results, "window_ratio", 1.0, axes), axes)
            self.assertGreaterEqual(len(axes.get_lines()), 2)
        curve = gearpod.figures.pod(self.results, "window_ratio", 1.0).get_lines()[0]
        self.assertAlmostEqual(curve.get_xdata()[-1], 4.28)  # mm, the largest crack
        refused = [(entry["name"], level["noise_level"], level["hit_miss"]["refusal"])
                   for entry in report["reliability"]["features"] for level in entry["levels"]
                   if level["hit_miss"]["refusal"]]
        self.assertTrue(refused)
        for name, noise, why in refused:
            with self.assertRaisesRegex(ValueError, f"{name}: {why}"):
                gearpod.figures.pod(self.results, name, noise)
        self.assertEqual(gearpod.figures.signal(self.results, 0).get_xlabel(), "time, s")

    def test_values_of_keys(self):
        for value, text in ((2, "2"), (True, "true"), ([0, 1.5], "[0, 1.5]"), ("rk4", '"rk4"'),
                            (np.float64(0.1), "0.1"), (np.arange(2), "[0, 1]"),
                            ({"uniform": [1, 2]}, "{ uniform = [1, 2] }")):
            self.assertEqual(toml_value(value), text)


if __name__ == "__main__":
    warnings.simplefilter("error", ResourceWarning)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
