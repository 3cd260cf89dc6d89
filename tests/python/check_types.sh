#!/bin/sh
# Checks the types of the Python package: check_types.sh SOURCES. Exits with 77 without mypy
# (Debian: mypy).
set -eu
if ! command -v mypy > /dev/null; then
    echo "skipped: mypy is not there (Debian: mypy)"
    exit 77
fi
exec mypy --strict --ignore-missing-imports --cache-dir /dev/null "$1/analysis/python/gearpod"
