#!/bin/sh
# Builds ballbar with its tests in build-tests/ and runs those that a change must pass: minutes. Arguments are passed on
# to ctest, which then chooses among all that are built:
#
#   sh tests/run.sh -R circle_fit
#   sh tests/run.sh --smoke         one minute of tests, of each kind those that are quick
#   sh tests/run.sh --all           then all others too: studies, ballbar.html, sanitizers, packages ... hours
#
# Ends as ctest does; the last lines say what was skipped or left out, and why.
#
# BALLBAR_EXTERNAL_DATA  folder of measured data that is not part of ballbar; without it those tests skip
# BALLBAR_WERROR=1       warnings are errors
set -eu
cd "$(dirname "$0")/.."
# not_quick: those of seconds.
all='' left_out='study|long|tool' not_quick='^$'
case ${1:-} in
  --all) all=1 && shift ;;
  --smoke)
    left_out="$left_out|slow|page|python|external|hal"
    not_quick='^cli[.](add|any-log)$|^cli_same_bytes|^consumer|^quickstart|_accuracy|^sensor_choice|^sklearn'
    shift
    ;;
esac

# Where a component's packages cannot be had, its tests are left out.
sh apps/install-packages.sh build page images mat pdf python fleet hal test || sh apps/install-packages.sh build test
if command -v ninja >/dev/null; then export CMAKE_GENERATOR=Ninja; fi # of a new folder
mkdir -p build-tests
configured=build-tests/configured.log results=$PWD/build-tests/results.xml
cmake -S . -B build-tests -DCMAKE_BUILD_TYPE=Release -DBALLBAR_TESTS=ON -DBALLBAR_PACKAGES=OFF -DBALLBAR_STUDIES=OFF \
  -DBALLBAR_WERROR="${BALLBAR_WERROR:-0}" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >$configured ||
  { cat $configured && exit 1; }
cat $configured
cmake --build build-tests -j "$(nproc)"
rm -f "$results"
status=0
chosen=$#
[ $# -gt 0 ] || set -- -LE "$left_out" -E "$not_quick"
ctest --test-dir build-tests --output-on-failure -j "$(nproc)" --output-junit "$results" \
  --test-output-size-passed 1000000 "$@" || status=$?
[ ! -f "$results" ] || { echo && python3 tests/skipped.py "$results" $configured; }
if [ -n "$all" ] && [ $status = 0 ]; then exec bash tests/all.sh; fi
[ -n "$all" ] || [ "$chosen" -gt 0 ] || echo "Not run: tests labelled $left_out, sanitizers, packages: sh tests/run.sh --all"
exit $status
