#!/bin/sh
# Files that are made again byte for byte must not hang on a BLAS: `simulate` of every machine file of the sample runs,
# and the data and answers of `simulate --hidden`, under each BLAS that is installed.
#
#   sh same_bytes.sh PROGRAM SOURCE_FOLDER SCRATCH
set -eu
program=$1 source=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
sh "$source/tests/blas.sh" "$program" "$scratch/libraries" >"$scratch/blas"
if [ "$(wc -l <"$scratch/blas")" -lt 2 ]; then
  echo 'fewer than two BLAS libraries that the program can load; on Debian: apt-get install libblas3 libatlas3-base' \
    'libopenblas0-pthread'
  exit 77
fi

made_with() {
  mkdir "$scratch/$1"
  cd "$scratch/$1"
  LD_LIBRARY_PATH=$2
  export LD_LIBRARY_PATH
  ldd "$program" | grep -q "liblapack\.so\.3 => $2/" || { echo "expected the program to load $2" && exit 1; }
  find "$source/sample-runs" -name '*machine*.toml' | sort | while read -r machine; do
    # A template of make.sh has words for numbers.
    "$program" simulate "$machine" --seed 3 --out "$(echo "${machine#"$source"/}" | tr / -)" >/dev/null 2>>../refused || true
  done
  "$program" simulate --hidden --n 4 --seed 3 --out hidden >/dev/null
  [ -s hidden/answers.json ] || { echo 'expected answers' && exit 1; }
}

first=
while read -r name folder; do
  (made_with "$name" "$folder")
  if [ -z "$first" ]; then
    first=$name
    files=$(find "$scratch/$name" -type f | wc -l)
    [ "$files" -gt 30 ] || { echo "expected more than 30 files, found $files" && exit 1; }
  else
    diff -rq "$scratch/$first" "$scratch/$name" || { echo "expected the same bytes by $first and $name" && exit 1; }
    echo "$files files, the same bytes by $first and $name"
  fi
done <"$scratch/blas"
