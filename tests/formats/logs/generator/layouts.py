"""Other layouts than a table under one line of names: Campbell's TOA5, halscope, EPICS, tidy tables, points of a tracker,
and workbooks with dates at midnight and a remark in the first row."""

import xlsx_file as w
from record import Log, Record, Signal
import table

FAMILY = "layouts"


def campbell(name, kind, keys, skipped="RECORD"):
    r = Record(name, 150, 60_000_000)
    signals = r.signals(keys, unit="")
    for i, s in enumerate(signals):
        s.source, s.text = f"{s.source.replace(' ', '_')}_Avg", {"degC": "°C", "um": "um", "rpm": "rpm"}[kind[i]]
        s.blank([7] if i == 0 else [])
    cells = [table.cells(s, missing='"NAN"') for s in signals]
    words = {"°C": "Deg C"}
    rows = [["TIMESTAMP", skipped] + [s.source for s in signals], ["TS", "RN"] + [words.get(s.text, s.text) for s in signals],
            ["", ""] + ["Avg"] * len(signals)]
    text = '"TOA5","Tower","CR1000X","4711","CR1000X.Std.05","CPU:warm_up.CR1X","51","Min"\r\n'
    text += "".join(",".join(f'"{c}"' for c in row) + "\r\n" for row in rows)
    text += "".join(f'"{t:%Y-%m-%d %H:%M:%S}",{i + 311},' + ",".join(c[i] for c in cells) + "\r\n" for i, t in enumerate(r.stamps))
    return Log(name + ".dat", FAMILY, text.encode(), r.time_s, signals, started=r.start.isoformat(), skipped=[skipped])


def channels(name, row, keys, head="", units=False, late_us=0, end="\n"):
    """Channels by turns; the second one has its stamps `late_us` behind those of the first."""
    r = Record(name, 120, 10_000_000)
    signals = r.signals(keys, unit="" if not units else None)
    lines, times = [], sorted({t + k * late_us for k in range(len(signals)) for t in r.times_us})
    columns = [[None] * len(times) for _ in signals]
    for i, stamp in enumerate(r.stamps):
        for k, s in enumerate(signals):
            at = r.times_us[i] + k * late_us
            columns[k][times.index(at)] = s.numbers[i]
            lines.append((at, k, row(s, stamp + (r.stamps[1] - r.stamps[0]) * (k * late_us / r.interval_us), f"{s.numbers[i]:.{s.digits}f}")))
    for s, numbers in zip(signals, columns):
        s.numbers = numbers
    text = head + "".join(line + end for _, _, line in sorted(lines))
    return Log(name, FAMILY, text.encode(), [t / 1e6 for t in times], signals, started=r.start.isoformat())


def epics(s, stamp, number):
    return f"{s.source.replace(' ', '-'):<30} {stamp:%Y-%m-%d %H:%M:%S.%f} {number}  "


def with_plain_names(log):
    for s in log.columns:
        s.source = s.source.replace(" ", "-")
    return log


def beside(name, unit, end):
    r = Record(name, 90, 500_000)
    signals = r.signals(["T_bearing_front", "T_motor"], unit="")
    for i, s in enumerate(signals):
        s.source, s.text = f"T{i + 1}", "°C" if unit else ""
    cells = [table.cells(s) for s in signals]
    text = "Sampling interval: 500 ms\n\n" + "".join(
        " ".join(f"{s.source}{end} {c[i]}{unit}" for s, c in zip(signals, cells)) + "\n" for i in range(r.rows))
    return Log(name, FAMILY, text.encode(), r.time_s, signals)


def points(name, comment, separator, unit):
    r = Record(name, 100, 1_000_000)
    axes = [Signal(axis, unit, [round(v + 0.0001 * ((7 * i) % 11), 4) for i in range(r.rows)], 4)
            for axis, v in zip("XYZ", (1204.5, -310.25, 88.125))]
    cells = [table.cells(s) for s in axes]
    text = comment + "".join(separator.join(["A", "Nest", f"P{i + 1}"] + [c[i] for c in cells] + [f"{t:%Y-%m-%d %H:%M:%S}"]) + "\n"
                             for i, t in enumerate(r.stamps))
    return Log(name, FAMILY, text.encode(), r.time_s, axes, started=r.start.isoformat())


def workbook(name, date, clock, remark):
    r = Record(name, 80, 60_000_000)
    signals = r.signals(["T_bearing_front", "T_room", "Z"])
    rows = [["Date", "Time"] + [table.header(s, "round") for s in signals] + ["Remark"]]
    for i, t in enumerate(r.stamps):
        days = 46348 + (t - t.replace(year=2026, month=11, day=22, hour=0, minute=0, second=0)).total_seconds() / 86400
        rows.append([w.Number(f"{int(days)}", date), w.Number(f"{days % 1:.12f}", clock)] +
                    [w.Number(c[i]) for c in map(table.cells, signals)] + (["probe clamped anew"] if i in remark else []))
    return Log(name, FAMILY, w.workbook([w.Sheet("Sheet1", rows)]), r.time_s, signals, started=r.start.isoformat(),
               skipped=["Remark"], extra={"time_tolerance_s": 0.01})


def logs():
    yield campbell("layouts_01_toa5", ["degC", "degC", "um"], ["T_bearing_front", "T_room", "Z"])
    yield campbell("layouts_02_toa5_eight", ["degC"] * 5 + ["rpm"], ["T_bearing_front", "T_bearing_rear", "T_room", "T_coolant", "T_motor", "speed"])
    yield campbell("layouts_03_toa5_one", ["um"], ["Z"], "RecNbr")
    yield with_plain_names(channels("layouts_04_epics.log", epics, ["T_bearing_front", "Z"], late_us=300_000))
    yield with_plain_names(channels("layouts_05_epics_together.log", epics, ["speed", "T_room", "T_motor"]))
    yield channels("layouts_06_tidy.csv", lambda s, t, n: f"{t.isoformat()},{s.source},{n},{s.text}", ["T_bearing_front", "T_room", "Z"],
                   "time,sensor,value,unit\n", units=True)
    yield channels("layouts_07_entities.csv", lambda s, t, n: f"{s.source},{n},{t.isoformat()}Z", ["T_bearing_front", "T_coolant"],
                   "entity_id,state,last_changed\n", late_us=2_500_000)
    yield beside("layouts_08_beside.txt", "", "")
    yield beside("layouts_09_beside_units.txt", " C", ":")
    yield points("layouts_10_points.txt", "// Software 2026\n// AXES = CARTESIAN: X,  Y,  Z (mm)\n", ",  ", "mm")
    yield points("layouts_11_points_blanks.txt", "// AXES = CARTESIAN: X, Y, Z (in)\n", " ", "in")
    yield points("layouts_12_points_tabs.txt", "", "\t", "")
    yield workbook("layouts_13_midnight.xlsx", "stamp", "clock", (0,))
    yield workbook("layouts_14_dates.xlsx", "date", "clock", (0, 1))
    yield workbook("layouts_15_fraction.xlsx", "stamp", "general", (79,))
