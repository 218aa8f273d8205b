#!/usr/bin/python3
"""The offset that a machine takes from what `ballbar compensate --write linuxcnc` writes. LinuxCNC starts this as its
display; by then z.hal has connected its own components.

The line: 2 um/K from 20 degC, from 19 to 31 degC, of the data in run.sh. A count is 0.1 um; what is left of one is cut
off. An offset is minus the error: at 21 degC it is -2 um. LinuxCNC's own planner of offsets stops up to 1e-7 mm short.
"""
import linuxcnc
from hal_pins import expect, finish, halcmd, pin, wait_for

WITHIN_mm = 1e-6


def check(what, T_degC, eoffset_mm):
    halcmd("setp", "ballbar-z-curve-1.in", str(T_degC))
    expect(f"{what}, {T_degC} degC: axis.z.eoffset, mm", wait_for("axis.z.eoffset", eoffset_mm, WITHIN_mm), eoffset_mm,
           WITHIN_mm)


def turn(state):
    command.state(state)
    command.wait_complete()
    wait_for("motion.motion-enabled", state == linuxcnc.STATE_ON)


command = linuxcnc.command()
expect("where nothing is connected: degC", pin("ballbar-z-curve-1.in"), 20.0)
check("machine off", 21.0, 0.0)
command.state(linuxcnc.STATE_ESTOP_RESET)
command.wait_complete()
turn(linuxcnc.STATE_ON)
check("on, not homed", 21.0, 0.0)
command.mode(linuxcnc.MODE_MANUAL)
command.wait_complete()
command.home(-1)
wait_for("motion.is-all-homed", True)
check("homed", 21.0, -0.002)
check("homed", 20.0, 0.0)
check("homed", 20.57, -0.0011)  # -11.4 counts
check("homed", 19.43, 0.0011)
check("homed", 25.0, -0.01)
check("beyond the end", 40.0, -0.022)
check("beyond the other end", -40.0, 0.002)
check("homed", 21.0, -0.002)
command.mode(linuxcnc.MODE_MDI)
command.wait_complete()
command.mdi("G0 Z0.1")  # not far, for halcmd gives 7 digits
command.wait_complete()
expect("motor at Z0.1, mm", wait_for("joint.2.motor-pos-cmd", 0.098, WITHIN_mm), 0.098, WITHIN_mm)

# Off and on: the control's offset begins at zero, and so do the counts.
turn(linuxcnc.STATE_OFF)
wait_for("ballbar-z-ready.out", False)
expect("off again: counts", wait_for("axis.z.eoffset-counts", 0.0), 0.0)
halcmd("setp", "ballbar-z-curve-1.in", "23")
turn(linuxcnc.STATE_ON)
check("on again", 23.0, -0.006)
finish()
