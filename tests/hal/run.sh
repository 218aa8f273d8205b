#!/bin/sh
# Runs a test of the component in a HAL of its own, which ends with it: no other HAL on this computer is seen or
# touched, and nothing is left behind, however the test ends.
#
#   BALLBAR_HAL=... BALLBAR_PROGRAM=... sh run.sh SCRATCH component|machine|inch|written   ballbar-hal and ballbar, full names
#
# component  under halrun, with the motion controller alone
# machine    a whole LinuxCNC of three simulated axes
# inch       the same in inches
# written    the same machine with what `ballbar compensate --write linuxcnc` writes, and without ballbar-hal
#
# Exit 77, which ctest takes for "skipped", where there are no user namespaces: some containers forbid them.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$1 test=$2
alone='unshare --user --map-user=1000 --ipc --pid --net --fork --mount-proc --kill-child'
if ! $alone true 2>/dev/null; then
  echo "skipped: there are no user namespaces here (unshare --user)"
  exit 77
fi

rm -rf "$folder"
mkdir -p "$folder"
cp "$here"/*.py "$here"/*.hal "$here"/*.ini "$here"/*.toml "$folder"
# Rows are given one by one, and nothing of one is lost when the component is killed after it.
export BALLBAR_HAL_OPTIONS='--step-um 1 --clock-pin --period-s 0.005 --save-s 0'
if [ "$test" = inch ]; then
  BALLBAR_HAL_OPTIONS="$BALLBAR_HAL_OPTIONS --machine-unit inch"
  sed -i 's/^LINEAR_UNITS = mm$/LINEAR_UNITS = inch/' "$folder/machine.ini"
fi
sed "s|ballbar-hal --model|$BALLBAR_HAL $BALLBAR_HAL_OPTIONS --model|" \
  "$here/../../apps/hal/ballbar.hal" >"$folder/ballbar.hal"
cd "$folder"
touch machine.tbl
if [ "$test" = written ]; then
  sed -i 's|^DISPLAY = ./machine.py$|DISPLAY = ./written.py|; s|^HALFILE = ballbar.hal$|HALFILE = z.hal|' machine.ini
  { echo time_s,T_xi_degC,z_um; for T in 20 22 24 26 28 30; do echo "$((T * 60)),$T,$((2 * T - 40))"; done; } >line.csv
  "$BALLBAR_PROGRAM" compensate --model live.toml --to z --on line.csv --write linuxcnc --rate-um-per-s 100 --out z.hal
fi
case $test in
  component) command='halrun component.hal' ;;
  machine | inch | written) command='linuxcnc -r machine.ini' ;;
esac

# The name of LinuxCNC's socket has at most 107 characters. It refuses to run as root, which the user 1000 is not.
home=$(mktemp -d)
unset DISPLAY
HOME=$home RTAPI_FIFO_PATH=$home/fifo timeout --kill-after=5 60 $alone $command || echo "$command: status $?"
rm -rf "$home"
[ "$(cat result)" = passed ]  # LinuxCNC's own status is not that of the test
