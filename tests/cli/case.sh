#!/bin/sh
# One whole-output case: a folder cases/NAME with
#
#   command   shell lines; `ballbar` is the program built, sample-runs/ is there, files written are scratch,
#             $tools is this folder
#   stdout, stderr, status   what comes of it, to the letter
#
#   sh case.sh PROGRAM SOURCE_FOLDER NAME SCRATCH [--update]
#
# --update writes down what came instead of comparing (update.sh does so for all cases).
set -eu
program=$1 source=$2 name=$3 scratch=$4/$3 update=${5:-}
tools=$source/tests/cli
expected=$tools/cases/$name

rm -rf "$scratch"
mkdir -p "$scratch/work" "$scratch/came"
ln -s "$source/sample-runs" "$scratch/work/sample-runs"

PATH=$(dirname "$program"):$PATH
LC_ALL=C
export PATH LC_ALL tools
status=0
(cd "$scratch/work" && exec sh -e "$expected/command") \
  </dev/null >"$scratch/came/stdout" 2>"$scratch/came/stderr" || status=$?
echo "$status" >"$scratch/came/status"

if [ "$update" = --update ]; then
  cp "$scratch/came/stdout" "$scratch/came/stderr" "$scratch/came/status" "$expected/"
  exit 0
fi
differs=0
for what in stdout stderr status; do
  diff -u "$expected/$what" "$scratch/came/$what" || differs=1
done
exit $differs
