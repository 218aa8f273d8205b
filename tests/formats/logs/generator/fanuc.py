"""Waveforms of FANUC SERVO GUIDE saved as CSV: lines on the measurement, heads with units, time in ms or a cycle above."""

from datetime import datetime

import clock
from delimited import delimited, no_times
from record import Record

FAMILY = "fanuc"


def above(record, channels, cycle=True):
    lines = ["FANUC SERVO GUIDE,V11.0", f"DATE,{record.start:%Y/%m/%d %H:%M:%S}", f"CHANNEL,{channels}"]
    if cycle:
        lines.append(f"SAMPLING CYCLE,{record.interval_us / 1000:g}msec")
    lines.append(f"DATA POINTS,{record.rows}")
    return "\n".join(lines) + "\n"


def logs():
    def spindle(r, speed="min-1"):
        return [r.signal("speed", unit=speed, name="SPEED S1"), r.signal("load", name="LMDAT S1"),
                r.signal("torque", unit="Nm", name="TCMD S1")]

    start = datetime(2026, 10, 5, 16, 40, 0)
    r = Record("fanuc_01_spindle", 300, 1_000, start)
    yield delimited("fanuc_01_spindle.csv", FAMILY, clock.counted(r, 1000, 0, "TIME(msec)"), spindle(r), style="round",
                    above=above(r, 3), extra={"started_also": [start.isoformat()]})
    r = Record("fanuc_02_axes", 250, 2_000, start)
    yield delimited("fanuc_02_axes.csv", FAMILY, clock.counted(r, 1000, 0, "TIME(msec)"),
                    [r.signal("pos_X", name="POSF X"), r.signal("pos_Y", name="POSF Y"), r.signal("current", name="IEFF X")],
                    style="round", lead=[("No.", [str(i + 1) for i in range(250)])], above=above(r, 3), quote=False,
                    extra={"started_also": [start.isoformat()]})
    r = Record("fanuc_03_cycle_above", 200, 1_000, start)
    yield delimited("fanuc_03_cycle_above.csv", FAMILY, no_times(200, 0.001), spindle(r), style="round", above=above(r, 3),
                    options=["--every", "0.001s"], extra={"started_also": [start.isoformat()]})
    r = Record("fanuc_04_no_cycle", 150, 8_000, start)
    yield delimited("fanuc_04_no_cycle.csv", FAMILY, no_times(150, 0.008), spindle(r, "rpm"), style="round",
                    above=above(r, 3, cycle=False), expect="needs", why="there is a date above, but no time a row and no cycle",
                    options=["--every", "0.008s"], extra={"started_also": [start.isoformat()]})
    r = Record("fanuc_05_japanese", 180, 4_000, start)
    yield delimited("fanuc_05_japanese.csv", FAMILY, clock.counted(r, 1000, 0, "時間(msec)"),
                    r.signals(["speed", "load", "torque"], "ja"), style="round", encoding="cp932")
    r = Record("fanuc_06_units_row", 220, 1_000_000, start)
    yield delimited("fanuc_06_units_row.csv", FAMILY, clock.counted(r, 1, 0, "TIME"),
                    [r.signal("speed", unit="min-1", name="SPEED S1"), r.signal("load", name="LOAD METER S1"),
                     r.signal("T_motor", unit="deg C", name="MOTOR TEMP S1")], units_row=True, time_unit="sec")
    r = Record("fanuc_07_exponents", 120, 500, start)
    signals = spindle(r)
    from table import exponent
    for s in signals:
        s.numbers = [float(exponent(n, 6)) for n in s.numbers]
    yield delimited("fanuc_07_exponents.csv", FAMILY, clock.counted(r, 1000, 1, "TIME(msec)"), signals, style="round",
                    show={i: [exponent(n, 6) for n in s.numbers] for i, s in enumerate(signals)})
    r = Record("fanuc_08_tabs", 140, 16_000, start)
    yield delimited("fanuc_08_tabs.txt", FAMILY, clock.counted(r, 1, 3, "Time [s]"),
                    [r.signal("speed", unit="rpm", name="SPEED S1"), r.signal("feed", name="VCMD X"),
                     r.signal("pos_Z", unit="mm", name="POSF Z")], separator="\t")
