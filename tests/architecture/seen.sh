#!/bin/sh
# An include put in against the order is found, with its place.
#
#   sh seen.sh SOURCE_FOLDER SCRATCH
set -eu
source=$1 scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch/apps"
cp -r "$source/libballbar" "$source/formats" "$scratch"
cp -r "$source/apps/page" "$source/apps/CMakeLists.txt" "$scratch/apps"
file=libballbar/src/numerics/parallel.cpp
echo '#include "ballbar/fit/fit.hpp"' >>"$scratch/$file"
echo 'import { } from "./main";' >>"$scratch/apps/page/src/report.ts"
! python3 "$source/tests/architecture/one_way.py" "$scratch" >"$scratch/said"
grep "^$file:[0-9]*: libballbar/numerics may not include ballbar/fit/fit.hpp" "$scratch/said"
grep 'expected no circle of imports, found .*report.ts' "$scratch/said"
