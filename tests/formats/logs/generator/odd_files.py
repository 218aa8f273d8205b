"""Rarer workbooks and MAT files: hidden sheets, tables that begin elsewhere, texts for numbers, matrices, nested structs."""

from datetime import datetime

import clock
import table
from mat_file import Writer
from record import Log, Record
from xlsx import MS, beside, heads, log, number_cells, stamps
from xlsx_file import Formula, Number, Sheet

START = datetime(2026, 11, 26, 8, 0, 0)
US = 1_000_000


def of(record_log, family):
    record_log.family = family
    return record_log


def books():
    def sheet(r, s, **more):
        return Sheet("Log", [["Time"] + heads(s)] + beside(stamps(r), number_cells(s)), **more)

    r = Record("oddbook_01_hidden_first", 70, 10 * US, START)
    s = r.signals(["speed", "T_room"])
    hidden = Sheet("settings", [["rate", Number("0.1")], ["user", "lab"]], state="hidden")
    yield log(r, [hidden, sheet(r, s)], s, extra=MS | {"may_refuse": True}, more={"options": ["--sheet", "Log"]})

    r = Record("oddbook_02_begins_at_c5", 70, 10 * US, START)
    s = r.signals(["T_bed", "T_room", "Z"])
    rows = [[None, None] + row for row in sheet(r, s).rows]
    yield log(r, [Sheet("Log", rows, first_row=5)], s, extra=MS)

    r = Record("oddbook_03_numbers_as_texts", 60, 10 * US, START)
    s = r.signals(["T_bearing_front", "T_room"], "de")
    texts = [[table.number(n, 2, ",") for n in row] for row in zip(*(c.numbers for c in s))]
    yield log(r, [Sheet("Log", [["Zeit"] + heads(s)] + beside(stamps(r), texts))], s, extra=MS)

    r = Record("oddbook_04_plain_serials", 80, 60 * US, START)
    s = r.signals(["T_column", "X1"])
    yield log(r, [Sheet("Log", [["Date and time"] + heads(s)] + beside(stamps(r, "general"), number_cells(s)))], s, extra=MS)

    r = Record("oddbook_05_minutes_and_tenths", 90, 100_000, START)
    s = r.signals(["speed", "load"])
    runs = [Number(repr(t / 86400), "minutes") for t in r.time_s]
    yield log(r, [Sheet("Log", [["Elapsed"] + heads(s)] + beside(runs, number_cells(s)))], s, started=False, extra=MS)

    r = Record("oddbook_06_formula_of_the_time", 60, 10 * US, START)
    s = r.signals(["T_bed", "T_room"])
    first = stamps(r)
    times = [first[0]] + [Formula(f"A{i + 1}+10/86400", c.text, "stamp") for i, c in enumerate(first) if i]
    yield log(r, [Sheet("Log", [["Time"] + heads(s)] + beside(times, number_cells(s)))], s, extra=MS)

    r = Record("oddbook_07_remarks", 60, 10 * US, START)
    s = r.signals(["load", "Z"])
    rows = sheet(r, s).rows
    rows[0] = rows[0] + ["Remark"]
    rows[12] = rows[12] + ["door open"]
    yield log(r, [Sheet("Log", rows)], s, extra=MS, more={"skipped": ["Remark"]})


def mats():
    w = Writer()

    def mat(r, elements, signals, **more):
        return Log(r.name + ".mat", "odd_mat", w.file(elements), r.time_s, signals, **more)

    r = Record("oddmat_01_matrix", 90, US, START)
    s = [r.signal(k, unit="", name=f"T({i + 1})", role=None) for i, k in enumerate(("T_bearing_front", "T_bed", "T_room"))]
    flat = [n for c in s for n in c.numbers]
    yield mat(r, [w.numbers("T", flat, dims=(90, 3)), w.numbers("time_s", r.time_s)], s, extra={"may_refuse": True})

    r = Record("oddmat_02_scalars_beside", 90, US, START)
    s = [r.signal("speed", name="speed", unit="rpm"), r.signal("T_bearing_front", name="T_bearing", unit="degC")]
    yield mat(r, [w.numbers("fs", [1.0]), w.numbers("speed_rpm", s[0].numbers), w.numbers("T_bearing_degC", s[1].numbers),
                  w.numbers("time_s", r.time_s), w.text("who", "lab")], s, skipped=["fs", "who"])

    r = Record("oddmat_03_nested", 80, 2 * US, START)
    s = [r.signal("T_bearing_front", name="front", unit="degC"), r.signal("T_bearing_rear", name="rear", unit="degC")]
    inner = w.structure("", [("front_degC", w.numbers("", s[0].numbers)), ("rear_degC", w.numbers("", s[1].numbers))])
    yield mat(r, [w.structure("run1", [("time_s", w.numbers("", r.time_s)), ("T", inner)])], s, extra={"may_refuse": True})

    r = Record("oddmat_04_no_time", 70, 1000, START)
    s = [r.signal("voltage", name="u", unit="V"), r.signal("current", name="i", unit="A")]
    yield mat(r, [w.numbers("u_V", s[0].numbers), w.numbers("i_A", s[1].numbers)], s, expect="needs", why="there is no time and no rate",
              options=["--every", "0.001s"])

    r = Record("oddmat_05_epoch", 80, 5 * US, START)
    s = [r.signal("T_room", name="T_room", unit="degC")]
    epoch = [clock.since_epoch_us(t) / 1e6 for t in r.stamps]
    yield mat(r, [w.numbers("t_epoch_s", epoch), w.numbers("T_room_degC", s[0].numbers)], s, started=START.isoformat())


def logs():
    for book in books():
        yield of(book, "odd_xlsx")
    yield from mats()
