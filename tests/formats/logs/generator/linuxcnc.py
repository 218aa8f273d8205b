"""halsampler (numbers alone, blanks, "overrun") and halscope (log with the sampling period; the older form names each value)."""

from delimited import delimited, no_times
from record import Log, Record
import clock
import table

FAMILY = "linuxcnc"


def bare(record, keys):
    """Six digits, as printf's %f; nothing tells what a column is."""
    return [record.signal(k, unit="", digits=6, name="", role=None) for k in keys]


def sampler(name, keys, rows, period_us, tag=False, bit=False, overrun=()):
    r = Record(name, rows, period_us)
    signals = bare(r, keys)
    columns = [table.cells(s) for s in signals]
    if bit:
        on = r.signal("speed", unit="", digits=0, name="", role=None)
        on.numbers = [1.0 if n > 100 else 0.0 for n in on.numbers]
        signals.append(on)
        columns.append([f"{int(n)}" for n in on.numbers])
    numbers, lost, text = [], 0, ""
    for i in range(rows):
        if i in overrun:
            text, lost = text + "overrun\n", lost + 25
        numbers.append(i + lost)
        text += (f"{i + lost} " if tag else "") + "".join(c[i] + " " for c in columns) + "\n"
    even = [i * period_us / 1e6 for i in range(rows)]
    time_s = [n * period_us / 1e6 for n in numbers] if tag else even
    extra = {"time_s_also": [even]} if overrun and tag else {}
    return Log(name + ".txt", FAMILY, text.encode(), time_s, signals, expect="needs",
               why="halsampler writes neither a time nor its rate", options=["--every", f"{period_us / 1e6:g}s"],
               skipped=["sample number"] if tag else [], extra=extra)


def scope(name, pins, rows, period_ns):
    """The log of today's halscope: period, names, positions and scales of the screen, then rows."""
    r = Record(name, rows, max(1, period_ns // 1000))
    signals = [r.signal(k, unit="", digits=14, name=pin, role=role) for k, pin, role in pins]
    sep = ";"
    above = f"# Sampling period is {period_ns} ns\n" + sep.join(s.source for s in signals) + "\n# Position: " + sep.join(
        ["0.500000"] * len(signals)) + "\n# Scale: " + sep.join(["6"] * len(signals)) + "\n"
    rows_of_text = table.rows([table.cells(s, sign="+") for s in signals])
    text = above + "".join(sep.join(row) + "\n" for row in rows_of_text)
    return Log(name + ".csv", FAMILY, text.encode(), [i * period_ns / 1e9 for i in range(rows)], signals,
               options=["--every", f"{period_ns / 1e9:.9f}s"])


def older(name, pins, rows, period_ns):
    """Each value behind its name: "pin +1.0 pin +2.0 "."""
    r = Record(name, rows, max(1, period_ns // 1000))
    signals = [r.signal(k, unit="", digits=14, name=pin, role=role) for k, pin, role in pins]
    body = table.rows([table.cells(s, sign="+") for s in signals])
    text = f"Sampling period is {period_ns} ns \n" + "".join(
        "\n" + "".join(f"{s.source} {c} " for s, c in zip(signals, row)) for row in body) + "\n"
    return Log(name + ".log", FAMILY, text.encode(), [i * period_ns / 1e9 for i in range(rows)], signals,
               options=["--every", f"{period_ns / 1e9:.9f}s"])


SPINDLE = [("speed", "spindle.0.speed-in", "speed"), ("current", "vfd.output-current", None)]
AXES = [("pos_X", "joint.0.motor-pos-fb", None), ("pos_Y", "joint.1.motor-pos-fb", None), ("pos_Z", "joint.2.f-error", None)]


def logs():
    yield sampler("linuxcnc_01_sampler", ["speed", "pos_X"], 300, 1_000)
    yield sampler("linuxcnc_02_tagged", ["speed", "T_motor", "Z"], 200, 10_000, tag=True)
    yield sampler("linuxcnc_03_bit", ["speed", "load"], 150, 1_000, bit=True)
    yield sampler("linuxcnc_04_overrun", ["pos_X", "pos_Y"], 180, 1_000, tag=True, overrun=(60, 121))
    yield sampler("linuxcnc_05_one_column", ["T_motor"], 120, 1_000_000)
    yield scope("linuxcnc_06_scope", SPINDLE, 250, 1_000_000)
    yield scope("linuxcnc_07_scope_axes", AXES, 200, 999_424)
    yield older("linuxcnc_08_scope_older", SPINDLE + AXES[:1], 160, 1_000_000)
    # halsampler with a line of names that a person put above, and a column of the run time
    r = Record("linuxcnc_09_named", 140, 50_000)
    yield delimited("linuxcnc_09_named.txt", FAMILY, clock.counted(r, 1, 6, "# time_s"),
                    [r.signal("speed", name="speed", unit="rpm"), r.signal("T_bearing_front", name="T_bearing", unit="degC", digits=6),
                     r.signal("Z", name="Z", unit="um", digits=6)], separator=" ", style="underscore", end="\n")
