#!/bin/sh
# Tests of a build as on a machine that is not ours: nothing in the environment but HOME, PATH and LANG, and each BLAS
# that Debian has by turns, but for the one that the program loads by itself: all other runs hold that. A reduced set: what
# a BLAS can change and is compared as a whole.
#
#   sh tests/strangers.sh BUILD [CTEST ARGUMENT...]
set -eu
build=$(realpath "$1")
shift
cd "$(dirname "$0")/.."
status=0
sh tests/blas.sh "$build/apps/ballbar" "$build/blas" >"$build/blas.txt"
[ -s "$build/blas.txt" ] || echo 'No BLAS by turns: the program does not load one, or Debian has none here.'
loaded=$(ldd "$build/apps/ballbar" | sed -n 's/.*libblas\.so\.3 => \([^ ]*\).*/\1/p')
while read -r name folder; do
  [ "$(realpath "$folder/libblas.so.3")" != "$(realpath "$loaded")" ] || continue
  echo "== $name"
  env -i HOME="$HOME" PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 LD_LIBRARY_PATH="$folder" \
    ctest --test-dir "$build" --output-on-failure -j "$(nproc)" \
    -R '^cli\.|^cli_same|^readme|^page_(copied|numbers|same_numbers)$' "$@" </dev/null || status=$?
done <"$build/blas.txt"
exit $status
