"""Arguments of the tests of pages, CASES PROGRAM SOURCES, and the cases. CASES holds the JSON from make_report_cases, PROGRAM is
gearpod, SOURCES its sources, whose modules of the report can be imported. Without matplotlib the test is skipped (77)."""

import json
import pathlib
import subprocess
import sys

CASES, PROGRAM, SOURCES = (pathlib.Path(argument) for argument in sys.argv[1:4])
sys.path.insert(0, str(SOURCES / "analysis" / "report"))

try:
    import matplotlib  # noqa: F401
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-matplotlib)")
    sys.exit(77)


def case(name):
    return json.loads((CASES / f"{name}.json").read_text())


def gearpod(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
