"""PicoLog 6: no head over the time, "NAME Ave. (C)"; PicoLog 5: names, then units, time in s or a stamp."""

from datetime import datetime, timedelta

import clock
from delimited import delimited
from record import Record

FAMILY = "picolog"


def averages(signals, what="Ave."):
    for s in signals:
        s.source = f"{s.source} {what}"
    return signals


def zoned(record, change_row=None, before="+02:00", after="+01:00"):
    """ISO with the zone; from `change_row` on an hour earlier on the wall, and in the other zone."""
    rows = range(record.rows)
    late = [change_row is not None and i >= change_row for i in rows]
    wall = [s - timedelta(hours=1) if late[i] else s for i, s in zip(rows, record.stamps)]
    texts = [f"{s:%Y-%m-%dT%H:%M:%S}" + (after if late[i] else before) for i, s in zip(rows, wall)]
    return clock.Times([""], [texts], record.time_s, record.start.isoformat(), {})


def logs():
    start = datetime(2026, 10, 14, 13, 5, 10)
    r = Record("picolog_01_zone", 200, 1_000_000, start)
    yield delimited("picolog_01_zone.csv", FAMILY, zoned(r), averages(r.signals(["T_bearing_front", "T_room", "T_coolant"], unit="C")),
                    style="round", end="\n")
    r = Record("picolog_02_elapsed", 180, 10_000_000, start)
    times = clock.run(r, "hms", "")
    yield delimited("picolog_02_elapsed.csv", FAMILY, times, averages(r.signals(["T_bearing_front", "T_motor"], unit="C")), style="round",
                    end="\n")
    # The night of 25 October 2026 to winter time: 03:00 becomes 02:00, and the zone says so
    r = Record("picolog_03_winter_time", 240, 60_000_000, datetime(2026, 10, 25, 1, 0, 0))
    yield delimited("picolog_03_winter_time.csv", FAMILY, zoned(r, 120), averages(r.signals(["T_bed", "T_column", "T_room"], unit="°C"),
                                                                                 "Last"), style="round", end="\n")
    r = Record("picolog_04_gaps", 150, 5_000_000, start)
    signals = averages(r.signals(["T_bearing_front", "T_bearing_rear", "T_room"], unit="C"))
    signals[1].blank(list(range(40, 55)) + [88])
    yield delimited("picolog_04_gaps.csv", FAMILY, zoned(r), signals, style="round", missing="", end="\n")
    # Units in a row of their own, above them the names
    r = Record("picolog_05_seconds", 130, 1_000_000, start)
    yield delimited("picolog_05_seconds.txt", FAMILY, clock.counted(r, 1, 0, "Time"), r.signals(["T_bearing_front", "T_housing", "T_room"]),
                    separator="\t", units_row=True, time_unit="Seconds", encoding="cp1252")
    r = Record("picolog_06_stamps", 120, 30_000_000, start)
    yield delimited("picolog_06_stamps.txt", FAMILY, clock.absolute(r, "day_slash"), r.signals(["T_head", "T_coolant"], "fr"),
                    separator="\t", decimal=",", units_row=True, encoding="cp1252")
    r = Record("picolog_07_fahrenheit", 110, 2_000_000, start)
    yield delimited("picolog_07_fahrenheit.csv", FAMILY, zoned(r, None, "-04:00"),
                    averages(r.signals(["T_bearing_front", "T_room", "T_oil"], unit="°F")), style="round", end="\n")
    r = Record("picolog_08_quoted", 100, 1_000_000, start)

    def quote(rows):
        for row in rows:
            row[:] = [f'"{cell}"' for cell in row]

    yield delimited("picolog_08_quoted.csv", FAMILY, zoned(r, None, "+00:00"), averages(r.signals(["T_motor", "voltage"])), style="round",
                    quote=False, edit=quote, mark=b"\xef\xbb\xbf")
    r = Record("picolog_09_millivolts", 160, 100_000, start)
    times = clock.Times([""], [[f"{s:%Y-%m-%dT%H:%M:%S}" + clock.micro(s.microsecond) + "+01:00" for s in r.stamps]], r.time_s,
                        r.start.isoformat(), {})
    yield delimited("picolog_09_millivolts.csv", FAMILY, times, averages(r.signals(["voltage"], unit="mV")) + averages(
        r.signals(["T_housing"], unit="C")), style="round", end="\n")
