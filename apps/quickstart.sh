#!/bin/sh
# From a fresh Debian 12 to a drift table and a page to look at: packages, build, one sample session.
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

step() { printf '\n== %s\n' "$1"; }

step 'Packages'
# shellcheck disable=SC2086  # nothing where there is no page
sh apps/install-packages.sh build $page

step 'Build (Release, in build/)'
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release -DBALLBAR_PAGE=$with_page
cmake --build build -j "$(nproc)"

step 'Drift of a sample session'
out=build/quickstart
session=sample-runs/two-arcs-he2015/session.toml
mkdir -p "$out"
build/apps/ballbar drift "$session" --out "$out/drift.csv" --out "$out/drift.json"

if [ -n "$page" ]; then
  step 'A page to look at'
  build/apps/ballbar report "$session" --model sample-runs/two-arcs-he2015/model.toml --out "$out/page.html"
fi

step 'Where they are'
for extension in csv json; do
  echo "$PWD/$out/drift.$extension"
done
[ -z "$page" ] || echo "$PWD/$out/page.html    open it in a browser"
