#!/bin/sh
# Installs a built ballbar into a prefix of its own, without the internal headers, then configures, builds and runs the
# consumer against it.
#
#   sh run.sh BUILD_FOLDER SCRATCH [CXX_FLAGS]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$1 scratch=$2 flags=${3:-}
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix"
# What is internal is for the formats and the program alone: a consumer builds without it.
rm -r "$scratch/prefix/include/ballbar/internal"
cmake -S "$here" -B "$scratch/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  -DCMAKE_CXX_FLAGS="$flags"
cmake --build "$scratch/build"
"$scratch/build/consumer"
[ ! -e "$scratch/build/images" ] || "$scratch/build/images"
"$scratch/prefix/bin/ballbar" --version
