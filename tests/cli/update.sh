#!/bin/sh
# Writes down what the program prints now as what tests/cli and the READMEs expect. Read the difference
# (git diff) before keeping it.
#
#   sh tests/cli/update.sh build-tests/apps/ballbar [NAME...]      no name: all cases and the READMEs
set -eu
program=$(realpath "$1")
shift
cd "$(dirname "$0")/../.."
source=$PWD
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
readme=no
if [ $# = 0 ]; then
  readme=yes
  # shellcheck disable=SC2046  # names of cases have no spaces
  set -- $(ls tests/cli/cases)
fi
for name in "$@"; do
  sh tests/cli/case.sh "$program" "$source" "$name" "$scratch" --update
done
if [ $readme = yes ]; then
  while read -r page; do
    python3 tests/cli/readme.py "$program" "$source" "$scratch/readme" "$page" --update
  done < tests/cli/readme-pages.txt
  "$(dirname "$program")/../tests/formats/format_keys" formats/README.md --update
  "$(dirname "$program")/../tests/apps/result_keys" . --update
fi
