#!/bin/sh
# Builds the fuzz targets with clang and runs each for SECONDS (default 60); stops after a fault.
set -eu
seconds=${1:-60}
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build-fuzz
targets="archive b5r ballbar_log circle_table log series session machine model runs batch_model effect_regression picture
  live_rows compensation_state"

cmake -S "$root" -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DBALLBAR_FUZZ=ON -DBALLBAR_SANITIZE=address,undefined > /dev/null
for target in $targets; do
  cmake --build "$build" --target "fuzz_$target" -j2
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# As many at once as there are processors, each with its output in one piece.
fuzz() {
  corpus=$work/$1
  mkdir "$corpus"
  cp "$here/seeds/$1"/* "$corpus"
  "$build/tests/fuzz/fuzz_$1" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$build/fuzz_$1-" "$corpus" >"$work/$1.log" 2>&1
}
set -- $targets
while [ $# -gt 0 ]; do
  running=
  for _ in $(seq "$(nproc)"); do
    [ $# -gt 0 ] || break
    fuzz "$1" &
    running="$running $1=$!"
    shift
  done
  fault=0
  for one in $running; do
    wait "${one#*=}" || fault=$?
    echo "== fuzz_${one%=*}"
    cat "$work/${one%=*}.log"
  done
  [ "$fault" = 0 ] || exit "$fault"
done
