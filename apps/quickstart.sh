#!/bin/sh
# From a fresh Debian 12 to a drift table and a page to look at: packages, build, one sample session.
#
#   sh apps/quickstart.sh
set -eu
cd "$(dirname "$0")/.."

step() { printf '\n== %s\n' "$1"; }

step 'Packages'
sh apps/install-packages.sh build

step 'Build (Release, in build/)'
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release
cmake --build build -j "$(nproc)"

step 'Drift of a sample session'
out=build/quickstart
session=sample-runs/two-arcs-he2015/session.toml
mkdir -p "$out"
build/apps/ballbar drift "$session" --out "$out/drift.csv" --out "$out/drift.json" --out "$out/drift.mat"

step 'A page to look at'
build/apps/ballbar report "$session" --model sample-runs/two-arcs-he2015/model.toml --out "$out/page.html"

step 'Where they are'
for extension in csv json mat; do
  echo "$PWD/$out/drift.$extension"
done
echo "$PWD/$out/page.html    open it in a browser"
