# shellcheck shell=sh disable=SC2154 # work is the folder of who sources it
# Sourced by the tests here: an installed program, seen from a folder that is not the sources'.
#   check_program PREFIX
unset GEARPOD_REPORT_DIR
fail() {
    echo "FAILED: $*" >&2
    exit 1
}

# A small study of the installation and its page. The page must come from the installed scripts: one
# word in them is changed, and without them there is no page.
check_program() {
    prefix=$1
    mkdir "$work/elsewhere"
    cd "$work/elsewhere" || fail "no folder"
    "$prefix/bin/gearpod" run "$prefix/share/gearpod/studies/planet-crack-ideal.toml" --quiet \
        --instances 32 --set ensemble.threshold_instances=32 --out r.h5 || fail "run"
    "$prefix/bin/gearpod" report r.h5 | grep -q 'alarm if' || fail "report"
    grep -q '^.SS gearpod compare' "$prefix/share/man/man1/gearpod.1" || fail "no man page"
    bash -n "$prefix/share/bash-completion/completions/gearpod" || fail "no completion"
    [ -f "$prefix/share/doc/gearpod/CITATION.cff" ] || fail "no CITATION.cff"
    [ -x "$prefix/share/gearpod/studies/slurm.sh" ] || fail "no slurm.sh"
    [ -x "$prefix/share/gearpod/studies/slurm-array.sh" ] || fail "no slurm-array.sh"

    for documents in "$prefix/share/doc/gearpod" "$prefix/share/gearpod/studies"; do
        /usr/bin/python3 -Bs "$here/../docs/check_links.py" "$documents" >links || fail "$(cat links)"
    done

    if /usr/bin/python3 -c "import h5py" 2>/dev/null; then
        PYTHONPATH=$prefix/lib/python3/dist-packages /usr/bin/python3 -Bc \
            'import gearpod, sys; assert len(gearpod.open("r.h5")) == 64
assert gearpod.find_program() == sys.argv[1], gearpod.find_program()' \
            "$prefix/bin/gearpod" || fail "the Python package"
    fi

    page=$prefix/share/gearpod/report
    /usr/bin/python3 -c "import matplotlib" 2>/dev/null || return 0
    sed -i 's/<html/<html data-installed="here"/' "$page"/*.py
    "$prefix/bin/gearpod" report r.h5 --html r.html >/dev/null || fail "report --html"
    grep -q 'data-installed="here"' r.html || fail "the page comes from elsewhere"
    rm -r "$page"
    if "$prefix/bin/gearpod" report r.h5 --html none.html 2>message; then
        fail "a page without the installed scripts"
    fi
    grep -qF "$page/build_page.py does not exist" message || fail "$(cat message)"
}
