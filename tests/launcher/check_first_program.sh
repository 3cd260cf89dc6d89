#!/bin/sh
# Checks that the program with `run` alone gives the results of the whole one, and reports what it
# lacks.
#   check_first_program.sh WHOLE FIRST SOURCES
set -eu
whole=$1 first=$2 sources=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() {
    echo "FAILED: $*" >&2
    exit 1
}

study=$sources/tests/bench/rare_teeth.toml
small="--instances 16 --set ensemble.threshold_instances=16 --quiet"
# shellcheck disable=SC2086 # the list is meant to be split
{
    "$whole" run "$study" $small --out whole.h5 2>whole.txt
    "$first" run "$study" $small --out first.h5 2>first.txt
}
cmp whole.txt first.txt || fail "they say different things"
if command -v h5diff >/dev/null 2>&1; then
    for group in /instances /features /status /detection; do
        h5diff whole.h5 first.h5 $group $group || fail "$group differs"
    done
fi

# Bad input is refused identically.
for arguments in "run nosuch.toml" "run $study --bogus" "run $study --set gearbox.sun_teeth=0"; do
    code=0 own=0
    # shellcheck disable=SC2086
    {
        "$whole" $arguments >whole.txt 2>&1 || code=$?
        "$first" $arguments >first.txt 2>&1 || own=$?
    }
    [ "$code" -eq 2 ] && [ "$own" -eq 2 ] || fail "exit codes $code and $own of $arguments"
    cmp whole.txt first.txt || fail "$arguments is refused differently"
done

# The launcher builds missing parts, but not once for each rank of a run.
for arguments in "describe $study" "run $study --set numerics.integrator=\"rk4\"" \
    "run $study --set numerics.verify=true" "run /dev/stdin" "--version"; do
    code=0
    # shellcheck disable=SC2086
    echo | OMPI_COMM_WORLD_SIZE=2 "$first" $arguments >first.txt 2>&1 || code=$?
    [ "$code" -eq 2 ] || fail "exit code $code of $arguments by several ranks"
    grep -q "gearpod --help builds the rest" first.txt || fail "$arguments does not say what to do"
done
