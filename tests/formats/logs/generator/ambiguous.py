"""Files that cannot be read without a word more: two readings are possible, or nothing tells the time."""

from datetime import datetime

import clock
from delimited import delimited, no_times
from record import Log, Record

FAMILY = "ambiguous"
US = 1_000_000


def dates(name, start, form, head, option, language="en", rows=60, interval_us=10 * US, **more):
    r = Record(name, rows, interval_us, start)
    times = clock.Times([head], [[form(s) for s in r.stamps]], r.time_s, start.isoformat(), {})
    signals = r.signals(["T_bearing_front", "T_room", "Z"], language)
    first = times.columns[0][0]
    return delimited(name + ".csv", FAMILY, times, signals, expect="refuse", options=["--dates", option], style="round",
                     why=f"{first}: no row decides which is the day", **more)


def without(name, keys, every, rows=80, **more):
    r = Record(name, rows, int(every * US))
    signals = r.signals(keys, unit=more.pop("unit", None))
    return delimited(name + more.pop("ending", ".csv"), FAMILY, no_times(rows, every), signals, expect="needs",
                     why="there is no time and no rate", options=["--every", f"{every:g}s"], **more)


def logs():
    yield dates("dates_01_day_first", datetime(2026, 4, 3, 9, 0), lambda s: f"{s:%d/%m/%Y %H:%M:%S}", "Time", "day-first")
    yield dates("dates_02_month_first", datetime(2026, 3, 4, 9, 0), lambda s: f"{s:%m/%d/%Y %H:%M:%S}", "Time", "month-first")
    yield dates("dates_03_loose_ampm", datetime(2026, 6, 7, 15, 0), lambda s: f"{s.month}/{s.day}/{s.year} {clock.ampm(s)}", "Date", "month-first")
    yield dates("dates_04_dashes", datetime(2026, 5, 2, 8, 0), lambda s: f"{s:%d-%m-%Y %H:%M:%S}", "Date", "day-first")
    yield dates("dates_05_two_digits", datetime(2026, 10, 5, 8, 0), lambda s: f"{s:%d/%m/%y %H:%M:%S}", "Time", "day-first")
    yield same_both_ways()
    r = Record("dates_07_in_two_columns", 90, 10 * US, datetime(2026, 4, 3, 9, 0))
    yield delimited("dates_07_in_two_columns.csv", FAMILY, clock.date_and_clock(r, lambda s: f"{s:%d/%m/%Y}", "clock"),
                    r.signals(["speed", "T_room"]), style="round", expect="refuse", why="03/04/2026: no row decides which is the day",
                    options=["--dates", "day-first"])
    # Decimal commas and Italian words: read as day first, or refused
    r = Record("dates_08_italian", 70, 10 * US, datetime(2026, 4, 3, 9, 0))
    yield delimited("dates_08_italian.csv", FAMILY, clock.absolute(r, "day_slash", "Data e ora"), r.signals(["T_bearing_front", "T_room"], "it"),
                    separator=";", decimal=",", options=["--dates", "day-first"], extra={"may_refuse": True})
    # Over midnight the day goes on by one: 03/04 to 04/04 at an even interval is April
    r = Record("dates_09_midnight_decides", 90, 60 * US, datetime(2026, 4, 3, 23, 20))
    yield delimited("dates_09_midnight_decides.csv", FAMILY, clock.absolute(r, "day_slash"), r.signals(["T_bed", "T_room"]), style="round",
                    options=["--dates", "day-first"], extra={"may_refuse": True})
    yield without("no_time_01_columns", ["speed", "T_bearing_front", "Z"], 1)
    yield without("no_time_02_numbers_alone", ["voltage", "current"], 0.001, unit="", heads=False, separator=" ", ending=".txt")
    yield without("no_time_03_running_number", ["T_bearing_front", "T_room"], 10, lead=[("Nr", [str(i + 1) for i in range(80)])], separator=";",
                  decimal=",")
    yield without("no_time_04_date_above", ["speed", "load"], 0.5, above="Date: 22.11.2026\nMachine: M7\n\n", style="round")
    yield Log("nothing_01_heads_alone.csv", FAMILY, "Time,Speed [rpm],T1 [°C]\r\n".encode(), [], [], expect="refuse", why="there are no rows")
    yield Log("nothing_02_prose.txt", FAMILY, "We ran the machine for two hours.\nThe spindle got warm.\n".encode(), [], [], expect="refuse",
              why="there is no table")


def same_both_ways():
    """5 May: day and month are the same, so that both readings agree."""
    r = Record("dates_06_same_both_ways", 60, 10 * US, datetime(2026, 5, 5, 8, 0))
    return delimited("dates_06_same_both_ways.csv", FAMILY, clock.absolute(r, "day_slash"), r.signals(["T_bed", "T_room"]), style="round",
                     options=["--dates", "day-first"], extra={"may_refuse": True})
