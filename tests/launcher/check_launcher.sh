#!/bin/sh
# Checks the launcher where something is missing, with fake programs on the PATH.
#   check_launcher.sh LAUNCHER
set -eu
launcher=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() {
    echo "FAILED: $*" >&2
    cat "$work/said" >&2
    exit 1
}

# A tree with the launcher alone, and a PATH with only the programs that it calls.
tree=$work/tree bin=$work/bin
mkdir -p "$tree/cmake" "$bin"
cp "$launcher" "$tree/gearpod"
cp "$(dirname -- "$launcher")/cmake/packages.txt" "$tree/cmake"
for tool in sh readlink dirname mkdir touch mv rm ln find head tail id env sed awk cat grep tr \
    getconf; do
    ln -s "$(command -v $tool)" "$bin/$tool"
done
fake() {
    printf '#!/bin/sh\n%s\n' "$2" >"$bin/$1"
    chmod +x "$bin/$1"
}
# Usage: expect CODE WORD... checks the launcher's exit code and output for the arguments $asked.
asked=--version
expect() {
    code=0
    PATH=$bin "$tree/gearpod" $asked >"$work/said" 2>&1 || code=$?
    [ "$code" -eq "$1" ] || fail "exit code $code instead of $1"
    shift
    for word in "$@"; do
        grep -qF -- "$word" "$work/said" || fail "it does not say: $word"
    done
}

# No Debian, no compiler and no cmake.
expect 2 compiler gcc-c++ gxx ninja-build
fake c++ ''
fake ninja ''
expect 2 cmake
grep -q gcc-c++ "$work/said" && fail "it names a compiler that is there"

# CMake reports two missing libraries.
fake cmake 'echo "CMake Error: gearpod is missing: fmt toml++"; exit 1'
expect 2 "missing: fmt toml++" fmt-devel libfmt-dev tomlplusplus-devel
grep -q eigen3-devel "$work/said" && fail "it names what is there"

# CMake fails for another reason, which is shown.
fake cmake 'echo "CMake Error: of another kind"; exit 1'
expect 1 "of another kind" "the build failed"

# Without Catch2 there is a program, but no tests.
fake cmake 'echo "-- without Catch2 2 no tests are built"'
asked=test
expect 2 "missing: Catch2" catch2-devel
asked=--version

# The program starts if nothing is missing.
ln -s "$(command -v chmod)" "$bin/chmod"
fake cmake "mkdir -p '$tree/build'; printf '#!/bin/sh\necho started gearpod\n' >'$tree/build/gearpod'
chmod +x '$tree/build/gearpod'"
expect 0 "started gearpod" building
expect 0 "started gearpod"
grep -q building "$work/said" && fail "it builds what it has built"

# Debian: missing packages are installed by apt-get as root, and named otherwise.
fake dpkg-query 'case $* in *libfmt-dev*) exit 1;; esac; printf "install ok installed"'
fake id 'echo 1000'
rm -r "$tree/build"
expect 2 "apt-get install libfmt-dev"
fake id 'echo 0'
fake apt-get 'echo "apt-get $*"'
expect 0 "installing with apt-get: libfmt-dev" "install -q -y --no-install-recommends libfmt-dev"

# Models in REXS need lxml.
fake dpkg-query 'case $* in *python3-lxml*) exit 1;; esac; printf "install ok installed"'
asked="new --rexs model.rexs"
expect 0 "installing with apt-get: python3-lxml"
asked=--version
expect 0 "started gearpod"
if grep -q lxml "$work/said"; then
    fail "it installs lxml without need"
fi
