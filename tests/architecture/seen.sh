#!/bin/sh
# An include put in against the order is found, with its place, and so is one of the laboratory outside of simulate.
#
#   sh seen.sh SOURCE_FOLDER SCRATCH
set -eu
source=$1 scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch/apps/measure" "$scratch/apps/python"
cp -r "$source/libballbar" "$source/formats" "$scratch"
cp -r "$source/apps/page" "$source/apps/CMakeLists.txt" "$scratch/apps"
file=libballbar/src/numerics/parallel.cpp
echo '#include "ballbar/fit/fit.hpp"' >>"$scratch/$file"
formats=formats/src/series/series_csv.cpp
echo '#include "ballbar/lab/simulation/simulate.hpp"' >>"$scratch/$formats"
echo '#include "ballbar/lab/simulation/simulate.hpp"' >"$scratch/apps/measure/drift.cpp"
echo '#include "simulate/simulated_files.hpp"' >"$scratch/apps/python/fleets.cpp"
echo 'import { } from "./main";' >>"$scratch/apps/page/src/report.ts"
! python3 "$source/tests/architecture/one_way.py" "$scratch" >"$scratch/said"
grep "^$file:[0-9]*: libballbar/numerics may not include ballbar/fit/fit.hpp" "$scratch/said"
grep "^$formats:[0-9]*: formats/series may not include ballbar/lab/simulation/simulate.hpp: it is for" "$scratch/said"
grep '^apps/measure/drift.cpp:1: apps/measure may not include ballbar/lab/simulation/simulate.hpp: it is for' "$scratch/said"
grep '^apps/python/fleets.cpp:1: apps/python may not include simulate/simulated_files.hpp: it is for' "$scratch/said"
grep 'expected no circle of imports, found .*report.ts' "$scratch/said"
