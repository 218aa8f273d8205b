#!/bin/sh
# Builds the benchmarks in build-bench/, runs them and the peer on the same data, and prints one table.
#
#   sh tests/bench/run.sh             about four minutes
#   sh tests/bench/run.sh --reduced   small data, once: only shows that everything runs
#
# BALLBAR_BUILD   folder of a Release build to use instead
set -eu
cd "$(dirname "$0")/../.."
size_MB=50 readings=1000000 rows=1000000 batches=1000 live_rows=100000 tests=1000 repetitions=5 min_time=0.2
fleets=1000,10000
if [ "${1:-}" = --reduced ]; then
  size_MB=2 readings=20000 rows=20000 batches=20 live_rows=2000 tests=20 repetitions=1 min_time=0.01 fleets=40
fi

sh apps/install-packages.sh build bench
build=${BALLBAR_BUILD:-build-bench}
cmake -S . -B "$build" -DCMAKE_BUILD_TYPE=Release -DBALLBAR_BENCH=ON
cmake --build "$build" -j "$(nproc)"

programs=$build/tests/bench
results=$build/results
mkdir -p "$results"
"$programs/bench_files" "$results" "$size_MB" "$readings" "$rows"
export BALLBAR_BENCH_LOG_MB="$size_MB" BALLBAR_BENCH_READINGS="$readings" BALLBAR_BENCH_ROWS="$rows"
export BALLBAR_BENCH_BATCHES="$batches" BALLBAR_BENCH_TESTS="$tests"
for name in b5r batches calls compensation history import log circle machine_errors session five_probe prediction spindle; do
  "$programs/bench_$name" --benchmark_min_time="$min_time" --benchmark_repetitions="$repetitions" \
    --benchmark_out="$results/$name.json" --benchmark_out_format=json
done
echo
# Debian's own python3: numpy, scipy and sklearn are installed for that one.
/usr/bin/python3 tests/bench/peer.py "$results" "$repetitions" \
  "$results/b5r.json" "$results/log.json" "$results/circle.json" \
  "$results/machine_errors.json" "$results/session.json" \
  "$results/five_probe.json" "$results/spindle.json" "$results/batches.json" "$results/prediction.json"
echo
echo "One row of sensors through a pipe, written and its offset waited for:"
for effects in 1 4; do
  model=tests/bench/compensate_$effects.toml
  for state in "" "--state $results/compensation.json"; do
    echo "ballbar compensate, effects $effects${state:+, with --state}"
    rm -f "$results/compensation.json"
    # shellcheck disable=SC2086
    /usr/bin/python3 tests/bench/row_latency.py "$live_rows" "$build/apps/ballbar" compensate --model "$model" --to z \
      --signals - $state
  done
  echo "python3 with csv and numpy, effects $effects"
  /usr/bin/python3 tests/bench/row_latency.py "$live_rows" /usr/bin/python3 tests/bench/compensate_peer.py "$effects"
done
if [ -d "$build/python/ballbar" ] && /usr/bin/python3 -c 'import dask, pandas' 2>/dev/null; then
  echo
  echo "The package of Python:"
  PYTHONPATH=$build/python /usr/bin/python3 tests/bench/python_bench.py "$build/apps/ballbar" "$results/fleet" "$((tests * 2 / 5))" \
    "$fleets" "$results/calls.json"
fi
