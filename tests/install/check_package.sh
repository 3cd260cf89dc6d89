#!/bin/sh
# Checks the Debian package: its dependencies, and its files where they are unpacked.
#   check_package.sh BUILD
set -eu
build=$1
here=$(dirname -- "$(readlink -f -- "$0")")
for tool in dpkg-deb dpkg-shlibdeps; do
    command -v $tool >/dev/null || exit 77 # not Debian
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# shellcheck source=tests/install/check_program.sh
. "$here/check_program.sh"

(cd "$work" && cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work/made") >"$work/log" 2>&1 ||
    fail "$(cat "$work/log")"
package=$(echo "$work"/made/*.deb)
needs=$(dpkg-deb -f "$package" Depends)
for library in libc6 libstdc++6 libfmt libhdf5; do
    case $needs in
    *$library*) ;;
    *) fail "the package does not depend on $library: $needs" ;;
    esac
done
dpkg-deb -f "$package" Recommends | grep -q python3-matplotlib || fail "no python3-matplotlib"
dpkg-deb -x "$package" "$work/root"
check_program "$work/root/usr"
