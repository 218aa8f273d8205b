#!/usr/bin/python3
"""The offset that a machine takes from ballbar-hal. LinuxCNC starts this as its display; by then
ballbar.hal of apps/hal has connected the component.

The model and the steps are those of component.py: at 21 degC wanted is -2 um, two rows from zero. LinuxCNC's own
planner of offsets stops up to 1e-7 mm short; 1e-6 mm are asked for, a hundredth of a count.
"""
import os
import time

import linuxcnc
from hal_pins import expect, finish, halcmd, kill, load, pin, row, wait_for

WITHIN_mm = 1e-6
UNIT_mm = 25.4 if "inch" in os.environ["BALLBAR_HAL_OPTIONS"] else 1.0


def expect_mm(what, name, wanted_mm, find=lambda name, wanted, within: pin(name)):
    """Of a pin in the machine's unit; find: pin() or wait_for()."""
    expect(what + ", mm", find(name, wanted_mm / UNIT_mm, WITHIN_mm / UNIT_mm) * UNIT_mm, wanted_mm, WITHIN_mm)


def check(what, eoffset_mm, reason):
    expect_mm(what + ": axis.z.eoffset", "axis.z.eoffset", eoffset_mm, wait_for)
    expect(what + ": hold-reason", pin("ballbar.hold-reason"), reason)


def turn(state):
    command.state(state)
    command.wait_complete()
    wait_for("motion.motion-enabled", state == linuxcnc.STATE_ON)
    wait_for("ballbar.enable", pin("motion.motion-enabled") and pin("motion.is-all-homed"))


command = linuxcnc.command()
row("ballbar", 0, 20.0)
row("ballbar", 10, 21.0)
check("machine off", 0.0, 9)
command.state(linuxcnc.STATE_ESTOP_RESET)
command.wait_complete()
turn(linuxcnc.STATE_ON)
row("ballbar", 20, 21.0)
check("on, not homed", 0.0, 9)
command.mode(linuxcnc.MODE_MANUAL)
command.wait_complete()
command.home(-1)
wait_for("ballbar.enable", True)
row("ballbar", 25, 21.0)
check("homed, a row to be sure", 0.0, 9)
row("ballbar", 30, 21.0)
check("homed", -0.001, 0)
row("ballbar", 40, 21.0)
check("homed", -0.002, 0)
command.mode(linuxcnc.MODE_MDI)
command.wait_complete()
command.mdi("G0 Z0.1")  # of the machine's unit; not far, for halcmd gives 7 digits
command.wait_complete()
expect_mm("motor at Z0.1", "joint.2.motor-pos-cmd", 0.1 * UNIT_mm - 0.002, wait_for)

# Off and on: the control's offset begins at zero, and counts that had followed the model would leave it there.
turn(linuxcnc.STATE_OFF)
row("ballbar", 50, 21.0)
check("off again", -0.002, 9)
turn(linuxcnc.STATE_ON)
check("on again", 0.0, 9)
row("ballbar", 60, 21.0)
check("on again, a row to be sure", 0.0, 9)
row("ballbar", 70, 21.0)
check("on again", -0.001, 0)
row("ballbar", 80, 21.0)
check("on again", -0.002, 0)
row("ballbar", 90, 21.0)
check("on again", -0.002, 0)

kill("ballbar")
time.sleep(0.1)
expect_mm("after kill -9", "axis.z.eoffset", -0.002)
PINS = ["z.enable", "z.scale", "z.counts", "z.applied", "enable"]
SIGNALS = ["z-enable", "z-scale", "z-counts", "z-applied", "enabled"]
for name in PINS:
    halcmd("unlinkp", f"ballbar.{name}")
load("ballbar-2")
for name, signal in zip(PINS, SIGNALS):
    halcmd("net", f"ballbar-{signal}", f"ballbar-2.{name}")
expect_mm("after a new start", "axis.z.eoffset-request", -0.002)
row("ballbar-2", 95, 21.0)
expect("after a new start, hold-reason", pin("ballbar-2.hold-reason"), 9)
row("ballbar-2", 100, 21.0)
time.sleep(0.1)
expect_mm("after a new start and two rows", "axis.z.eoffset", -0.002)
expect("after a new start, hold-reason", pin("ballbar-2.hold-reason"), 0)
row("ballbar-2", 110, 20.5)
expect_mm("after a new start and a row", "axis.z.eoffset", -0.001, wait_for)
halcmd("unload", "ballbar-2")
time.sleep(0.1)
expect_mm("after unload", "axis.z.eoffset", -0.001)
finish()
