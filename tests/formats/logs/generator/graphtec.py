"""Graphtec GL loggers: settings above, "Number,Date&Time,ms,CH1", units below the heads, signs, +++++++ and BURNOUT."""

from datetime import datetime

import clock
from delimited import delimited
from record import Record

FAMILY = "graphtec"

JAPANESE = {"Vendor": "ベンダ", "Model": "モデル", "Version": "バージョン", "Sampling interval": "測定間隔", "Total data points": "測定点数",
            "Start time": "開始時刻", "End time": "終了時刻", "AMP settings": "アンプ設定", "Data": "測定値", "Number": "番号",
            "Date&Time": "日付/時間"}


def settings(record, signals, words=None, separator=",", model="GL840"):
    def say(text):
        return (words or {}).get(text, text)

    interval = record.interval_us
    text = f"{interval // 1_000_000}s" if interval >= 1_000_000 else f"{interval // 1000}ms"
    last = record.stamps[-1]
    table = [[say("Vendor"), '"GRAPHTEC Corporation"'], [say("Model"), f'"{model}"'], [say("Version"), '"Ver1.35  "'],
             [say("Sampling interval"), text], [say("Total data points"), f"{record.rows}        "],
             [say("Start time"), f"{record.start:%Y-%m-%d}", f"{record.start:%H:%M:%S}"],
             [say("End time"), f"{last:%Y-%m-%d}", f"{last:%H:%M:%S}"], [say("AMP settings")],
             ["CH", "Signal name", "Input", "Range", "Filter", "Span"]]
    for i, s in enumerate(signals):
        table.append([f"CH{i + 1}", f'"{s.source}"', "TEMP" if s.unit == "degC" else "DC", "TC_K" if s.unit == "degC" else "5V", "Off",
                      "+100.0", "-20.0"])
    table += [["Logic/Pulse", "Off"], [say("Data")]]
    return "".join(separator.join(row) + "\n" for row in table)


def gl(name, keys, rows, interval_us, *, units=None, words=None, missing=None, absent=(), separator=",", decimal=".", encoding="utf-8",
       split=False, sign="+ ", alarms=True, mark=b""):
    r = Record(name, rows, interval_us, datetime(2026, 4, 10, 14, 23, 55))
    signals = r.signals(keys, unit=units)
    above = settings(r, signals, words, separator)
    for row_column, lost in (missing or {}).items():
        signals[row_column].blank(lost)
    for i in absent:
        signals[i].blank(range(rows))
        signals[i].optional = True
    for i, s in enumerate(signals):
        s.source = f"CH{i + 1}"       # the heads of the rows; the names stand in the settings
    ms = [f"{u % 1_000_000 // 1000:03d}" for u in r.times_us]
    stamp = [f"{s:%Y/%m/%d %H:%M:%S}" for s in r.stamps]
    day, hour = [t[:10] for t in stamp], [t[11:] for t in stamp]
    heads = ["Date", "Time", "ms"] if split else [(words or {}).get("Date&Time", "Date&Time"), "ms"]
    times = clock.Times(heads, [day, hour, ms] if split else [stamp, ms], r.time_s, r.start.isoformat(), {})
    number = [((words or {}).get("Number", "Number"), [str(i + 1) for i in range(rows)])]
    behind = [("Alarm1-10", "LLLLLLLLLL"), ("AlarmOut", "LLLL")] if alarms else []

    def second_row(rows_of_text):
        rows_of_text[1][0] = "NO."
        rows_of_text[1][1] = "Time"
        rows_of_text[1][2 + split] = "ms"
        if alarms:
            rows_of_text[1][-2:] = ["A1234567890", "A1234"]

    return delimited(name + ".CSV", FAMILY, times, signals, separator=separator, decimal=decimal, above=above, lead=number, behind=behind,
                     units_row=True, edit=second_row, quote=False, sign=sign, encoding=encoding, mark=mark,
                     missing=lambda row: "BURNOUT" if row % 2 else "+++++++")


def logs():
    t = ["T_bearing_front", "T_bearing_rear", "T_motor", "T_column", "T_bed", "T_room", "T_coolant"]
    yield gl("graphtec_01_gl840", t, 200, 1_000_000, units="degC")
    yield gl("graphtec_02_burnout", t[:4], 150, 500_000, units="degC", missing={1: range(30, 48), 3: (5,)})
    yield gl("graphtec_03_japanese", t[:5], 120, 10_000_000, units="℃", words=JAPANESE, encoding="cp932")
    yield gl("graphtec_04_volts", ["voltage", "T_room"], 180, 200_000)
    yield gl("graphtec_05_open_channel", t[:3], 100, 1_000_000, units="degC", absent=(1,))
    yield gl("graphtec_06_semicolon", t[:3], 140, 2_000_000, units="degC", separator=";", decimal=",")
    yield gl("graphtec_07_date_apart", t[:6], 160, 100_000, units="degC", split=True, sign="+")
    yield gl("graphtec_08_tabs", t[:2] + ["voltage"], 130, 1_000_000, separator="\t", alarms=False, encoding="cp1252")
    yield gl("graphtec_09_fahrenheit", t[:2] + ["T_coolant"], 90, 5_000_000, units="degF", sign="+")
    # Saved again by a French spreadsheet: padded lines, ; and decimal comma, day first, seconds kept
    r = Record("graphtec_10_resaved", 110, 1_000_000, datetime(2026, 6, 14, 17, 1, 39))
    signals = r.signals(t[:3])
    above = settings(r, signals, None, ";").replace('"', "")
    above = "".join(line + ";" * (8 - line.count(";")) + "\n" for line in above.splitlines())
    for i, s in enumerate(signals):
        s.source = f"CH{i + 1}"
    days = [f"{s:%d/%m/%Y}" for s in r.stamps]
    times = clock.Times(["Date", "Time", "us"], [days, [f"{s:%H:%M:%S}" for s in r.stamps], ["0"] * 110], r.time_s, r.start.isoformat(), {})
    yield delimited("graphtec_10_resaved.csv", FAMILY, times, signals, separator=";", decimal=",", above=above, style="round",
                    lead=[("Number", [str(i + 1) for i in range(110)])], behind=[("Alarm", "LLLLLLLLLL"), ("AlarmOut", "LLLL")],
                    encoding="cp1252")
