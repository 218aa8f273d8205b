#!/usr/bin/python3
"""The offset that a machine takes from ballbar-hal. LinuxCNC starts this as its display; by then
ballbar.hal of apps/hal has connected the component.

The model and the steps are those of component.py: at 21 degC wanted is -2 um, two rows from zero. LinuxCNC's own
planner of offsets stops up to 1e-7 mm short; 1e-6 mm are asked for, a hundredth of a count.
"""
import time

import linuxcnc
from hal_pins import expect, finish, halcmd, kill, load, pin, row, wait_for

WITHIN_mm = 1e-6


def check(what, eoffset_mm, reason):
    expect(what + ": axis.z.eoffset mm", wait_for("axis.z.eoffset", eoffset_mm, WITHIN_mm), eoffset_mm, WITHIN_mm)
    expect(what + ": hold-reason", pin("ballbar.hold-reason"), reason)


def turn(state):
    command.state(state)
    command.wait_complete()
    wait_for("motion.motion-enabled", state == linuxcnc.STATE_ON)
    wait_for("ballbar.enable", pin("motion.motion-enabled") and pin("motion.is-all-homed"))


command = linuxcnc.command()
row("ballbar", 0, 20.0)
row("ballbar", 10, 21.0)
check("machine off", 0.0, 8)
command.state(linuxcnc.STATE_ESTOP_RESET)
command.wait_complete()
turn(linuxcnc.STATE_ON)
row("ballbar", 20, 21.0)
check("on, not homed", 0.0, 8)
command.mode(linuxcnc.MODE_MANUAL)
command.wait_complete()
command.home(-1)
wait_for("ballbar.enable", True)
row("ballbar", 25, 21.0)
check("homed, a row to be sure", 0.0, 8)
row("ballbar", 30, 21.0)
check("homed", -0.001, 0)
row("ballbar", 40, 21.0)
check("homed", -0.002, 0)
command.mode(linuxcnc.MODE_MDI)
command.wait_complete()
command.mdi("G0 Z10")
command.wait_complete()
expect("motor at Z10, mm", wait_for("joint.2.motor-pos-cmd", 9.998, WITHIN_mm), 9.998, WITHIN_mm)

# Off and on: the control's offset begins at zero, and counts that had followed the model would leave it there.
turn(linuxcnc.STATE_OFF)
row("ballbar", 50, 21.0)
check("off again", -0.002, 8)
turn(linuxcnc.STATE_ON)
check("on again", 0.0, 8)
row("ballbar", 60, 21.0)
check("on again, a row to be sure", 0.0, 8)
row("ballbar", 70, 21.0)
check("on again", -0.001, 0)
row("ballbar", 80, 21.0)
check("on again", -0.002, 0)
row("ballbar", 90, 21.0)
check("on again", -0.002, 0)

kill("ballbar")
time.sleep(0.1)
expect("after kill -9, mm", pin("axis.z.eoffset"), -0.002, WITHIN_mm)
PINS = ["z.enable", "z.scale", "z.counts", "z.applied", "enable"]
SIGNALS = ["z-enable", "z-scale", "z-counts", "z-applied", "enabled"]
for name in PINS:
    halcmd("unlinkp", f"ballbar.{name}")
load("ballbar-2")
for name, signal in zip(PINS, SIGNALS):
    halcmd("net", f"ballbar-{signal}", f"ballbar-2.{name}")
expect("after a new start, mm", pin("axis.z.eoffset-request"), -0.002, WITHIN_mm)
row("ballbar-2", 95, 21.0)
expect("after a new start, hold-reason", pin("ballbar-2.hold-reason"), 8)
row("ballbar-2", 100, 21.0)
time.sleep(0.1)
expect("after a new start and two rows, mm", pin("axis.z.eoffset"), -0.002, WITHIN_mm)
expect("after a new start, hold-reason", pin("ballbar-2.hold-reason"), 0)
row("ballbar-2", 110, 20.5)
expect("after a new start and a row, mm", wait_for("axis.z.eoffset", -0.001, WITHIN_mm), -0.001, WITHIN_mm)
halcmd("unload", "ballbar-2")
time.sleep(0.1)
expect("after unload, mm", pin("axis.z.eoffset"), -0.001, WITHIN_mm)
finish()
