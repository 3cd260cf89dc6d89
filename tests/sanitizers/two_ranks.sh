#!/bin/sh
# Small studies by two ranks of two threads each, and by one rank: the same features, and no report
# of a sanitizer, which would end the program with a code of its own.
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
    # Open MPI unloads the modules that leave memory behind: nothing could tell it from ours. One
    # rank's is looked at below.
    ASAN_OPTIONS=detect_leaks=0 "$mpiexec" --oversubscribe --bind-to none -n 2 \
        "$program" run "$@" --force --out "$work/two.h5"
    "$program" run "$@" --force --out "$work/one.h5"
    h5diff "$work/one.h5" "$work/two.h5" /features
    rm "$work"/*.h5*
}
check planet-crack-ideal.toml --set operation.carrier_speed_rpm=60 --set sensor.sampling_Hz=20000 \
    --set sensor.encoder_sampling_Hz=20000
check gusts.toml
