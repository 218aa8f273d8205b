#!/bin/sh
# Builds the packages twice, in folders of different names, at different times, under another umask and language, and
# compares their bytes. Two whole builds: half an hour on two cores.
#
#   sh apps/packages/reproducible.sh [SCRATCH]
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
scratch=${1:-$(mktemp -d)}
SOURCE_DATE_EPOCH=$(sh "$source/apps/packages/epoch.sh")
export SOURCE_DATE_EPOCH

# built FOLDER UMASK LANGUAGE ZONE: a copy of the sources as git has them, or as they are, and its packages.
built() {
  mkdir -p "$scratch/$1"
  if git -C "$source" rev-parse >/dev/null 2>&1; then
    git -C "$source" archive HEAD | tar xf - -C "$scratch/$1"
  else
    (cd "$source" && tar cf - --exclude='./build*' .) | tar xf - -C "$scratch/$1"
  fi
  (umask "$2" && cd "$scratch/$1" && LC_ALL=$3 TZ=$4 sh apps/packages/make.sh >make.log 2>&1) || {
    tail -n 30 "$scratch/$1/make.log" >&2
    exit 1
  }
}

built one 022 C UTC
built another-folder/below 077 C.UTF-8 Asia/Tokyo

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
