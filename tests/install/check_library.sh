#!/bin/sh
# Builds and runs a program against the installed library.
#   check_library.sh BUILD
set -eu
build=$1
here=$(dirname -- "$(readlink -f -- "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "FAILED: $*" >&2
    exit 1
}

cmake --install "$build" --prefix "$work/first" --component development >"$work/log" ||
    fail "$(cat "$work/log")"
mv "$work/first" "$work/moved"
# Kernels and libraries of the build, found as it found them.
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
cmake -S "$here/example" -B "$work/example" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$work/moved" >"$work/log" 2>&1 ||
    fail "$(cat "$work/log")"
cmake --build "$work/example" >"$work/log" 2>&1 || fail "$(cat "$work/log")"
"$work/example/example" "$here/../../studies/planet-crack-ideal.toml" >"$work/out" || fail "example"
grep -q '^stiffness .*e+08 N/m, cracked' "$work/out" || fail "$(cat "$work/out")"
grep -q '^sensor \[m/s^2\]: [1-9]' "$work/out" || fail "$(cat "$work/out")"
grep -q '^a90 [1-9]' "$work/out" || fail "$(cat "$work/out")"

# A study with problems is refused with all of them.
printf '[gearbox]\nsun_teth = 1\n' >"$work/bad.toml"
if "$work/example/example" "$work/bad.toml" 2>"$work/message" >"$work/out"; then
    fail "a wrong study is accepted"
fi
grep -q 'bad.toml:2: gearbox.sun_teth: unknown key' "$work/message" || fail "$(cat "$work/message")"

"$work/example/own_functions" || fail "the library replaces functions of libm"
