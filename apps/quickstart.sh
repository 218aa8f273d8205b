#!/bin/sh
# From a fresh Debian 12 to an error that falls: installs the packages, builds, finds the effect that a model of sample data
# does not have, adds it, and draws a page. Where the page cannot be built, the last lines say so, and all else is done.
#
#   sh apps/quickstart.sh [--no-page]      without the page: 110 packages instead of 480
set -eu
cd "$(dirname "$0")/.."
case ${1:-} in
  '') page=page with_page=AUTO ;;
  --no-page) page='' with_page=OFF ;;
  *)
    echo "quickstart.sh: expected nothing or --no-page, found '$1'" >&2
    exit 2
    ;;
esac
if command -v ninja >/dev/null; then export CMAKE_GENERATOR=Ninja; fi # of a new folder

step() { printf '\n== %s\n' "$1"; }

step 'Install the packages'
# shellcheck disable=SC2086  # nothing where there is no page
sh apps/install-packages.sh build $page || sh apps/install-packages.sh build

step 'Build (Release, in build/)'
mkdir -p build
configured=build/configured.log
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DBALLBAR_PAGE=$with_page >$configured || { cat $configured && exit 1; }
cat $configured
no_page=$(sed -n 's/^-- \(Left out: the page of .*\)/\1/p' $configured)
[ -z "$no_page" ] || page=''
cmake --build build -j "$(nproc)"

# The sample data stay as they are: `add` writes into the model's file.
out=build/quickstart
rm -rf "$out"
cp -r sample-runs/hidden-effect/01 "$out"
data=$out/data.csv model=$out/model.toml

shown() {
  printf '\n$ ballbar %s\n' "$*" >&2 # what it prints may go to a file
  build/apps/ballbar "$@"
}
page_of() {
  [ -z "$page" ] || shown report "$data" --model "$model" --out "$1" >"$out/report.txt"
}

step 'Find what the model of a spindle does not explain (a simulated day)'
shown diagnose "$data" --model "$model"
page_of "$out/before.html"

step 'Add it: the error falls'
shown add lagged_expansion:temperature=T_room_degC "$data" --model "$model" >"$out/added.txt"
shown ledger --model "$model"
page_of "$out/after.html"

step 'Results'
echo "$PWD/build/apps/ballbar    the program"
echo "$PWD/$model    the model with the effect"
echo "$PWD/$out/added.txt    the error before and after"
if [ -n "$page" ]; then
  echo "$PWD/$out/before.html    what was missing; open it in a browser"
  echo "$PWD/$out/after.html    the model with it, and the ledger"
fi
echo "$PWD/sample-runs/hidden-effect/README.md    the same, step by step"
if [ -n "$no_page" ]; then
  printf '\n%s\nEverything else works. Where Node.js, npm and its registry can be used, this adds the page:\n' "$no_page"
  echo '  sh apps/quickstart.sh'
fi
