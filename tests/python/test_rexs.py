"""Checks studies from gear-unit models: python3 test_rexs.py PROGRAM

PROGRAM is gearpod. Exits with 77 without lxml (Debian: python3-lxml).
"""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

from rexs_models import Model, gear_set, planetary, two_pairs

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None
if not importlib.util.find_spec("lxml"):
    print("skipped: no lxml (Debian: python3-lxml)")
    sys.exit(77)

SHIFTS = "addendum_modification_coefficient"
# Real gear sets: the values of new planetary, and the driving member with power, kW, and speed, rpm.
GEAR_SETS = {
    "Bell 206B": (dict(sun=27, planet=35, ring=99, planets=4, module=3.175, sun_shift=0.3, centre_distance=100.0125),
                  ("carrier", 250, 343.8)),
    "UH-60A": (dict(sun=62, planet=83, ring=228, planets=5, module=2.54), ("carrier", 2100, 258)),
    "NREL 750 kW": (dict(sun=21, planet=39, ring=99, module=10, helix=7.5, face_width=126), ("carrier", 750, 22.2)),
    "NREL 5 MW, stage 1": (dict(sun=19, planet=17, ring=56, module=45, face_width=491, sun_shift=0.617,
                                centre_distance=863), ("carrier", 5000, 12.1)),
    "Liang's rig": (dict(sun=19, planet=31, ring=81, planets=4, module=3.175), ("sun", 2.097, 46.68)),
    "SNU rig": (dict(sun=31, planet=31, ring=95, module=1, face_width=20, sun_shift=0.27, centre_distance=31.5),
                ("sun", 1.02, 975.5)),
    "62/17/96": (dict(sun=62, planet=17, ring=96, module=14, planet_shift=0.2, ring_shift=-0.5),
                 ("sun", 2300, 152.9))}


def run(*arguments, **environment):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300,
                          env={**os.environ, **environment})


class Rexs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def file(self, model):
        path = self.folder / "model.rexs"
        text = model.text() if isinstance(model, Model) else model
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def made(self, model, *options):
        """Text of the study, its keys by section (those of members as sun_teeth), and what the program prints."""
        done = run("new", "--rexs", self.file(model), *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        study = tomllib.loads(done.stdout)
        for member in [name for name, value in study["gearbox"].items() if isinstance(value, dict)]:
            study["gearbox"] |= {f"{member}_{key}": value for key, value in study["gearbox"][member].items()}
        return done.stdout, study, done.stderr

    def refused(self, model, *options, expect=(), **environment):
        """Lines of the refusal, which must hold these texts."""
        done = run("new", "--rexs", self.file(model), *options, **environment)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        for text in [expect] if isinstance(expect, str) else expect:
            self.assertIn(text, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done.stderr.splitlines()

    def test_a_planetary_stage_becomes_a_study_with_its_values(self):
        text, study, notices = self.made(planetary())
        self.assertLessEqual(
            {"kind": "planetary", "planets": 3, "sun_teeth": 20, "planet_teeth": 28, "ring_teeth": 76, "module_mm": 2,
             "pressure_angle_deg": 20, "centre_distance_mm": 48, "face_width_mm": 20, "young_modulus_Pa": 2.1e11,
             "poisson_ratio": 0.29, "planet_bearing_stiffness_N_m": 2.5e8}.items(), study["gearbox"].items())
        self.assertLessEqual({"input": "sun", "torque_N_m": 30.5, "sun_speed_rpm": 1500}.items(),
                             study["operation"].items())
        for texts in (notices, re.sub("\n# +", " ", text)):
            self.assertIn("torque from external_load 80 (30.5 N m)", texts)
            self.assertIn("ot in the model, by rule or chosen: helix angle (0 deg), tooth quality, sun's shift,", texts)
            self.assertIn("ot taken from the model: components: 1 gear_casing, 9 shaft", texts)
        self.assertIn("# - Stage 1 (planetary, 20/28/76 teeth, 3 planets) of model.rexs (REXS 1.4).\n", text)

    def test_real_gear_sets_have_the_same_study_from_a_model_as_from_options(self):
        for name, (values, (member, power, speed)) in GEAR_SETS.items():
            with self.subTest(name):
                load = ["--input", member, "--power", power, "--speed", speed]
                options = [word for key, value in values.items()
                           for word in (f"--{key.replace('_', '-')}", value)]
                by_options = run("new", "planetary", *options, *load)
                self.assertEqual(by_options.returncode, 0, by_options.stderr)
                by_model, _, _ = self.made(gear_set(**values), *load)
                self.assertEqual(by_model.partition("\ntitle = ")[2], by_options.stdout.partition("\ntitle = ")[2])

    def test_units_are_respected_and_unknown_ones_refused(self):
        model = planetary()
        for name, key, unit, text in (
                (10, "normal_module", "m", "0.002"), (10, "face_width", "m", "0.02"),
                (10, "normal_pressure_angle", "rad", "0.3490658503988659"), (11, "normal_pressure_angle", "\u00b0", "20"),
                (21, "tip_diameter", "mum", "60000"), (22, "tip_diameter", "mm", "60"), (23, "tip_diameter", "cm", "6"),
                (90, "elastic_modulus", "GPa", "210"), (80, "torque_around_u_axis", "N mm", "30500"),
                (50, "rotational_speed", "1 / s", "25"), (101, "radial_stiffness", "N / mm", "250000")):
            model.set(name, key, unit, text)
        _, study, _ = self.made(model)
        self.assertLessEqual({"module_mm": 2, "face_width_mm": 20, "pressure_angle_deg": 20, "planet_tip_mm": 60,
                              "young_modulus_Pa": 2.1e11, "planet_bearing_stiffness_N_m": 2.5e8}.items(),
                             study["gearbox"].items())
        self.assertLessEqual({"torque_N_m": 30.5, "sun_speed_rpm": 1500}.items(), study["operation"].items())
        model.set(10, "normal_module", "furlong", "2")
        model.set(11, "face_width", "", "20")
        model.set(90, "elastic_modulus", "mm", "210000")
        lines = self.refused(model, expect=[
            "cylindrical_gear 10: normal_module: unit furlong is not known; the units known here are mm, m, mum,",
            "ring_gear 11: face_width: states no unit", "material 90: elastic_modulus: unit mm is not known"])
        self.assertEqual(len(lines), 3)

    def test_a_tip_circle_inside_the_root_circle_is_refused_or_replaced_by_an_option(self):
        model = planetary()
        for planet in (21, 22, 23):
            model.set(planet, "tip_diameter", "mm", 1)
        lines = self.refused(model, expect=["cylindrical_gear 21: tip_diameter: 1 mm lies inside the root circle, ",
                                            "remove it from the model, and the rule is used, or give --addendum"])
        self.assertEqual(len(lines), 1)
        _, study, notes = self.made(model, "--addendum", "1")
        self.assertNotIn("planet_tip_mm", study["gearbox"])
        self.assertIn("replaces the tip diameter of cylindrical_gear 21, 1 mm", " ".join(notes.split()))

    def test_contradictions_are_refused_with_both_values_all_at_once(self):
        model = planetary()
        model.set(22, "number_of_teeth", "none", 29)
        model.set(32, "center_distance", "mm", 49)
        model.set(11, "normal_module", "mm", 2.5)
        self.refused(model, expect=["number_of_teeth: is 29, but cylindrical_gear 21 has 28",
                                    "center_distance: is 49, but cylindrical_stage 31 has 48",
                                    "normal_module: is 2.5, but that of cylindrical_gear 10 is 2"])
        model = planetary()
        for gear in (10, 11, 21, 22, 23):
            model.set(gear, SHIFTS, "none", 0)
        for pair in (31, 32, 33, 41, 42, 43):
            model.set(pair, "center_distance", "mm", 50)
        lines = self.refused(model, expect=["cylindrical_stage 31: center_distance: is 50 mm", "fit at 48 mm"])
        self.assertEqual(len(lines), 2)
        for pair in (31, 32, 33, 41, 42, 43):
            model.set(pair, "center_distance", "mm", 48.04)
        self.refused(model, expect="cylindrical_stage 41: center_distance: is 48.04 mm, but 28 and 76 teeth")
        for component, key, unit, value, words in (
                (52, "rotational_speed", "1 / min", 400, "400 rpm contradict 1500 rpm of shaft 50"),  # 1500 * 20 / 96 = 312.5
                (1, "number_of_planets", "none", 4, "is 4, but the model has 3 planet gears"),
                (51, "rotational_speed", "1 / min", 12, "the ring is not the fixed member: its shaft 51 turns at 12 rpm")):
            model = planetary()
            model.set(component, key, unit, value)
            self.refused(model, expect=words)
        model = planetary()
        model.set(52, "rotational_speed", "1 / min", -312.5)
        self.made(model)
        model.set(10, SHIFTS, "none", 0.4)
        model.set(10, "addendum_modification", "mm", 0.5)
        self.refused(model, expect="0.5 mm are 0.25 modules, but the coefficient is 0.4")

    def test_speed_and_torque_follow_the_stage_of_several(self):
        model = two_pairs()
        self.refused(model, expect=["the model has 2 stages", "1 (cylindrical_stage, 23/67 teeth); "
                                    "2 (cylindrical_stage, 20/76 teeth)"])
        self.refused(model, "--stage", "7", expect="there is no stage 7")
        # Shifts that fit at 53 mm.
        model.set(10, SHIFTS, "none", 0.581)
        model.set(11, SHIFTS, "none", 0.5131)
        _, study, _ = self.made(model, "--stage", "1")
        self.assertLessEqual({"kind": "fixed-shaft", "pinion_teeth": 23, "gear_teeth": 67, "helix_angle_deg": 30,
                              "centre_distance_mm": 53}.items(), study["gearbox"].items())
        self.assertLessEqual({"torque_N_m": 4.7, "pinion_speed_rpm": 1400}.items(), study["operation"].items())
        _, study, _ = self.made(model, "--stage", "2")
        self.assertAlmostEqual(study["operation"]["torque_N_m"], 4.7 * 67 / 23, places=7)
        self.assertAlmostEqual(study["operation"]["pinion_speed_rpm"], 1400 * 23 / 67, places=5)
        # A load that brakes: the gear at the other end drives.
        model.set(80, "torque_around_u_axis", "N m", -4.7)
        _, study, _ = self.made(model, "--stage", "1")
        self.assertEqual(study["gearbox"]["pinion_teeth"], 67)
        self.assertAlmostEqual(study["operation"]["torque_N_m"], 4.7 * 67 / 23, places=7)
        model.set(11, "helix_angle_reference_diameter", "deg", 30)
        self.refused(model, "--stage", "1", expect="opposite hands")

    def test_stages_that_shafts_connect_become_the_studies_of_a_train(self):
        model, out = two_pairs(), self.folder / "t.toml"
        model.set(10, SHIFTS, "none", 0.581)
        model.set(11, SHIFTS, "none", 0.5131)
        done = run("new", "train", "--rexs", self.file(model), "--stage", 2, "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        study = tomllib.loads(out.read_text())
        self.assertEqual(study["title"], "Gear pair 20/76, stage 2 of model.rexs: crack of a pinion tooth")
        self.assertEqual(study["sensor"]["stages"], [{"name": "stage-1", "study": "t-stage-1.toml", "shaft": "pinion",
                                                      "stage_shaft": "gear", "gain": 1}])
        other = tomllib.loads((self.folder / "t-stage-1.toml").read_text())
        self.assertEqual(other["gearbox"]["gear"]["teeth"], 67)
        self.assertEqual(other["operation"]["torque_N_m"], 4.7)
        self.assertEqual(run("check", out).returncode, 0)
        self.assertEqual(run("new", "train", "--rexs", self.file(model), "--out", self.folder / "u.toml").returncode, 2)
        done = run("new", "train", "--rexs", self.file(planetary()), "--out", self.folder / "u.toml")
        self.assertIn("no shaft connects the stage with another", done.stderr)

    def test_loads_that_a_model_lacks_are_required_as_options(self):
        model = planetary()
        model.attributes[50].clear()
        self.refused(model, expect="--torque, --speed, --power: the model states a torque, but no speed of the stage; "
                     "give --speed or --power")
        _, study, _ = self.made(model, "--speed", 900)
        self.assertEqual(study["operation"]["sun_speed_rpm"], 900)
        # A driving carrier has the torque and speed that balance the sun's.
        _, study, _ = self.made(planetary(), "--input", "carrier")
        self.assertAlmostEqual(study["operation"]["torque_N_m"], 30.5 * 96 / 20, places=6)
        self.assertAlmostEqual(study["operation"]["carrier_speed_rpm"], 1500 * 20 / 96, places=6)

    def test_load_cases_replace_attributes_and_several_need_a_choice(self):
        model = planetary()
        cases = [f'<load_case id="{name}"><component id="80" type="external_load"><attribute id="torque_around_u_axis" '
                 f'unit="N m">{torque}</attribute></component></load_case>' for name, torque in ((1, 12), (2, 14))]
        model.load_spectrum = f'<load_spectrum id="1">{cases[0]}</load_spectrum>'
        self.assertEqual(self.made(model)[1]["operation"]["torque_N_m"], 12)
        model.load_spectrum = f'<load_spectrum id="1">{"".join(cases)}</load_spectrum>'
        self.refused(model, expect="--load-case: the model has 2 load cases; choose one: 1, 2")
        self.assertEqual(self.made(model, "--load-case", "2")[1]["operation"]["torque_N_m"], 14)

    def test_what_a_study_does_not_take_is_named(self):
        model = planetary()
        model.add(95, "flank_geometry", width_crowning=("mum", 8), grinding_allowance=("mm", "0.0"))
        model.relate("flank", gear=10, left=95, right=95)
        model.add(96, "shaft_section")
        model.set(101, "radial_stiffness", "N / m", "1e20")
        model.set(101, "axial_stiffness", "N / m", "3e7")
        model.set(31, "rotating_angle_around_neg_u_axis", "deg", 100)
        model.set(11, "face_width", "mm", 18)
        _, study, notices = self.made(model)
        for text in ("flank_geometry: width_crowning (8 mum)", "1 shaft_section", "concept_bearing 101 (1e+20 N/m)",
                     "axial_stiffness (3e7 N / m)", "planets at 0, 100, 240 deg",
                     "face widths 20 mm of cylindrical_gear 10, 20 mm of cylindrical_gear 21, 18 mm of ring_gear 11"):
            self.assertIn(text, notices)
        self.assertNotIn("grinding_allowance", notices)
        self.assertEqual(study["gearbox"]["face_width_mm"], 18)

    def test_every_version_of_rexs_1_is_read_and_others_refused(self):
        model = planetary()
        for minor in range(8):
            model.version = f"1.{minor}"
            self.assertEqual("is newer than 1.6" in self.made(model)[2], minor > 6)
        for version in ("2.0", "1.x", "1.", "one"):
            model.version = version
            self.refused(model, expect=f"version {version} of REXS is not known")
        model.version = ""
        self.refused(model, expect="states no version")

    def test_hostile_and_foreign_files_are_refused_with_their_reason(self):
        secret = self.folder / "secret.txt"
        secret.write_text("a secret")
        model = planetary()
        for entities in ('<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;"><!ENTITY c "&b;&b;&b;&b;">',
                         f'<!ENTITY c SYSTEM "file://{secret}">', '<!ENTITY % c SYSTEM "http://127.0.0.1:9/x.dtd"> %c;'):
            model.prologue = f"<!DOCTYPE bomb [{entities}]>"
            text = model.text().replace('<component id="1"', '<component name="&c;" id="1"')
            for text in (model.text(), model.text().replace(">20<", ">&c;<"), text):
                lines = self.refused(text, expect=self.folder.name)
                self.assertEqual(len(lines), 1)
                self.assertRegex(lines[0], "document type declaration|not well-formed")
                self.assertNotIn("a secret", lines[0])
        many = '<model version="1.4">' + "<a/>" * 2_000_001 + "</model>"
        attributes = '<model version="1.4"><components><component id="1" type="x">' + \
            '<attribute id="a" unit="b">c</attribute>' * 900_000 + "</component></components></model>"
        for text, reason in (
                ('<model version="1.4">' + "<a>" * 300_000 + "</a>" * 300_000 + "</model>", "nested more than 16"),
                ("PK\x03\x04 archive", "ZIP archive"), (b"\x1f\x8b\x08", "gzip"), ('{"model": {}}', "is JSON"), ("", "is empty"),
                ("<html></html>", "its root is <html>"), (b"\x00\xff" * 99, "not well-formed XML"),
                ('<model version="1.4"><components></model>', "not well-formed XML"), (many, "XML tags"),
                (b'<model version="1.4" name="\xe4"/>', "not well-formed XML (Input is not proper UTF-8"),
                ('<model version="1.4">&c;</model>', "not well-formed XML (Entity 'c' not defined)"),
                ('<model version="1.4"/>', "has no gear stages"), (attributes, "has no gear stages"),
                (planetary().text()[:4000], "not well-formed XML")):
            self.assertEqual(len(self.refused(text, expect=reason)), 1)
        for path, reason in (("pipe", "is a device, a pipe or a socket"), ("folder", "is a folder"), ("huge", "has 1024 MB"),
                             ("none", "cannot be read (No such file or directory); name an existing REXS file")):
            path = self.folder / path
            if path.name == "pipe":
                os.mkfifo(path)
            elif path.name == "folder":
                path.mkdir()
            elif path.name == "huge":
                path.write_text("<model/>")
                os.truncate(path, 1 << 30)
            done = run("new", "--rexs", path)
            self.assertEqual(done.returncode, 2)
            self.assertIn(reason, done.stderr)

    def test_damaged_models_are_refused_or_read(self):
        text = planetary().text().encode()
        for i in range(30):
            at = (i * 7919) % len(text)
            with self.subTest(at=at):
                done = run("new", "--rexs", self.file(text[:at] + bytes([(i * 37) % 256]) + text[at + 1 + i % 3:]))
                self.assertIn(done.returncode, (0, 2))
                self.assertNotIn("Traceback", done.stderr)
                self.assertNotIn("ended with", done.stderr)

    def test_values_without_bound_are_refused(self):
        for key, value in (("number_of_teeth", "1e308"), ("normal_module", "1e308"), ("normal_module", "1e-320"),
                           ("normal_pressure_angle", "90"), ("face_width", "-1e308"), (SHIFTS, "1e308")):
            model = planetary()
            for gear in (10, 11, 21, 22, 23):
                unit = model.attributes[gear].get(key, ("none", ""))[0]
                model.set(gear, key, unit, value)
            with self.subTest(key=key, value=value):
                self.assertGreater(len(self.refused(model)), 0)

    def test_stages_that_are_not_simulated_are_listed_with_the_reason(self):
        model = two_pairs()
        model.add(3, "bevel_stage")
        model.types[11] = "ring_gear"
        self.refused(model, "--stage", "3", expect="only planetary and cylindrical stages are simulated")
        self.refused(model, "--stage", "1", expect="internal gears on fixed shafts")
        self.made(model)  # the only possible one needs no choice
        model.relate("stage", stage=99, gear_1=10)
        self.refused(model, expect="component 99 (stage) does not exist")
        model = planetary()
        model.add(34, "cylindrical_stage")
        model.relate("assembly", assembly=1, part=34)
        model.relate("stage", stage=34, gear_1=21, gear_2=22)
        self.refused(model, expect="both planets, so that the planets are stepped or paired")

    def test_a_written_study_is_described_and_the_models_values_are_no_options(self):
        model, study = self.file(two_pairs()), self.folder / "m.toml"
        done = run("new", "--rexs", model, "--stage", 2, "--out", study)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not in the model, by rule or chosen", done.stderr)
        self.assertEqual(run("describe", study).returncode, 0)
        self.assertEqual(run("new", "--rexs", model, "--stage", 2, "--out", model, "--force").returncode, 2)
        for options in (["--sun", 20], ["--module", 2], ["planetary"], ["--planets", 3], ["--input", "carrier"]):
            self.assertEqual(run("new", "--rexs", model, "--stage", 2, *options).returncode, 2)
        numbers = ["--sun", 20, "--planet", 28, "--module", 2, "--torque", 3, "--speed", 9]
        self.assertEqual(run("new", "planetary", *numbers, "--stage", 1).returncode, 2)
        self.assertEqual(run("new").returncode, 2)
        self.assertIn("--sun", run("new", "planetary", *numbers[2:]).stderr)

    def test_a_missing_interpreter_or_library_is_named(self):
        self.refused(planetary(), GEARPOD_PYTHON="/nowhere/python3",
                     expect="install python3, or name another Python 3 in GEARPOD_PYTHON")
        python = self.folder / "python"
        python.write_text(f"#!/bin/sh\nexec {sys.executable} -S \"$@\"\n")  # without Debian's packages
        python.chmod(0o755)
        self.refused(planetary(), GEARPOD_PYTHON=python, expect="No module named 'lxml'; install python3-lxml")


if __name__ == "__main__":
    unittest.main()
