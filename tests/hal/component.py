"""Counts of ballbar-hal, row by row, as worked by hand.

The model: 2 um/K from the first row's 20 degC. A count is 0.1 um. Rows are 10 s apart: at 0.2 um/s the offset could go
2 um a row, a step is at most 1 um, 10 counts. wanted = -2 um/K (T - 20 degC) / 0.1 um:

  time s   T degC    wanted   counts  reason
       0    20.0          0        0  9 disabled: enable is believed with the next row
       5    20.0          0        0
      10    20.5        -10      -10
      20    21.5        -30      -20  a step
      30    21.5        -30      -30
      40     nan                 -30  1 no_value
      50    24.0        -80      -40  not a spike: 2.5 K off the last one believed, 2 K + 0.1 K/s 20 s are likely
      60    29.0                 -40  2 spike: 5 K off, likely are 3 K
      65    31.2                 -40  4 out_of_range: trained from 19 to 30 degC, a tenth of that further are believed
      70    24.04     -80.8      -50
      80    24.04                -50  9 disabled
      85    24.04                -50  9
      90    24.04                -60
      95    24.04                -60  9; killed and started again in between
     100    24.04                -70  from -60, and not from a new zero at 24 degC
     110    24.04                -80
     120    24.04                -81  0.8 of a count off: more than 1/2 + 1/4
     125    24.04                -81  9; told to stop and started again in between
     130    24.04                -81
     129    24.04                -81  5 clock_back

The control's offset is given by the test: that of the counts. Where it was turned off, and has none:

     140    24.04                -81
     150    24.04                -81  10 control
     160    24.04                -91

A machine in inches has counts of 0.0001 mm / 25.4. A new component, whose zero is its first row at 24.04 degC, finds
-0.0091 mm / 25.4, 91 counts, and goes from there to 0 by steps of 10; what it adds to its counts is their change:

       0    24.04      0        -91  9 disabled
       5    24.04      0        -81
"""
import os
import resource
import subprocess
import time

from hal_pins import expect, finish, halcmd, kill, load, pin, process, row, wait_for

REASON = {"none": 0, "no_value": 1, "spike": 2, "out_of_range": 4, "clock_back": 5, "disabled": 9, "control": 10}


taken = []  # (time, temperature, counts) of all rows


def check(component, time_s, T_xi_degC, counts, reason="none"):
    row(component, time_s, T_xi_degC)
    where = f"{time_s} s, {T_xi_degC} degC: "
    expect(where + "counts", pin("axis.z.eoffset-counts"), counts)
    taken.append((time_s, T_xi_degC, pin("axis.z.eoffset-counts")))
    expect(where + "hold-reason", pin(component + ".hold-reason"), REASON[reason])
    expect(where + "held", pin(component + ".held"), reason != "none")
    halcmd("setp", component + ".z.applied", str(0.0001 * counts))


def connect(component):
    halcmd("net", "enable", f"{component}.z.enable", "axis.z.eoffset-enable")
    halcmd("net", "scale", f"{component}.z.scale", "axis.z.eoffset-scale")
    halcmd("net", "counts", f"{component}.z.counts", "axis.z.eoffset-counts")
    halcmd("setp", f"{component}.z.applied", str(0.0001 * pin("axis.z.eoffset-counts")))
    halcmd("setp", f"{component}.enable", "1")


load("ballbar")
halcmd("unload", "ballbar")
time.sleep(0.2)
load("ballbar")  # with the state of one that has had no row
connect("ballbar")
check("ballbar", 0, 20.0, 0, "disabled")
expect("eoffset-enable", pin("axis.z.eoffset-enable"), False)
for time_s, T_degC, counts in [(5, 20.0, 0), (10, 20.5, -10), (20, 21.5, -20), (30, 21.5, -30)]:
    check("ballbar", time_s, T_degC, counts)
expect("scale mm a count", pin("axis.z.eoffset-scale"), 0.0001, 1e-12)
expect("eoffset-enable", pin("axis.z.eoffset-enable"), True)
check("ballbar", 40, "nan", -30, "no_value")
check("ballbar", 50, 24.0, -40)
check("ballbar", 60, 29.0, -40, "spike")
check("ballbar", 65, 31.2, -40, "out_of_range")
check("ballbar", 70, 24.04, -50)

# `ballbar compensate` says the same of these rows.
with open("rows.csv", "w") as file:
    file.write("time_s,T_xi_degC\n" + "".join(f"{time_s},{T_degC}\n" for time_s, T_degC, _ in taken))
said = subprocess.run([os.environ["BALLBAR_PROGRAM"], "compensate", "--model", "live.toml", "--to", "z", "--step-um",
                       "1", "--signals", "rows.csv"], stdout=subprocess.PIPE, text=True).stdout.splitlines()
place = said[0].split(",").index("z_counts")
expect("rows of ballbar compensate", len(said) - 1, len(taken))
for (time_s, _, counts), line in zip(taken, said[1:]):
    expect(f"{time_s} s: counts of ballbar compensate", float(line.split(",")[place]), counts)

halcmd("setp", "ballbar.enable", "0")
check("ballbar", 80, 24.04, -50, "disabled")
halcmd("setp", "ballbar.enable", "1")
check("ballbar", 85, 24.04, -50, "disabled")
check("ballbar", 90, 24.04, -60)
expect("offset-um", pin("ballbar.z.offset-um"), -6.0, 1e-9)

# A killed component leaves its pins with their values, and its name taken.
kill("ballbar")
expect("counts after kill -9", pin("axis.z.eoffset-counts"), -60)
again = subprocess.run([os.environ["BALLBAR_HAL"], "--model", "live.toml", "--to", "z"], stderr=subprocess.PIPE,
                       text=True, timeout=10)
expect("status of a start with the same name", again.returncode, 1)
expect("what it says", "ballbar-hal: HAL takes no component 'ballbar': error -22; where one" in again.stderr, True)
for name in ["counts", "scale", "enable"]:
    halcmd("unlinkp", f"ballbar.z.{name}")
load("ballbar-2")
connect("ballbar-2")
expect("counts after a new start", pin("axis.z.eoffset-counts"), -60)
check("ballbar-2", 95, 24.04, -60, "disabled")
for time_s, counts in [(100, -70), (110, -80), (120, -81)]:
    check("ballbar-2", time_s, 24.04, counts)

# One that is told to stop takes its pins along; the signals stay.
halcmd("unload", "ballbar-2")
expect("eoffset-enable after unload", wait_for("axis.z.eoffset-enable", False), False)
expect("counts after unload", pin("axis.z.eoffset-counts"), -81)
time.sleep(0.2)  # until the name is free
load("ballbar-2")
connect("ballbar-2")
check("ballbar-2", 125, 24.04, -81, "disabled")
check("ballbar-2", 130, 24.04, -81)
check("ballbar-2", 129, 24.04, -81, "clock_back")
check("ballbar-2", 140, 24.04, -81)
halcmd("setp", "ballbar-2.z.applied", "0")
check("ballbar-2", 150, 24.04, -81, "control")
halcmd("setp", "ballbar-2.z.applied", "0")
check("ballbar-2", 160, 24.04, -91)

# Where the state is to be written there must be a folder.
again = subprocess.run([os.environ["BALLBAR_HAL"], "--name", "none", "--model", "live.toml", "--to", "z", "--state",
                        "none/z.json"], stderr=subprocess.PIPE, text=True, timeout=10)
expect("status of a start without the state's folder", again.returncode, 1)
expect("what it says", "none/z.json: expected a folder to write to, found: No such file" in again.stderr, True)

# An offset is made of um.
with open("live.toml") as file, open("mm.toml", "w") as mm:
    mm.write(file.read().replace("z_um", "z_mm"))
again = subprocess.run([os.environ["BALLBAR_HAL"], "--name", "mm", "--model", "mm.toml", "--to", "z"],
                       stderr=subprocess.PIPE, text=True, timeout=10)
expect("status of a start with a target in mm", again.returncode, 1)
expect("what it says", "expected a target in um" in again.stderr, True)

# In inches; and a state that can no longer be written, as on a full disk: its file may not grow beyond 100 bytes. Said
# once, although the text has the size of the state, and not the end of the component.
halcmd("unload", "ballbar-2")
reading, writing = os.pipe()
load("inch", "inch.json", ["--machine-unit", "inch"], writing)
os.close(writing)
resource.prlimit(process("inch"), resource.RLIMIT_FSIZE, (100, 100))
halcmd("setp", "inch.z.applied", repr(-0.0091 / 25.4))
halcmd("setp", "inch.enable", "1")
for time_s, counts, change in [(0, -91, 0), (5, -81, 10)]:
    row("inch", time_s, 24.04)
    expect(f"inches, {time_s} s: counts", pin("inch.z.counts"), change)
    expect(f"inches, {time_s} s: offset-um", pin("inch.z.offset-um"), 0.1 * counts, 1e-9)
expect("inches a count", pin("inch.z.scale"), 0.0001 / 25.4, 1e-12)
for time_s in range(20, 40):
    halcmd("setp", "inch.z.applied", repr((-0.0091 + 0.0001 * pin("inch.z.counts")) / 25.4))
    row("inch", time_s, 24.04 + time_s / 1e3)
halcmd("unload", "inch")
with os.fdopen(reading) as stderr:
    said = [line for line in stderr if "inch.json" in line]
expect("lines about the state", len(said), 1)
expect(f"what it says: {said}", "space to write" in "".join(said), True)
finish()
