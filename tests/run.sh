#!/bin/sh
# Builds ballbar with its tests in build-tests/ and runs them all. Arguments are passed on to ctest:
#
#   sh tests/run.sh -R circle_fit
#
# BALLBAR_EXTERNAL_DATA  folder of measured data that is not part of ballbar; without it those tests skip
# BALLBAR_WERROR=1       warnings are errors
set -eu
cd "$(dirname "$0")/.."

sh apps/install-packages.sh build page images mat blind python fleet hal test
cmake -S . -B build-tests -DCMAKE_BUILD_TYPE=Release -DBALLBAR_TESTS=ON -DBALLBAR_PACKAGES=OFF \
  -DBALLBAR_WERROR="${BALLBAR_WERROR:-0}" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
cmake --build build-tests -j "$(nproc)"
ctest --test-dir build-tests --output-on-failure -j "$(nproc)" "$@"
