#!/bin/sh
# Builds the packages twice, in folders of different names, at different times, from sources with other permissions, and
# compares their bytes. Two whole builds: an hour on two cores. What is built stays in SCRATCH, a folder that it makes.
#
#   sh apps/packages/reproducible.sh SCRATCH
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
if [ $# != 1 ] || [ -e "$1" ]; then
  echo "reproducible.sh: expected the name of a folder that is not there yet, found '${1:-}'" >&2
  exit 2
fi
mkdir -p "$1"
scratch=$(realpath "$1")
commit=$(git -C "$source" rev-parse HEAD 2>/dev/null || true)

# built FOLDER UMASK: a copy of the sources as git has them, or as they are, and its packages.
built() {
  umask "$2"
  mkdir -p "$scratch/$1"
  if [ -n "$commit" ]; then
    git -C "$source" archive "$commit" | tar xf - -C "$scratch/$1"
  else
    (cd "$source" && tar cf - --exclude='./build*' .) | tar xf - -C "$scratch/$1"
  fi
  (cd "$scratch/$1" && sh apps/packages/make.sh >make.log 2>&1) || {
    tail -n 30 "$scratch/$1/make.log" >&2
    exit 1
  }
}

built one 022
built another-folder/below 077

differ=0
for one in "$scratch"/one/build-package/debian/*.deb; do
  name=$(basename "$one")
  if cmp "$one" "$scratch/another-folder/below/build-package/debian/$name"; then
    echo "$name: the same bytes, sha256 $(sha256sum "$one" | cut -c 1-16)"
  else
    differ=1
  fi
done
exit "$differ"
