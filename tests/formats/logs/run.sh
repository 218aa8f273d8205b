#!/bin/sh
# Makes the files and judges how the program reads them.
#
#   run.sh PYTHON PROGRAM FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$3"
export PYTHONDONTWRITEBYTECODE=1
"$1" "$here/generator/make.py" "$3"
"$1" "$here/check.py" "$2" "$3"
