"""Workbooks: dates as serials, units in heads and rows, titles, two sheets, formulas, errors, 1904."""

from datetime import datetime

import clock
import table
from record import Log, Record
from xlsx_file import Error, Formula, Inline, Number, Sheet, workbook

FAMILY = "xlsx"
START = datetime(2026, 11, 22, 13, 5, 10)
MS = {"time_tolerance_s": 1e-3}
TEMPERATURES = ["T_bearing_front", "T_bearing_rear", "T_motor", "T_column", "T_bed", "T_room", "T_coolant"]


def number_cells(signals, missing=None):
    """Rows of cells; `missing` is the cell of a missing value, None for an empty one."""
    return [[missing if s.numbers[i] is None else Number(repr(s.numbers[i])) for s in signals] for i in range(len(signals[0].numbers))]


def stamps(record, style="stamp", base=datetime(1899, 12, 30)):
    return [Number(repr(clock.serial(s, base)), style) for s in record.stamps]


def heads(signals, style="brackets"):
    return [table.header(s, style) for s in signals]


def beside(first, rows):
    return [[a] + b for a, b in zip(first, rows)]


def log(record, sheets, signals, *, started=True, extra=None, more=None, **same):
    started = record.start.isoformat() if started else None
    return Log(record.name + ".xlsx", FAMILY, workbook(sheets, **same), record.time_s, signals, started=started, extra=extra or {},
               **(more or {}))


def logs():
    r = Record("xlsx_01_plain", 150, 10_000_000, START)
    s = r.signals(["speed", "load"] + TEMPERATURES)
    yield log(r, [Sheet("Tabelle1", [["Time"] + heads(s)] + beside(stamps(r), number_cells(s)))], s, extra=MS)

    r = Record("xlsx_02_title_units", 120, 30_000_000, START)
    s = r.signals(["speed", "T_bearing_front", "T_room", "X1", "Y1", "Z"], "de")
    top = [["Warmlauf Maschine 7"], [], ["Zeit"] + [c.source for c in s], [None] + [c.text for c in s]]
    yield log(r, [Sheet("Messung", top + beside(stamps(r, "german_stamp"), number_cells(s)), merged=("A1:G1",))], s, extra=MS)

    r = Record("xlsx_03_empty_first_row", 90, 60_000_000, START)
    s = r.signals(["T_bed", "T_column", "Z"], "fr")
    yield log(r, [Sheet("Feuil1", [["Date"] + heads(s, "round")] + beside(stamps(r), number_cells(s)), first_row=2)], s, extra=MS)

    r = Record("xlsx_04_1904", 100, 20_000_000, START)
    s = r.signals(["T_bearing_front", "T_coolant"])
    yield log(r, [Sheet("Sheet1", [["Time"] + heads(s)] + beside(stamps(r, "stamp", datetime(1904, 1, 1)), number_cells(s)))], s, extra=MS,
              date1904=True)

    r = Record("xlsx_05_two_sheets", 110, 15_000_000, START)
    s = r.signals(["load", "X1", "Z"])
    notes = Sheet("Notes", [["Who", "What"], ["A. B.", "changed the tool at 14:10"], ["Rows", Number("3")]])
    yield log(r, [Sheet("Data", [["Time"] + heads(s, "round")] + beside(stamps(r), number_cells(s))), notes], s, extra=MS)

    r = Record("xlsx_06_formulas", 80, 5_000_000, START)
    s = r.signals(["T_bearing_front", "T_bearing_rear"])
    mean = r.signal("T_housing", name="Mean", role=None)
    mean.numbers = [(a + b) / 2 for a, b in zip(s[0].numbers, s[1].numbers)]
    rows = []
    for i, (a, b, m) in enumerate(zip(s[0].numbers, s[1].numbers, mean.numbers)):
        rows.append([Number(repr(i * 5.0)), Number(repr(a)), Number(repr(b)), Formula(f"AVERAGE(B{i + 2}:C{i + 2})", repr(m), "two")])
    s.append(mean)
    yield log(r, [Sheet("Calc", [["Time [s]"] + heads(s)] + rows)], s, started=False)

    r = Record("xlsx_07_errors", 100, 10_000_000, START)
    s = r.signals(["T_motor", "T_room", "X1"])
    s[0].blank((3, 4, 50))
    s[2].blank((77,))
    yield log(r, [Sheet("Log", [["Time"] + heads(s)] + beside(stamps(r), number_cells(s, Error("#N/A"))))], s, extra=MS)

    r = Record("xlsx_08_gaps_inline", 95, 10_000_000, START)
    s = r.signals(["T_bed", "T_oil", "flow"])
    s[1].blank(range(20, 33))
    top = [[Inline("Time")] + [Inline(h) for h in heads(s, "slash")]]
    yield log(r, [Sheet("Log", top + beside(stamps(r, "stamp_ms"), number_cells(s)))], s, extra=MS)

    r = Record("xlsx_09_date_and_clock", 130, 20_000_000, datetime(2026, 11, 21, 23, 40, 0))
    s = r.signals(["T_column", "T_room"])
    serials = [clock.serial(t) for t in r.stamps]
    rows = [[Number(repr(float(int(d))), "date"), Number(repr(d - int(d)), "clock")] + c for d, c in zip(serials, number_cells(s))]
    yield log(r, [Sheet("Log", [["Date", "Time"] + heads(s)] + rows)], s, extra=MS)

    r = Record("xlsx_10_elapsed_over_a_day", 120, 900_000_000, START)
    s = r.signals(["T_bed", "T_room", "Z"])
    runs = [Number(repr(t / 86400), "elapsed") for t in r.time_s]
    yield log(r, [Sheet("Log", [["Elapsed"] + heads(s)] + beside(runs, number_cells(s)))], s, started=False, extra=MS)

    r = Record("xlsx_11_cover_first", 70, 10_000_000, START)
    s = r.signals(["speed", "T_bearing_front"], "de")
    cover = Sheet("Deckblatt", [["Prüfbericht"], ["Maschine", "M7"], ["Prüfer", "K. L."], ["Datum", "22.11.2026"]])
    yield log(r, [cover, Sheet("Daten", [["Zeit"] + heads(s)] + beside(stamps(r), number_cells(s)))], s,
              extra=MS | {"may_refuse": True}, more={"options": ["--sheet", "Daten"]})

    r = Record("xlsx_12_texts_as_times", 100, 10_000_000, START)
    s = r.signals(["speed", "load", "T_bearing_front"])
    yield log(r, [Sheet("Log", [["Timestamp"] + heads(s)] + beside([f"{t:%d.%m.%Y %H:%M:%S}" for t in r.stamps], number_cells(s)))], s)

    r = Record("xlsx_13_rich_and_wide", 60, 10_000_000, START)
    s = r.signals(["speed", "load", "power", "torque", "current"] + TEMPERATURES + ["T_oil", "T_head", "X1", "X2", "Y1", "Y2", "Z"])
    h = heads(s)
    yield log(r, [Sheet("Log", [["Time"] + h] + beside(stamps(r), number_cells(s)))], s, extra=MS, rich=(h[2], h[8]))

    r = Record("xlsx_14_no_references", 85, 10_000_000, START)
    s = r.signals(["T_bearing_front", "T_room"])
    rows = [["Time"] + heads(s)] + beside(stamps(r), number_cells(s))
    yield log(r, [Sheet("Log", rows, references=False)], s, extra=MS)

    r = Record("xlsx_15_mean_below", 75, 10_000_000, START)
    s = r.signals(["T_bed", "T_room"])
    rows = [["Time"] + heads(s)] + beside(stamps(r), number_cells(s))
    below = [[], [None] + [Formula(f"AVERAGE({c}2:{c}76)", repr(sum(x.numbers) / 75)) for c, x in zip("BC", s)]]
    yield log(r, [Sheet("Log", rows + below)], s, extra=MS)
