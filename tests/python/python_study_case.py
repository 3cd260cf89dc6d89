"""Study with features in Python next to it, for tests of the program: TEST.py PROGRAM SOURCES ...
Exits with 77 without numpy or h5py.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCES = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])

try:
    import h5py
    import numpy as np  # noqa: F401 (for the tests)
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

STUDY = (SOURCES / "studies" / "planet-crack-ideal.toml").read_text(encoding="utf-8")


class PythonStudyCase(unittest.TestCase):
    def setUp(self):
        self.place = tempfile.TemporaryDirectory()
        self.addCleanup(self.place.cleanup)
        self.folder = pathlib.Path(self.place.name)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def study(self, source, use='["te_rms"]', files='["own.py"]'):
        """A study in another folder than the working folder, and its Python file next to it."""
        self.write("own.py", source)
        text = re.sub(r"^use = .*$", f"use = {use}\npython = {files}", STUDY, flags=re.M)
        for key, value in (("instances", 14), ("threshold_instances", 20), ("noise_levels", [0, 1]),
                           ("sampling_Hz", 1250), ("low_pass_Hz", 400)):
            text = re.sub(rf"^{key} = .*$", f"{key} = {value}", text, flags=re.M)
        self.write("study.toml", text)
        return self.folder / "study.toml"

    def program(self, *arguments, code=0, before=(), **environment):
        done = subprocess.run([*before, PROGRAM, *map(str, arguments)], cwd="/", text=True,
                              capture_output=True, check=False, timeout=300,
                              env=dict(os.environ, **environment))
        self.output = " ".join((done.stdout + done.stderr).split())
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def run_study(self, study, name, *arguments, **more):
        out = self.folder / name
        self.program("run", study, "--out", out, "--quiet", *arguments, **more)
        return out

    def values(self, path):
        with h5py.File(path) as file:
            return {name: values[:] for name, values in file["features"].items()
                    if isinstance(values, h5py.Dataset)}
