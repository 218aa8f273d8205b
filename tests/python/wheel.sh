#!/bin/sh
# wheel.sh BUILD SOURCE: pip makes the package of what is built in BUILD and installs it in an environment of its own,
# without a server of packages; it is imported from there.
set -eu
build=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset PYTHONPATH
/usr/bin/python3 -m venv --system-site-packages "$scratch/env"
BALLBAR_BUILD=$build "$scratch/env/bin/pip" --quiet install --no-index "$source/apps/python"
cd "$scratch"
./env/bin/python -c "import ballbar, sys
assert ballbar.__file__.startswith(sys.prefix), ballbar.__file__
print(ballbar.__version__, ballbar.machine_errors('$source/sample-runs/qc20-style-b5r/00.b5r').errors[0].value, 'um')"
