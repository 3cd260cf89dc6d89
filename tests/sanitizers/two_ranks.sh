#!/bin/sh
# Runs small studies on two ranks of two threads each, and on one rank: equal features, and no
# report of a sanitizer, which would end the program with a separate exit code.
#   two_ranks.sh PROGRAM MPIEXEC STUDIES
set -eu
program=$1 mpiexec=$2 studies=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

check() {
    study=$1
    shift
    set -- "$studies/$study" --instances 24 --set ensemble.threshold_instances=16 \
        --set numerics.threads=2 "$@"
    # Open MPI unloads modules that leak memory, which cannot be attributed then. Leaks of one rank
    # are checked below.
    ASAN_OPTIONS=detect_leaks=0 "$mpiexec" --oversubscribe --bind-to none -n 2 \
        "$program" run "$@" --force --out "$work/two.h5"
    "$program" run "$@" --force --out "$work/one.h5"
    h5diff "$work/one.h5" "$work/two.h5" /features
    rm "$work"/*.h5*
}
check planet-crack-ideal.toml --set operation.carrier_speed_rpm=60 --set sensor.sampling_Hz=20000 \
    --set sensor.encoder_sampling_Hz=20000
check gusts.toml
