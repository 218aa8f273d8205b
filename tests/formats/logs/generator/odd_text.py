"""Rarer texts: lost marks, torn ends, minus signs, bare points, units in the cells, the time in another place."""

from datetime import datetime

import clock
import table
from delimited import delimited
from record import Record, Signal

FAMILY = "odd_text"
START = datetime(2026, 11, 25, 15, 20, 0)
US = 1_000_000
T3 = ["T_bearing_front", "T_column", "T_room"]


def odd(name, keys=None, rows=64, *, language="en", time=None, ending=".csv", show=None, **more):
    r = Record(name, rows, 10 * US, START)
    signals = r.signals(keys or T3, language)
    times = time(r) if time else clock.absolute(r, "iso")
    shown = show(signals) if show else None
    return delimited(name + ending, FAMILY, times, signals, show=shown, **more)


def with_end(log, tail):
    log.content += tail
    return log


def moved(to):
    def edit(rows):
        for row in rows:
            row.insert(to, row.pop(0))

    return edit


def every_cell(change):
    """Shows each number changed by `change`, which takes its text."""
    return lambda signals: {i: [change(t) for t in table.cells(s)] for i, s in enumerate(signals)}


def bare_point(text):
    """0.25 as .25 and 21.00 as 21."""
    text = text.rstrip("0") if "." in text else text
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) and len(text.strip("-0.")) else text


def numbered(name, words, count, unit, language, **more):
    """Channels that a number alone tells apart; speed, load and probes beside."""
    r = Record(name, 200, 10 * US, START)
    keys = ["T_bearing_front", "T_bearing_rear", "T_motor", "T_housing", "T_head", "T_column", "T_bed", "T_oil", "T_nut", "T_room",
            "T_coolant"]
    probes = [r.signal(k, language) for k in ("X1", "Y1", "Z")]
    signals = [r.signal("speed", language, unit="1/min"), r.signal("load", language)]
    signals += [r.signal(keys[i % len(keys)], unit=unit, name=words.format(i + 1), role=None) for i in range(count)]
    return delimited(name + ".csv", FAMILY, more.pop("time")(r), signals + probes, **more)


def logs():
    de = {"separator": ";", "decimal": ",", "language": "de", "time": lambda r: clock.absolute(r, "dots", "Zeit")}
    yield numbered("odd_01_fifteen_temperatures", "Temp {}", 15, "°C", "de", separator=";", decimal=",", encoding="cp1252",
                   time=lambda r: clock.absolute(r, "dots", "Zeit"))
    yield numbered("odd_02_numbered_chinese", "温度{}", 8, "℃", "zh", encoding="gb18030", style="round",
                   time=lambda r: clock.absolute(r, "year_slash", "时间"))
    yield odd("odd_03_utf16_without_mark", separator="\t", encoding="utf-16-le", ending=".txt")
    yield odd("odd_04_two_micros", ["X1", "Y1", "Z"], edit=lambda rows: rows[0].__setitem__(2, rows[0][2].replace("µ", "μ")))
    yield odd("odd_05_separator_in_a_head", edit=lambda rows: rows[0].__setitem__(1, "Bearing, front [°C]"))
    yield odd("odd_06_cr_cr_lf", end="\r\r\n")
    yield with_end(odd("odd_07_zeros_at_the_end"), b"\0" * 700)
    yield with_end(odd("odd_08_dos_end"), b"\x1a")
    torn = with_end(odd("odd_09_torn_last_row"), b"2026-11-25T15:3")
    torn.extra["may_refuse"] = True
    yield torn
    yield odd("odd_10_time_third", ["speed", "load"] + T3, edit=moved(2), **de)
    yield odd("odd_11_time_last", ["speed", "T_room"], edit=moved(2))
    yield odd("odd_12_groups_above", ["speed", "load", "T_room"], above=",Spindle,Spindle,Hall\n", style="round")
    yield odd("odd_13_blanks_and_commas", ["T_room", "Z"], separator=" ", decimal=",", ending=".txt", style="underscore",
              time=lambda r: clock.counted(r, 1, 1, "t_s", ","), edit=lambda rows: rows[0].__setitem__(slice(1, 3), ["T_room_°C", "Z_µm"]))
    yield in_cells()
    yield switched("odd_15_on_and_off", "Coolant pump", ("OFF", "ON"), lambda row: row > 9)
    yield switched("odd_16_true_and_false", "door_closed", ("False", "True"), lambda row: row % 9 > 0)
    yield nameless()
    yield odd("odd_18_minus_sign", ["X1", "Y1", "Z"], show=every_cell(lambda t: t.replace("-", "\u2212")))
    yield odd("odd_19_bare_points", ["X1", "Y1", "T_room"], show=every_cell(bare_point))
    yield fortran()
    yield odd("odd_21_status", T3, behind=[("Status", "OK")], **de)
    yield standing()
    yield odd("odd_23_colon_separated_heads", T3, above="Logger: GX\nSerial: 4711\nFirmware: 1.2.3\nStart: 2026-11-25 15:20:00\n", separator=";")


def in_cells():
    """A unit behind each number."""
    r = Record("odd_14_units_in_cells", 64, 10 * US, START)
    signals = r.signals(["speed", "load", "T_room"])
    show = {i: [f"{t} {s.text}" for t in table.cells(s)] for i, s in enumerate(signals)}
    return delimited("odd_14_units_in_cells.csv", FAMILY, clock.absolute(r, "iso"), signals, style="none", show=show,
                     extra={"may_refuse": True})


def switched(name, head, words, is_on):
    """A switch in words, behind a speed and a temperature: 0 and 1."""
    r = Record(name, 64, 10 * US, START)
    states = [int(is_on(row)) for row in range(64)]
    signals = r.signals(["speed", "T_room"]) + [Signal(head, "", states, 0)]
    return delimited(name + ".csv", FAMILY, clock.absolute(r, "iso"), signals, show={2: [words[state] for state in states]})


def nameless():
    r = Record("odd_17_nameless_column", 64, 10 * US, START)
    signals = [r.signal("T_bed"), r.signal("T_room", unit="", name="", role=None)]
    return delimited("odd_17_nameless_column.csv", FAMILY, clock.absolute(r, "iso"), signals)


def fortran():
    r = Record("odd_20_fortran", 64, 10 * US, START)
    signals = [r.signal("X1", digits=6), r.signal("voltage", digits=6)]
    for s in signals:
        s.numbers = [float(table.exponent(n, 4)) for n in s.numbers]
    show = {i: [table.exponent(n, 4, ".", "D") for n in s.numbers] for i, s in enumerate(signals)}
    return delimited("odd_20_fortran.txt", FAMILY, clock.counted(r, 1, 1, "Time [s]"), signals, separator="\t", show=show)


def standing():
    """A spindle that stands: a column of zeros is a column."""
    r = Record("odd_22_zeros", 40, 10 * US, START)
    signals = r.signals(["speed", "T_room"])
    signals[0].numbers = [0.0] * 40
    return delimited("odd_22_zeros.csv", FAMILY, clock.absolute(r, "iso"), signals)
