"""Builds the wheel of the package (PEP 517). The package is pure Python, so the wheel is a zip of
the sources with three metadata files (PEP 427), and pip needs no other package."""

import base64
import hashlib
import pathlib
import zipfile

VERSION = "0.3.0"
NAME = f"gearpod-{VERSION}"
HERE = pathlib.Path(__file__).parent
METADATA = f"""Metadata-Version: 2.1
Name: gearpod
Version: {VERSION}
Summary: Results and runs of gearpod, the study program of gear fault detectability
License: BSD-3-Clause
Requires-Python: >=3.9
Requires-Dist: numpy
Provides-Extra: figures
Requires-Dist: matplotlib; extra == "figures"
Provides-Extra: frames
Requires-Dist: pandas; extra == "frames"
"""
WHEEL = "Wheel-Version: 1.0\nGenerator: gearpod\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    files = {f"gearpod/{path.name}": path.read_bytes()
             for path in sorted((HERE / "gearpod").iterdir())
             if path.suffix == ".py" or path.name == "py.typed"}
    files[f"{NAME}.dist-info/METADATA"] = METADATA.encode()
    files[f"{NAME}.dist-info/WHEEL"] = WHEEL.encode()
    record = f"{NAME}.dist-info/RECORD"
    lines = [f"{name},sha256={_digest(data)},{len(data)}" for name, data in files.items()]
    files[record] = "\n".join([*lines, f"{record},,"]).encode() + b"\n"
    wheel = f"{NAME}-py3-none-any.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in files.items():
            # Fixed date, so that equal sources give equal wheels.
            out.writestr(zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0)), data)
    return wheel


def _digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
