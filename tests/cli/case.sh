#!/bin/sh
# One whole-output case: a folder cases/NAME with
#
#   command   shell lines; `ballbar` is the program built, sample-runs/ is there, files written are scratch,
#             $tools is this folder
#   stdout, stderr, status   what comes of it, to the letter but for the last digits of numbers: same.py
#   tolerance                where numbers may differ by more than same.py has it: by how much, and why
#
#   sh case.sh PROGRAM SOURCE_FOLDER NAME SCRATCH [--update]
#
# A command that ends with 77 cannot run here: its last line on stderr says why, and the case is skipped.
# --update writes down what came where it is not the same (update.sh does so for all cases).
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
if [ "$status" = 77 ]; then
  tail -n 1 "$scratch/came/stderr"
  exit 77
fi

# Python is started only where the bytes differ.
is_same() {
  cmp -s "$expected/$1" "$scratch/came/$1" && return
  set -- "$expected/$1" "$scratch/came/$1"
  [ ! -f "$expected/tolerance" ] || set -- "$@" --stated "$expected/tolerance"
  PYTHONUTF8=1 PYTHONDONTWRITEBYTECODE=1 python3 "$tools/same.py" "$@"
}
differs=0
for what in stdout stderr status; do
  if [ "$update" = --update ]; then
    [ -f "$expected/$what" ] && is_same "$what" >/dev/null || cp "$scratch/came/$what" "$expected/"
  else
    is_same "$what" || { echo "$name: $what differs from what is expected" && differs=1; }
  fi
done
exit $differs
