"""Checks what results know of Python files: python3 test_python_hashes.py PROGRAM SOURCES

A run must not continue with a file that has changed, or with such a module of its folder.
"""

import hashlib
import sys
import unittest

from python_study_case import PythonStudyCase, h5py

LEVEL = "import numpy as np\ndef own(record):\n    return np.abs(record.sensor).max()\n"


class PythonHashes(PythonStudyCase):
    def test_a_changed_file_does_not_continue_a_run(self):
        study = self.study(LEVEL)
        self.run_study(study, "a.h5", "--instances", "7")
        self.write("own.py", LEVEL + "\n# changed\n")
        self.program("run", study, "--resume", "--out", self.folder / "a.h5", code=2)
        self.assertIn("sha256", self.output)
        self.program("misses", self.folder / "a.h5", "--feature", "own", "--size", 3, "--gearboxes",
                     8, "--records", 16, code=2)
        self.assertIn("own.py: has changed since the study was read", self.output)

    def test_a_changed_module_does_not_continue_a_run(self):
        def write_modules(factor):
            (self.folder / "parts").mkdir(exist_ok=True)
            self.write("parts/__init__.py", "")
            self.write("parts/level.py", f"import numpy as np\nFACTOR = {factor}\n"
                                         "def level(x):\n    return FACTOR * np.abs(x).max()\n")
            self.write("helper.py", "from parts.level import level\n")

        write_modules(1)
        self.write("other.py", "import json\ndef other(record):\n    return 1\n")
        study = self.study("import helper\ndef own(record):\n"
                           "    return helper.level(record.sensor)\n",
                           files='["own.py", "other.py"]')
        out = self.run_study(study, "a.h5", "--instances", "7")
        with h5py.File(out) as file:
            stored = file.attrs["study"]
        lines = [line for line in stored.splitlines() if 'name = "o' in line]
        hashes = {name: hashlib.sha256((self.folder / name).read_bytes()).hexdigest()
                  for name in ("helper.py", "parts/__init__.py", "parts/level.py")}
        own = ", ".join(f'"{name} {hashes[name]}"' for name in sorted(hashes))
        self.assertIn(f"modules = [{own}]", lines[0])
        self.assertNotIn("modules", lines[1])
        self.run_study(study, "a.h5", "--resume")
        self.program("report", out)
        write_modules(2)
        self.program("run", study, "--resume", "--instances", "21", "--out", out, code=2)
        self.assertIn("parts/level.py", self.output)
        again = ["misses", out, "--feature", "own", "--size", 3, "--gearboxes", 8, "--records", 16]
        self.program(*again, code=2)
        self.assertRegex(self.output, f"{self.folder}/parts/level.py: has changed since the study "
                                      f"was read: its SHA-256 is now [0-9a-f]{{64}}, not "
                                      f"{hashes['parts/level.py']}")
        self.write("helper.py", "def level(x):\n    return abs(x).max()\n")
        self.program(*again, code=2)
        self.assertIn(f"{self.folder}/helper.py: has changed", self.output)
        self.write("own.py", (self.folder / "own.py").read_text() + "import other\n")
        self.program("run", study, "--resume", "--instances", "21", "--out", out, code=2)
        self.assertIn("other.py", self.output)
        self.assertFalse(list(self.folder.rglob("__pycache__")))

    def test_a_module_that_a_function_imports_is_refused(self):
        self.write("late.py", "def level(x):\n    return abs(x).max()\n")
        study = self.study("def own(record):\n    import late, fractions\n"
                           "    return late.level(record.sensor)\n")
        self.program("run", study, "--out", self.folder / "a.h5", code=4)
        self.assertIn("own.py: a function imports late.py; import it outside of functions",
                      self.output)
        study = self.study("import late\ndef own(record):\n    import late, fractions\n"
                           "    return late.level(record.sensor)\n")
        self.run_study(study, "b.h5")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
