"""TNCscope: its ASCII file (.sco, lines that begin with %, time in us) and its export to CSV."""

from datetime import datetime

import clock
from delimited import delimited, no_times
from record import Log, Record
import table

FAMILY = "heidenhain"


def sco(name, channels, rows, cycle_us):
    r = Record(name, rows, cycle_us, datetime(2026, 8, 18, 11, 2, 0))
    signals = [r.signal(key, name=kind, unit=unit) for key, kind, _, unit in channels]
    text = ["%[GLOBAL]", "%VERSION=3.0", f"%DATE={r.start:%d.%m.%Y}", f"%TIME={r.start:%H:%M:%S}", f"%CHANNELS={len(channels)}", "%"]
    for i, (s, (_, kind, axis, _)) in enumerate(zip(signals, channels)):
        text += [f"%[CURVE{i + 1}]", f"%CHANNELTYPE={kind}", f"%AXISTYPE={axis}", f"%DIMENSION={s.text}", f"%COUNT={rows}",
                 f"%CYCLETIME={cycle_us}", "%"]
    text.append("%[DATA]")
    body = table.rows([[str(us) for us in r.times_us]] + [table.cells(s) for s in signals])
    text += [";".join(row) + ";" for row in body]
    return Log(name + ".sco", FAMILY, ("\r\n".join(text) + "\r\n").encode("cp1252"), r.time_s, signals,
               options=["--every", f"{cycle_us / 1e6:g}s"], extra={"started_also": [r.start.isoformat()]})


def logs():
    yield sco("heidenhain_01_scope", [("speed", "v act.", "S1", "1/min"), ("current", "I int", "S1", "A")], 300, 3_000)
    yield sco("heidenhain_02_axes", [("pos_X", "s actual", "X", "mm"), ("pos_Y", "s actual", "Y", "mm"), ("feed", "v act.", "X", "mm/min")],
              240, 600)
    # The export: running number, time in us, then "quantity axis"
    r = Record("heidenhain_03_csv", 260, 3_000)
    number = [("Index", [str(i) for i in range(260)])]
    yield delimited("heidenhain_03_csv.csv", FAMILY, clock.counted(r, 1e6, 0, "t [µs]"),
                    [r.signal("pos_X", name="s actual X"), r.signal("pos_Y", name="s actual Y"),
                     r.signal("speed", unit="1/min", name="v act. S1")], separator=";", lead=number, encoding="cp1252")
    r = Record("heidenhain_04_german", 200, 9_000)
    yield delimited("heidenhain_04_german.csv", FAMILY, clock.counted(r, 1000, 0, "Zeit [ms]"),
                    [r.signal("speed", unit="1/min", name="n ist S1"), r.signal("load", name="Auslastung S1"),
                     r.signal("T_motor", name="Motortemperatur S1")], separator=";", decimal=",", encoding="cp1252")
    r = Record("heidenhain_05_seconds", 150, 21_000)
    yield delimited("heidenhain_05_seconds.txt", FAMILY, clock.counted(r, 1, 3, "Time"),
                    [r.signal("speed", unit="rpm", name="S act."), r.signal("torque", name="M act."),
                     r.signal("T_motor", name="T mot S1")], separator="\t", units_row=True, time_unit="s")
    r = Record("heidenhain_06_feed", 180, 3_000)
    yield delimited("heidenhain_06_feed.csv", FAMILY, clock.counted(r, 1e6, 0, "Time [us]"),
                    [r.signal("feed", unit="m/min", name="v nom. X"), r.signal("pos_Z", unit="mm", name="s actual Z")], separator=";")
    r = Record("heidenhain_07_blanks", 130, 3_000)
    yield delimited("heidenhain_07_blanks.asc", FAMILY, clock.counted(r, 1, 4, "t[s]"),
                    [r.signal("pos_X", name="s_act_X"), r.signal("speed", unit="1/min", name="v_act_S1")], separator="   ",
                    style="tight")
    r = Record("heidenhain_08_cycle_above", 140, 3_000)
    yield delimited("heidenhain_08_cycle_above.csv", FAMILY, no_times(140, 0.003),
                    [r.signal("pos_X", name="s actual X"), r.signal("pos_Y", name="s actual Y")], separator=";",
                    above="%CYCLETIME=3000 us\n%COUNT=140\n", options=["--every", "0.003s"], extra={"may_refuse": True})
