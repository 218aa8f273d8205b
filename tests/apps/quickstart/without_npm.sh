#!/bin/sh
# The quickstart where npm cannot reach its registry, and where there is no npm: its main job is done, its status is 0, and
# its last lines say what is missing and what adds it. The program is not compiled again: it is put where the build would.
#
#   sh without_npm.sh PROGRAM SOURCE_FOLDER SCRATCH
set -eu
program=$1 source=$2 scratch=$3
cmake=$(command -v cmake)
rm -rf "$scratch"
mkdir -p "$scratch/bin" "$scratch/ballbar"
for part in CMakeLists.txt apps formats libballbar sample-runs; do ln -s "$source/$part" "$scratch/ballbar/$part"; done

stand_in() {
  printf '#!/bin/sh\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}
# Where a package is missing, it cannot be had.
stand_in apt-get 'echo "apt-get: no server can be reached" >&2; exit 100'
stand_in cmake "if [ \"\$1\" = --build ]; then mkdir -p build/apps && ln -sf '$program' build/apps/ballbar; else '$cmake' \"\$@\" \$FOUND; fi"

# quickstart NAME: its output in NAME.txt, with all that it must do done.
quickstart() {
  status=0
  PATH=$scratch/bin:$PATH sh "$scratch/ballbar/apps/quickstart.sh" >"$scratch/$1.txt" 2>&1 </dev/null || status=$?
  if [ $status != 0 ] || ! grep -q '^1 + lagged_expansion(T_room_degC) .* supported$' "$scratch/$1.txt" ||
    [ "$(tail -n 1 "$scratch/$1.txt")" != '  sh apps/quickstart.sh' ] || ! tail -n 3 "$scratch/$1.txt" | grep -q "$2"; then
    cat "$scratch/$1.txt"
    echo "$1: expected status 0, the effect found and added, and last lines that name what is missing ($2); found status $status"
    exit 1
  fi
  if ls "$scratch/ballbar/build/quickstart" | grep -q html; then echo "$1: expected no page" && exit 1; fi
}

stand_in npm 'echo "npm ERR! network request to the registry failed, reason: self signed certificate in certificate chain" >&2; exit 1'
FOUND="-DBALLBAR_NODE=/bin/true -DBALLBAR_NPM=$scratch/bin/npm" quickstart no-registry 'Left out: the page .* npm could not fetch'
grep -q 'self signed certificate' "$scratch/ballbar/build/apps/page/npm.log"
if "$cmake" -S "$scratch/ballbar" -B "$scratch/ballbar/build" -DBALLBAR_PAGE=ON >"$scratch/asked.txt" 2>&1; then
  echo 'BALLBAR_PAGE=ON without the registry: expected an error, found none' && exit 1
fi
grep -q 'npm could not fetch its' "$scratch/asked.txt"

FOUND='-DBALLBAR_NODE=OFF -DBALLBAR_NPM=OFF' quickstart no-npm 'Left out: the page .* apt-get install nodejs npm'
