"""Tables that people type or put together: every way to write a time, in seven languages."""

from datetime import datetime, timedelta

import clock
from delimited import delimited
from record import Record

FAMILY = "people_times"
START = datetime(2026, 11, 22, 13, 5, 10)
US = 1_000_000

KEYS = (["speed", "T_bearing_front", "T_room"], ["load", "T_motor", "Z"], ["T_bed", "T_column", "X1", "Y1"], ["speed", "load", "T_coolant"],
        ["T_bearing_front", "T_bearing_rear", "T_room", "Z"], ["T_housing"])

# style, language, separator, decimal sign, head, encoding
ABSOLUTE = (
    ("iso", "en", ",", ".", "Time", "utf-8"), ("iso_blank", "de", ";", ",", "Zeitstempel", "utf-8"), ("iso_ms", "en", "\t", ".", "time", "utf-8"),
    ("iso_zone", "en", ",", ".", "Timestamp", "utf-8"), ("iso_z", "it", ";", ".", "Data", "utf-8"), ("dots", "de", ";", ",", "Datum/Zeit", "cp1252"),
    ("dots_short", "de", "\t", ",", "Zeit", "utf-8"), ("dots_ms", "de", ";", ",", "Zeit", "utf-8"), ("day_slash", "es", ";", ",", "Fecha", "utf-8"),
    ("month_slash", "en", ",", ".", "Date/Time", "utf-8"), ("month_ampm", "en", "\t", ".", "Date", "utf-8"),
    ("year_slash", "ja", ",", ".", "日時", "utf-8"), ("kanji", "ja", ",", ".", "測定日時", "utf-8"), ("kanji", "zh", ",", ".", "时间", "gbk"),
    ("compact_t", "en", ";", ".", "stamp", "utf-8"), ("mon_en", "en", ",", ".", "Date", "utf-8"), ("mon_de", "de", ";", ",", "Datum", "cp1252"),
    ("mon_de_dots", "de", ";", ",", "Datum", "utf-8"), ("mon_fr", "fr", ";", ",", "Date", "utf-8"), ("mon_fr_blank", "fr", ";", ",", "Date", "cp1252"),
    ("mon_it", "it", ";", ",", "Data", "utf-8"), ("mon_es", "es", ";", ",", "Fecha y hora", "utf-8"),
)
# Months whose names tell the language apart
MONTH = {"mon_de": 12, "mon_de_dots": 10, "mon_fr": 8, "mon_fr_blank": 2, "mon_it": 5, "mon_es": 1, "mon_en": 3}


def named_months():
    for i, (style, language, separator, decimal, head, encoding) in enumerate(ABSOLUTE):
        name = f"times_{i + 1:02d}_{style}_{language}"
        start = START.replace(month=MONTH.get(style, 11))
        r = Record(name, 60 + 7 * i, 500_000 if style in ("iso_ms", "dots_ms") else 10 * US, start)
        unit = {"fr": "tr/min", "it": "giri/min", "de": "1/min", "ja": "min-1", "zh": "rpm"}.get(language, "rpm")
        signals = [r.signal(k, language, unit=unit if k == "speed" else "℃" if k[:2] == "T_" and language in ("zh", "ja") else
                            "um" if encoding == "gbk" and k in ("X1", "Y1", "Z") else None) for k in KEYS[i % len(KEYS)]]
        yield delimited(name + ".csv", FAMILY, clock.absolute(r, style, head), signals, separator=separator, decimal=decimal,
                        encoding=encoding, style=("brackets", "round", "slash", "comma", "in")[i % 5] if separator != "," else "round")


def logs():
    yield from named_months()

    def out(name, rows, interval_us, keys, times, language="en", start=START, **more):
        r = Record(name, rows, interval_us, start)
        more.setdefault("style", "round")
        return delimited(name + ".csv", FAMILY, times(r), r.signals(keys, language), **more)

    de = {"separator": ";", "decimal": ","}
    yield out("clock_01_midnight", 120, 30 * US, ["T_bearing_front", "T_room"], lambda r: clock.clock(r, "clock"),
              start=START.replace(hour=23, minute=30))
    yield out("clock_02_comma_ms", 90, 250_000, ["speed", "load"], lambda r: clock.clock(r, "clock_ms_comma", "Uhrzeit"), "de", **de)
    yield out("clock_03_ampm_noon", 100, 60 * US, ["T_bed", "Z"], lambda r: clock.clock(r, "clock_ampm"), start=START.replace(hour=11, minute=10))
    yield out("clock_04_ampm_midnight", 100, 60 * US, ["T_column", "T_room"], lambda r: clock.clock(r, "clock_ampm", "Time of day"),
              start=START.replace(hour=23, minute=20))
    yield out("clock_05_columns", 80, 20 * US, ["speed", "T_motor"], lambda r: clock.date_and_clock(r, lambda s: f"{s:%d.%m.%Y}", "clock",
                                                                                                 ("Datum", "Uhrzeit")), "de", **de)
    yield out("clock_06_columns_us", 80, 20 * US, ["speed", "T_motor"], lambda r: clock.date_and_clock(r, lambda s: f"{s:%m/%d/%Y}", "clock_ampm"))
    yield out("elapsed_01_tenths", 150, 100_000, ["speed", "torque"], lambda r: clock.run(r, "ms", "Elapsed (mm:ss.f)"))
    yield out("elapsed_02_over_a_day", 130, 900 * US, ["T_bed", "T_room", "Z"], lambda r: clock.run(r, "hms", "Elapsed"))
    yield out("elapsed_03_laufzeit", 100, 15 * US, ["T_bearing_front"], lambda r: clock.run(r, "hms_ms", "Laufzeit"), "de", separator=";")
    yield out("elapsed_04_from_26_15", 60, 60 * US, ["T_column", "T_bed"], lambda r: clock.run(r, "hms", "Run time", 94_500 * US))
    yield out("count_01_min", 120, 30 * US, ["T_bearing_front", "Z"], lambda r: clock.counted(r, 1 / 60, 1, "t [min]"), style="brackets")
    yield out("count_02_min_de", 110, 6 * US, ["speed", "X1"], lambda r: clock.counted(r, 1 / 60, 1, "Zeit in min", ","), "de", style="in", **de)
    yield out("count_03_hours", 100, 36 * US, ["T_bed", "T_room"], lambda r: clock.counted(r, 1 / 3600, 2, "Time (h)"))
    yield out("count_04_hours_fr", 100, 360 * US, ["T_bed", "T_column"], lambda r: clock.counted(r, 1 / 3600, 1, "Temps [h]", ","), "fr",
              separator=";", decimal=",")
    yield out("count_05_ms", 140, 20_000, ["speed", "current"], lambda r: clock.counted(r, 1000, 0, "Time [ms]"), style="brackets")
    yield out("count_06_s_from_half", 90, 500_000, ["speed", "load"], lambda r: shifted(clock.counted(r, 1, 1, "t / s"), 0.5), style="slash")
    yield out("count_07_days", 80, 8640 * US, ["T_bed", "T_room"], lambda r: clock.counted(r, 1 / 86400, 1, "Time [d]"))
    yield out("epoch_01_s", 100, 5 * US, ["T_motor", "Z"], lambda r: clock.epoch(r, 0))
    yield out("epoch_02_s_fraction", 100, 250_000, ["speed"], lambda r: clock.epoch(r, 0, "time", 3))
    yield out("epoch_03_ms", 100, 100_000, ["speed", "load"], lambda r: clock.epoch(r, 3, "ts_ms"))
    yield out("epoch_04_us", 100, 1_000, ["voltage"], lambda r: clock.epoch(r, 6, "t_us"))
    yield out("serial_01", 100, 10 * US, ["T_bearing_front", "T_room"], lambda r: clock.excel_serial(r, "Date"))
    yield out("serial_02_de", 100, 60 * US, ["T_bed", "Z"], lambda r: clock.excel_serial(r, "Zeit", 9, ","), "de", **de)
    # Whole seconds, four rows in each; and three or four by turns
    yield out("repeated_01_four", 160, 250_000, ["speed", "T_motor"], lambda r: clock.absolute(r, "iso_blank"))
    yield uneven("repeated_02_three_or_four")
    # Winter time: the clock runs back an hour at 03:00 of 25 October 2026; summer time: an hour is skipped on 29 March
    yield out("winter_01_dots", 180, 60 * US, ["T_bed", "T_room"], lambda r: clock.absolute(r, "dots", "Zeit", winter(r)), "de",
              datetime(2026, 10, 25, 1, 30), **de)
    yield out("winter_02_clock_iso", 150, 120 * US, ["T_column", "Z"], lambda r: clock.absolute(r, "iso", "Time", winter(r)), "en",
              datetime(2026, 10, 25, 0, 50))
    yield summer("summer_01_dots")


def shifted(times, by):
    times.time_s = [t + by for t in times.time_s]
    times.columns = [[f"{t:.1f}" for t in times.time_s]]
    return times


def uneven(name):
    counts = [3 if i % 3 == 0 else 4 for i in range(40)]
    us = [i * US + j * US // n for i, n in enumerate(counts) for j in range(n)]
    r = Record(name, len(us), 285_714, START, us)
    times = clock.absolute(r, "day_slash", "Date")
    times.time_s = [i + j / n for i, n in enumerate(counts) for j in range(n)]
    return delimited(name + ".csv", FAMILY, times, r.signals(["T_bearing_front", "X1"]), style="round")


def winter(record):
    return [s - timedelta(hours=1) if s >= datetime(2026, 10, 25, 3) else s for s in record.stamps]


def summer(name):
    """The wall's clock skips an hour. Whether that is told from a pause is open: both times are taken for right."""
    r = Record(name, 120, 60 * US, datetime(2026, 3, 29, 1, 10))
    late = [s >= datetime(2026, 3, 29, 2) for s in r.stamps]
    wall = [s + timedelta(hours=1) if after else s for s, after in zip(r.stamps, late)]
    times = clock.absolute(r, "dots", "Zeit", wall)
    times.extra["time_s_also"] = [[t + 3600 * after for t, after in zip(r.time_s, late)]]
    return delimited(name + ".csv", FAMILY, times, r.signals(["T_bed", "T_room"], "de"), separator=";", decimal=",", encoding="cp1252")
