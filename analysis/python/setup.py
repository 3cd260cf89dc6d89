"""Puts the compiled module into the wheel (settings: pyproject.toml).

CMake builds the module, in `build` of the sources. GEARPOD_BUILD names a build folder whose module
is taken as it is. Nothing is written next to the Python sources.
"""

import os
import pathlib
import shutil
import subprocess
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def built_module():
    """Path of the module, built if no build folder is given."""
    given = os.environ.get("GEARPOD_BUILD")
    build = pathlib.Path(given) if given else ROOT / "build"
    if not given:
        if not (build / "CMakeCache.txt").is_file():
            subprocess.run(["cmake", "--preset", "release"], cwd=ROOT, check=True)
        subprocess.run(["cmake", "--build", build, "--target", "gearpod_python"], check=True)
    found = sorted((build / "python").glob("_library.*"))
    if not found:
        raise SystemExit(f"{build}: no compiled module; build the target gearpod_python")
    return found[0]


class CMakeModule(build_ext):
    def build_extension(self, ext):
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(built_module(), target)


work = pathlib.Path(tempfile.mkdtemp(prefix="gearpod-wheel-"))
try:
    setup(ext_modules=[Extension("gearpod._library", sources=[])],
          cmdclass={"build_ext": CMakeModule},
          options={"build": {"build_base": str(work)}, "egg_info": {"egg_base": str(work)}})
finally:
    shutil.rmtree(work, ignore_errors=True)
