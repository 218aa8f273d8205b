#!/bin/sh
# Makes the files of this folder again, byte for byte:
#
#   sh sample-runs/machine-history/make.sh build/apps/ballbar
#
# Scales of X, Y, Z: 40, 0 and 20 um/m; over 100 mm half the sum of both axes is the radius error, half the difference
# the half oval. Play of X: 0.9 um, 0.7 um more a quarter.
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# PLANE DATE SEED RADIUS_ERROR HALF_OVAL BACKLASH
while read -r plane date seed radius_error half_oval backlash; do
  sed -e "s/SEED/$seed/; s/STARTED/${date}/; s/PLANE/$plane/; s/RADIUS_ERROR/$radius_error/" \
    -e "s/HALF_OVAL/$half_oval/; s/BACKLASH/$backlash/" machine.toml > "$scratch/machine.toml"
  "$program" simulate "$scratch/machine.toml" --b5r --force --out "$scratch/out" >/dev/null 2>&1
  mkdir -p "${date%T*}"
  cp "$scratch/out/00.b5r" "${date%T*}/$plane.b5r"
done <<'TESTS'
XY 2025-01-20T08:05:00 11 2.0 2.0 0.9
YZ 2025-01-20T08:40:00 12 1.0 -1.0 0.3
ZX 2025-01-20T09:15:00 13 3.0 -1.0 0.5
XY 2025-04-22T08:10:00 21 2.0 2.0 1.6
XY 2025-07-21T07:55:00 31 2.0 2.0 2.3
YZ 2025-07-21T08:30:00 32 1.0 -1.0 0.3
XY 2025-10-20T08:00:00 41 2.0 2.0 3.0
XY 2026-01-19T08:05:00 51 2.0 2.0 3.7
YZ 2026-01-19T08:40:00 52 1.0 -1.0 0.3
ZX 2026-01-19T09:15:00 53 3.0 -1.0 0.5
TESTS
