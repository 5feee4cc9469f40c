#!/bin/sh
# Builds the fuzz targets, makes what they begin with, and runs each for some seconds, as many at once as there are
# processors. Prints for each the inputs tried and the edges reached; fails where one found something, and says where the
# input is. Usage: run.sh SOURCE_FOLDER [SECONDS_EACH [TARGET...]]
set -eu
cd "$1"
seconds=${2:-10}
shift
[ $# -eq 0 ] || shift
if ! command -v clang >/dev/null 2>&1; then
    echo "skipped: clang is not installed"
    exit 0
fi
build=build-fuzz
mkdir -p $build
{ cmake --preset fuzz && cmake --build --preset fuzz; } >$build/build.log 2>&1 || { cat $build/build.log; exit 1; }
mkdir -p $build/corpus/streams $build/failures $build/logs
$build/tests/fuzz/streams $build/corpus/streams
python3 tests/fuzz/seeds.py . $build/corpus

# One target.
cat >$build/one.sh <<'END'
target=$1
seconds=$2
mkdir -p build-fuzz/corpus/$target
build-fuzz/tests/fuzz/$target -max_total_time=$seconds -print_final_stats=1 -rss_limit_mb=2048 -timeout=20 \
    -malloc_limit_mb=1500 -artifact_prefix=build-fuzz/failures/$target- build-fuzz/corpus/$target >build-fuzz/logs/$target.log 2>&1 && failed= || failed=FAILED
awk -v name="$target" -v failed="$failed" '/cov:/ { for (i = 1; i < NF; i++) if ($i == "cov:") cov = $(i + 1) }
    /number_of_executed_units/ { runs = $2 } END { printf "%-20s %10d inputs %6d edges %s\n", name, runs, cov, failed }' \
    build-fuzz/logs/$target.log
[ -z "$failed" ] || { grep -E "ERROR|SUMMARY|runtime error|fuzz:|Test unit written" build-fuzz/logs/$target.log; exit 1; }
END
[ $# -gt 0 ] || set -- $(cd $build/tests/fuzz && ls -1 | grep -E '^fuzz_[a-z_]+$')
printf '%s\n' "$@" | xargs -P "$(nproc)" -I TARGET sh $build/one.sh TARGET "$seconds"
