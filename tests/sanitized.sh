#!/bin/sh
# Builds the tests and the fuzz targets by clang under the address and undefined-behaviour sanitizers, in build-fuzz/.
# Without the page, as ballbar is built where there is no npm.
#
#   sh tests/sanitized.sh [TARGET...]    all targets unless some are named
set -eu
cd "$(dirname "$0")/.."
cmake -S . -B build-fuzz -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -DBALLBAR_TESTS=ON -DBALLBAR_FUZZ=ON -DBALLBAR_PAGE=OFF -DBALLBAR_PYTHON=OFF \
  -DBALLBAR_SANITIZE=address,undefined >/dev/null
cmake --build build-fuzz -j "$(nproc)" ${1:+--target "$@"}
