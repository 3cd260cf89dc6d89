#!/bin/sh
# Checks cmake --install into a prefix that is then moved.
#   check_install.sh BUILD
set -eu
build=$1
here=$(dirname -- "$(readlink -f -- "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck source=tests/install/check_program.sh
. "$here/check_program.sh"

cmake --install "$build" --prefix "$work/first" --strip >"$work/log" || fail "$(cat "$work/log")"
mv "$work/first" "$work/moved"
check_program "$work/moved"
