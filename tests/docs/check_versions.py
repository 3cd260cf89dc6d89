"""One version everywhere: check_versions.py SOURCES"""

import pathlib
import re
import sys

PLACES = {
    "CMakeLists.txt": r"project\(gearpod VERSION (\S+)",
    "CITATION.cff": r"^version: (\S+)",
    "CHANGELOG.md": r"^## (\S+)",
    "README.md": r"gearpod, version (\d+\.\d+\.\d+)",
    "analysis/python/pyproject.toml": r'^version = "([^"]+)"',
}


def versions(sources):
    for name, pattern in PLACES.items():
        match = re.search(pattern, (sources / name).read_text(encoding="utf-8"), re.M)
        yield name, match.group(1) if match else "none"


if __name__ == "__main__":
    found = dict(versions(pathlib.Path(sys.argv[1])))
    print("\n".join(f"{name}: {version}" for name, version in found.items()))
    sys.exit(0 if len(set(found.values())) == 1 else 1)
