#!/bin/sh
# Writes down what the program prints now as what the transcripts of tests/cli and the READMEs expect. Read the difference
# (git diff) before keeping it.
#
#   sh tests/cli/update.sh build-tests/apps/ballbar
#
# One transcript or one section: python3 tests/cli/transcript.py build-tests/apps/ballbar fit.txt truncated --update
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/../.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
python3 tests/cli/transcript.py "$program" --update
while read -r page; do
  python3 tests/cli/readme.py "$program" . "$scratch/readme" "$page" --update
done < tests/cli/readme-pages.txt
"$(dirname "$program")/../tests/formats/format_keys" formats/README.md --update
"$(dirname "$program")/result_types" readmes . --update
