#!/bin/sh
# Runs a new user's tasks, each in at most three commands: user_tasks.sh PROGRAM SOURCES [small]
# Prints one line per task with its seconds; `small` uses a few gearboxes of each study. Exits with
# 1 if a task fails or does not give its result. Tasks that need a missing program are skipped with
# a message.
set -eu
program=$(realpath "$1") sources=$(realpath "$2") size=${3:-whole}
studies=$sources/studies
graded='' healthy='' more='--instances 7000' sentence='is found with\|No tested'
if [ "$size" = small ]; then
    graded='--instances 7' healthy='--set ensemble.threshold_instances=16' more='--instances 28'
    sentence='Too few healthy gearboxes for a false-alarm rate'
fi
few="$graded $healthy"
export GEARPOD_PROGRAM="$program" PYTHONPATH="$sources/analysis/python" PYTHONDONTWRITEBYTECODE=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

gearpod() { "$program" "$@" < /dev/null 2>> said; }
python() { /usr/bin/python3 "$@"; }
# True if the file has the text, whose lines may be broken anywhere.
has() { tr -s '\n ' ' ' < "$1" | grep -aq -- "$2" || { echo "$1 does not say: $2"; return 1; }; }

datasheet_to_pod() {
    gearpod new planetary --sun 21 --planet 39 --ring 99 --module 12 --input carrier --power 1508 --speed 18 --out stage.toml > out &&
    gearpod run stage.toml $few --quiet &&
    gearpod report stage.h5 --html stage.html > out && has stage.html "class=\"answer\">[^<]*\($sentence\)"
}
compare_two_sensors() {
    gearpod run "$studies/planet-crack-ideal.toml" $few --quiet --out a.h5 &&
    gearpod run "$studies/planet-crack-ideal.toml" $few --quiet --set 'sensor.noise_m_s2={distribution="lognormal", median=2, cv=0.2}' --out b.h5 &&
    gearpod compare a.h5 b.h5 --html compare.html > out && has out 'test gearboxes that are the same' &&
    has out 'Smallest fault found with 90 % probability'
}
record_length_and_interval() {
    gearpod run stage.toml $few --set sensor.record_s=10 --set detection.record_interval_h=24 --out short.h5 > out &&
    head -n 12 out > first && has first "$sentence" && gearpod report short.h5 --section answer > out &&
    has out 'A record lasts 9.19 s and begins at a random tooth position' && has out 'There are 24 h between two records'
}
one_false_alarm_a_year() {
    gearpod describe stage.toml --full --set detection.false_alarms_per_1000_h=0.114 --set detection.record_interval_h=24 > out &&
    has out 'are a rate of 0.00274 in a record for each feature' && has out 'Healthy records needed for a rate of 0.00274: 365'
}
own_csv_with_tachometer() {
    gearpod features tachometer.csv --study "$studies/planet-crack-ideal.toml" --sensor 'a (g)' --tachometer tacho > out &&
    has out window_ratio
}
signals_in_python() {
    python -c 'import gearpod; print(sorted(gearpod.open("a.h5").signals(3)))' > out && has out "'sensor'"
}
own_feature() {
    python "$sources/tests/tasks/own_feature.py" a.h5 > out && has out 'crest factor'
}
recording_in_g() {
    gearpod features recording.csv --study "$studies/planet-crack-ideal.toml" --sensor a --sensor-unit g > out &&
    has out window_ratio
}
pdf_for_a_manager() {
    gearpod report a.h5 --pdf a.pdf > out && has a.pdf '%PDF'
}
sweep() {
    gearpod sweep "$studies/planet-crack-ideal.toml" $few --vary 'sensor.noise_m_s2=[0.5,1,2]' --quiet > out &&
    has out 'Smallest fault found with 90 % probability' && has out 'noise_m_s2 noise x 0'
}
more_gearboxes() {
    gearpod run "$studies/planet-crack-ideal.toml" $healthy $more --resume --out a.h5 > out &&
    head -n 12 out > first && has first "$sentence"
}
array_of_jobs() {
    gearpod run "$studies/planet-crack-ideal.toml" $few --quiet --part 1/2 --out 1.h5 &&
    gearpod run "$studies/planet-crack-ideal.toml" $few --quiet --part 2/2 --out 2.h5 &&
    gearpod merge 1.h5 2.h5 --out whole.h5 > out && has out 'results: whole.h5'
}
# Source: Liang (2016), Fig. 5.8, 1.95 at 4.28 mm in the thesis, 1.62 here; studies/README.md
# explains the difference.
published_figure() {
    python -m gearpod.published liang-fig-5-8 > out && [ -s published/liang-fig-5-8.png ] && has out '1.95 .*1.6.*at 4.28'
}

# A recording of a gearbox in g, as input of task 5.
gearpod simulate "$studies/planet-crack-ideal.toml" --instance 2000 --meshes 837 --out made.csv > out
awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i ~ /^time/) t = i; if ($i ~ /^sensor_noise_1/) s = i }; print "time,a"; next }
    { printf "%s,%.9g\n", $t, $s / 9.80665 }' made.csv > recording.csv

awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { if ($i ~ /^time/) t = i; if ($i ~ /^sensor_noise_1/) s = i; if ($i ~ /^mesh_phase/) m = i };
        print "time (s),a (g),tacho (V)"; next }
    { turn = int($m / 81); printf "%s,%.9g,%d\n", $t, $s / 9.80665, (turn > last || NR == 2) ? 5 : 0; last = turn }' made.csv > tachometer.csv

# Processor seconds used by finished commands.
processors() {
    times > times
    awk 'NR == 2 { for (i = 1; i <= 2; ++i) { split($i, t, /[ms]/); sum += 60 * t[1] + t[2] } } END { print sum }' times
}

failed=0
for task in datasheet_to_pod record_length_and_interval one_false_alarm_a_year compare_two_sensors signals_in_python own_feature recording_in_g own_csv_with_tachometer pdf_for_a_manager sweep \
    more_gearboxes array_of_jobs published_figure; do
    case $task in
        datasheet_to_pod | pdf_for_a_manager) has_what='import matplotlib' what=python3-matplotlib ;;
        *python | own_feature) has_what='import h5py' what=python3-h5py ;;
        published_figure) has_what='import h5py, matplotlib' what='python3-h5py or python3-matplotlib' ;;
        *) has_what='' what='' ;;
    esac
    if ! /usr/bin/python3 -c "$has_what" 2> /dev/null; then
        echo "$task: left out, $what is not there"
        continue
    fi
    : > said
    begin=$(date +%s.%N)
    processors > busy
    if $task; then
        end=$(date +%s.%N)
        read -r before < busy
        processors > busy
        read -r after < busy
        awk "BEGIN { printf \"%-20s %6.1f s, of processors %6.1f s\\n\", \"$task\", $end - $begin, $after - $before }"
    else
        echo "$task: failed"
        cat said out
        failed=1
    fi
done
exit $failed
