"""Keyence loggers (NR series with WAVE LOGGER): a block on the recording, a name and a unit a channel, ℃, date and time apart."""

from datetime import datetime

import clock
from delimited import delimited, no_times
from record import Record

FAMILY = "keyence"


def day(stamp):
    return f"{stamp:%Y/%m/%d}"


def block(record, japanese):
    words = (("ファイル名", "測定開始日時", "サンプリング周期", "データ数") if japanese
             else ("File name", "Start date and time", "Sampling cycle", "Number of data"))
    cycle = record.interval_us / 1000
    values = (record.name + ".nrd", f"{record.start:%Y/%m/%d %H:%M:%S}", f"{cycle / 1000:g}s" if cycle >= 1000 else f"{cycle:g}ms",
              str(record.rows))
    return "".join(f"{w},{v}\n" for w, v in zip(words, values))


TEMPERATURES = ["T_bearing_front", "T_bearing_rear", "T_motor", "T_column", "T_room", "T_coolant"]


def logs():
    start = datetime(2026, 7, 2, 8, 59, 30)
    also = {"started_also": [start.isoformat()]}
    r = Record("keyence_01_japanese", 200, 1_000_000, start)
    signals = [r.signal(k, "ja", unit="℃") for k in TEMPERATURES] + [r.signal(k, "ja", unit="μm") for k in ("X1", "Y1", "Z")]
    yield delimited("keyence_01_japanese.csv", FAMILY, clock.date_and_clock(r, day, "clock_ms", ("日付", "時刻")), signals,
                    units_row=True, mark=b"\xef\xbb\xbf", above=block(r, True) + "\n")
    # Shift-JIS has no U+00B5; the micro sign of Japanese keyboards is U+03BC
    r = Record("keyence_02_shift_jis", 150, 500_000, start)
    signals = [r.signal(k, "ja", unit="℃") for k in TEMPERATURES[:3]] + [r.signal("Z", "ja", unit="μm")]
    yield delimited("keyence_02_shift_jis.csv", FAMILY, clock.counted(r, 1, 1, "経過時間[s]"), signals, style="tight",
                    encoding="cp932", above=block(r, True), extra=also)
    r = Record("keyence_03_english", 180, 2_000_000, start)
    yield delimited("keyence_03_english.csv", FAMILY, clock.date_and_clock(r, day, "clock_ms"),
                    r.signals(["speed"] + TEMPERATURES + ["X1", "Y1"]), units_row=True, above=block(r, False) + "\n",
                    mark=b"\xef\xbb\xbf")
    r = Record("keyence_04_numbered", 160, 100_000, start)
    stamps = [f"{s:%Y/%m/%d %H:%M:%S}" + clock.micro(s.microsecond) for s in r.stamps]
    yield delimited("keyence_04_numbered.csv", FAMILY, clock.Times(["Date/Time"], [stamps], r.time_s, start.isoformat(), {}),
                    r.signals(["T_motor", "T_room", "voltage"]), style="round", above=block(r, False),
                    lead=[("No.", [str(i + 1) for i in range(160)])])
    r = Record("keyence_05_over", 140, 1_000_000, start)
    signals = r.signals(["T_bearing_front", "T_column", "X1"])
    signals[0].blank(range(20, 26))
    signals[2].blank((3, 99))
    yield delimited("keyence_05_over.csv", FAMILY, clock.date_and_clock(r, day, "clock"), signals, units_row=True,
                    missing=lambda row: "+OVER" if row % 2 else "-OVER", above=block(r, False))
    r = Record("keyence_06_cycle_above", 120, 200_000, start)
    yield delimited("keyence_06_cycle_above.csv", FAMILY, no_times(120, 0.2), r.signals(["X1", "X2", "Y1", "Y2", "Z"], unit="um"),
                    style="round", above=block(r, False), lead=[("No.", [str(i + 1) for i in range(120)])],
                    options=["--every", "0.2s"], extra=also)
    r = Record("keyence_07_full_width", 100, 1_000_000, start)
    signals = [r.signal("speed", "ja", unit="min⁻¹"), r.signal("T_bearing_front", "ja", unit="℃"), r.signal("Z", "ja", unit="㎛")]
    yield delimited("keyence_07_full_width.csv", FAMILY, clock.date_and_clock(r, day, "clock", ("日付", "時間")), signals,
                    style="tight", mark=b"\xef\xbb\xbf")
    r = Record("keyence_08_tabs", 130, 10_000_000, start)
    yield delimited("keyence_08_tabs.txt", FAMILY, clock.absolute(r, "year_slash", "Time"),
                    r.signals(TEMPERATURES + ["Z"]), separator="\t",
                    behind=[("Mark", ["cut" if i == 40 else "" for i in range(130)])])
