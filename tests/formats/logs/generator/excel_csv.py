"""A workbook saved as CSV: en-US, de-DE, fr-FR, it-IT, zh-CN, ja-JP; ANSI pages, UTF-8 with its mark, Unicode text."""

from datetime import datetime, timedelta

import clock
from delimited import delimited
from record import Record

FAMILY = "excel_csv"
START = datetime(2026, 11, 22, 13, 5, 10)
BOM8, BOM16 = b"\xef\xbb\xbf", b"\xff\xfe"
TEMPERATURES = ["T_bearing_front", "T_bearing_rear", "T_column", "T_bed", "T_room", "T_coolant"]


def minutes(record):
    """The default format of a date and time shows no seconds: what is told is the minute; its rows are spread evenly."""
    texts = [f"{s.month}/{s.day}/{s.year} {s.hour}:{s:%M}" for s in record.stamps]
    return clock.Times(["Time"], [texts], record.time_s, record.start.isoformat(), {})


def logs():
    r = Record("excel_us_01", 150, 10_000_000, START)
    yield delimited("excel_us_01.csv", FAMILY, clock.absolute(r, "month_loose"), r.signals(["speed", "load"] + TEMPERATURES), style="round",
                    encoding="cp1252")
    r = Record("excel_us_02_ampm", 120, 30_000_000, datetime(2026, 11, 22, 11, 20, 0))
    signals = r.signals(["speed", "power", "T_bearing_front"])
    yield delimited("excel_us_02_ampm.csv", FAMILY, clock.absolute(r, "month_ampm"), signals, thousands=",", style="round",
                    mark=BOM8)
    r = Record("excel_us_03_minutes", 120, 10_000_000, datetime(2026, 11, 22, 9, 0, 0))
    yield delimited("excel_us_03_minutes.csv", FAMILY, minutes(r), r.signals(["T_room", "T_bed", "X1"]), style="round", encoding="cp1252")
    r = Record("excel_us_04_errors", 90, 60_000_000, START)
    signals = r.signals(["T_motor", "T_room", "X1"])
    signals[0].blank((4, 5, 6))
    signals[2].blank((17,))
    yield delimited("excel_us_04_errors.csv", FAMILY, clock.absolute(r, "month_loose"), signals,
                    missing=lambda row: ("#N/A", "#DIV/0!", "########", "#VALUE!")[row % 4], encoding="cp1252")
    r = Record("excel_de_01", 200, 10_000_000, START)
    yield delimited("excel_de_01.csv", FAMILY, clock.absolute(r, "dots", "Zeit"), r.signals(["speed", "load"] + TEMPERATURES + ["X1", "Y1", "Z"], "de"),
                    separator=";", decimal=",", encoding="cp1252")
    r = Record("excel_de_02_thousands", 140, 5_000_000, START)
    signals = [r.signal("speed", "de", unit="U/min", digits=1), r.signal("power", "de", unit="W", digits=1), r.signal("T_room", "de")]
    yield delimited("excel_de_02_thousands.csv", FAMILY, clock.absolute(r, "dots", "Datum"), signals, separator=";", decimal=",",
                    thousands=".", encoding="cp1252")
    r = Record("excel_de_03_nv", 80, 60_000_000, START)
    signals = r.signals(["T_bearing_front", "T_coolant", "Z"], "de")
    signals[1].blank((0, 30, 31))
    yield delimited("excel_de_03_nv.csv", FAMILY, clock.date_and_clock(r, lambda s: f"{s:%d.%m.%Y}", "clock", ("Datum", "Uhrzeit")), signals,
                    separator=";", decimal=",", missing="#NV", mark=BOM8)
    r = Record("excel_fr_01", 160, 15_000_000, START)
    yield delimited("excel_fr_01.csv", FAMILY, clock.absolute(r, "day_slash", "Horodatage"), r.signals(["speed"] + TEMPERATURES, "fr"),
                    separator=";", decimal=",", encoding="cp1252", style="round")
    r = Record("excel_fr_02_thousands", 100, 20_000_000, START)
    signals = [r.signal("speed", "fr", unit="tr/min", digits=0), r.signal("T_bearing_front", "fr", digits=1), r.signal("load", "fr")]
    yield delimited("excel_fr_02_thousands.csv", FAMILY, clock.absolute(r, "day_slash", "Date et heure"), signals, separator=";", decimal=",",
                    thousands="\xa0", encoding="cp1252")
    r = Record("excel_fr_03_narrow_blank", 90, 20_000_000, START)
    signals = [r.signal("speed", "fr", unit="tr/min", digits=1), r.signal("power", "fr", unit="W", digits=1)]
    yield delimited("excel_fr_03_narrow_blank.csv", FAMILY, clock.absolute(r, "day_slash", "Date"), signals, separator=";", decimal=",",
                    thousands="\u202f", mark=BOM8)
    r = Record("excel_it_01", 110, 10_000_000, START)
    yield delimited("excel_it_01.csv", FAMILY, clock.absolute(r, "day_slash", "Data e ora"),
                    [r.signal("speed", "it", unit="giri/min")] + r.signals(["load", "T_bearing_front", "T_room", "Z"], "it"), separator=";",
                    decimal=",", encoding="cp1252")
    r = Record("excel_cn_01_gbk", 130, 10_000_000, START)
    yield delimited("excel_cn_01_gbk.csv", FAMILY, clock.absolute(r, "year_slash_loose", "时间"),
                    [r.signal("speed", "zh", unit="转/分")] + [r.signal(k, "zh", unit="℃") for k in TEMPERATURES], style="round", encoding="gbk")
    r = Record("excel_cn_02_utf8", 90, 10_000_000, START)
    yield delimited("excel_cn_02_utf8.csv", FAMILY, clock.absolute(r, "year_slash_loose", "采集时间"),
                    [r.signal("load", "zh")] + [r.signal(k, "zh", unit="μm") for k in ("X1", "Y1", "Z")], mark=BOM8)
    r = Record("excel_jp_01_shift_jis", 140, 10_000_000, START)
    yield delimited("excel_jp_01_shift_jis.csv", FAMILY, clock.absolute(r, "year_slash_loose", "日時"),
                    [r.signal("speed", "ja", unit="min-1")] + [r.signal(k, "ja", unit="℃") for k in TEMPERATURES[:4]], encoding="cp932")
    r = Record("excel_unicode_text", 120, 10_000_000, START)
    yield delimited("excel_unicode_text.txt", FAMILY, clock.absolute(r, "dots", "Zeit"), r.signals(["speed", "T_room", "Z"], "de"), separator="\t",
                    decimal=",", encoding="utf-16-le", mark=BOM16)
    r = Record("excel_unicode_chinese", 80, 10_000_000, START)
    yield delimited("excel_unicode_chinese.txt", FAMILY, clock.absolute(r, "year_slash", "时间"),
                    r.signals(["speed", "T_bearing_front", "T_coolant"], "zh"), separator="\t", style="round", encoding="utf-16-le", mark=BOM16)
    r = Record("excel_big_endian", 60, 10_000_000, START)
    yield delimited("excel_big_endian.txt", FAMILY, clock.absolute(r, "iso_blank"), r.signals(["T_bed", "T_room"]), separator="\t",
                    encoding="utf-16-be", mark=b"\xfe\xff")
    # "sep=;" in the first line, as people write it for Excel
    r = Record("excel_sep_line", 70, timedelta(seconds=10) // timedelta(microseconds=1), START)
    yield delimited("excel_sep_line.csv", FAMILY, clock.absolute(r, "dots", "Zeit"), r.signals(["speed", "T_bearing_front"], "de"),
                    separator=";", decimal=",", above="sep=;\n", encoding="cp1252")
