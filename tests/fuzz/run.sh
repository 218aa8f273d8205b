#!/bin/sh
# Builds the fuzz targets with clang and runs each for SECONDS (default 60); stops at the first fault.
set -eu
seconds=${1:-60}
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
build=$root/build-fuzz
targets="b5r ballbar_log series session machine model"

cmake -S "$root" -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DBALLBAR_FUZZ=ON -DBALLBAR_SANITIZE=address,undefined > /dev/null
for target in $targets; do
  cmake --build "$build" --target "fuzz_$target" -j2
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for target in $targets; do
  corpus=$work/$target
  mkdir "$corpus"
  cp "$here/seeds/$target"/* "$corpus"
  echo "== fuzz_$target"
  "$build/tests/fuzz/fuzz_$target" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=10 -print_final_stats=1 \
    -artifact_prefix="$build/fuzz_$target-" "$corpus"
done
