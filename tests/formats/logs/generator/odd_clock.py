"""Rarer times: spoken halves of the day, points in clocks, weekdays, parts in columns of their own, gaps and jitter."""

from datetime import datetime, timedelta

import clock
from delimited import delimited
from record import Record

FAMILY = "odd_clock"
START = datetime(2026, 11, 22, 13, 5, 10)
US = 1_000_000
DAYS = "Mon Tue Wed Thu Fri Sat Sun".split()
TAGE = "Mo Di Mi Do Fr Sa So".split()


def form(name, text, *, head="Time", rows=60, interval_us=10 * US, start=START, keys=("T_bearing_front", "T_room"), dated=True, wall=None,
         language="en", times_us=None, extra=None, **more):
    """One column of stamps that `text` writes."""
    r = Record(name, rows, interval_us, start, times_us)
    times = clock.Times([head], [[text(s) for s in (wall(r) if wall else r.stamps)]], r.time_s, start.isoformat() if dated else None,
                        extra or {})
    more.setdefault("style", "round")
    return delimited(name + ".csv", FAMILY, times, r.signals(list(keys), language), **more)


def twelve(s):
    return f"{(s.hour + 11) % 12 + 1}:{s:%M:%S}"


def parts(name, heads, texts, rows=60, interval_us=10 * US, start=START):
    """The stamp in several columns."""
    r = Record(name, rows, interval_us, start)
    times = clock.Times(list(heads), [[t(s) for s in r.stamps] for t in texts], r.time_s, start.isoformat(), {})
    return delimited(name + ".csv", FAMILY, times, r.signals(["speed", "T_bearing_front"]), style="round")


def logs():
    yield form("oddtime_01_clock_two_days", lambda s: f"{s:%H:%M:%S}", rows=200, interval_us=900 * US, dated=False)
    yield form("oddtime_02_clock_winter", lambda s: f"{s:%H:%M:%S}", rows=150, interval_us=60 * US, start=datetime(2026, 10, 25, 1, 40),
               dated=False, wall=back_an_hour)
    yield form("oddtime_03_small_pm", lambda s: f"{s:%m/%d/%Y} {twelve(s)} {'am' if s.hour < 12 else 'pm'}")
    yield form("oddtime_04_spanish_pm", lambda s: f"{s:%d/%m/%Y} {twelve(s)} {'a. m.' if s.hour < 12 else 'p. m.'}", language="es", head="Fecha")
    yield form("oddtime_05_chinese_pm", lambda s: f"{s.year}/{s.month}/{s.day} {'上午' if s.hour < 12 else '下午'}{twelve(s)}", head="时间",
               language="zh", encoding="gbk", keys=("speed", "load"))
    yield form("oddtime_06_points", lambda s: f"{s:%d.%m.%Y %H.%M.%S}", head="Data", language="it", separator=";", decimal=",")
    yield form("oddtime_07_german_comma", lambda s: f"{s.day}.{s.month}.{s.year}, {s:%H:%M:%S}", head="Zeit", language="de")
    yield form("oddtime_08_us_comma", lambda s: f"{s.month}/{s.day}/{s.year}, {clock.ampm(s)}", head="time")
    yield form("oddtime_09_ctime", lambda s: f"{DAYS[s.weekday()]} {clock.EN[s.month - 1]} {s.day:2d} {s:%H:%M:%S} {s.year}", separator="\t")
    yield form("oddtime_10_mail", lambda s: f"{DAYS[s.weekday()]}, {s.day:02d} {clock.EN[s.month - 1]} {s.year} {s:%H:%M:%S} +0100")
    yield form("oddtime_11_weekday", lambda s: f"{TAGE[s.weekday()]} {s:%d.%m.%Y %H:%M:%S}", head="Zeit", language="de", separator=";", decimal=",")
    yield form("oddtime_12_file_name", lambda s: f"{s:%Y-%m-%d_%H-%M-%S}")
    yield form("oddtime_13_iso_comma", lambda s: f"{s:%Y-%m-%dT%H:%M:%S}" + clock.micro(s.microsecond, 3, ","), interval_us=250_000,
               separator=";", keys=("speed", "load"))
    yield parts("oddtime_14_digits", ("Date", "Time"), (lambda s: f"{s:%Y%m%d}", lambda s: f"{s:%H%M%S}"))
    yield parts("oddtime_15_six_columns", ("Year", "Month", "Day", "Hour", "Minute", "Second"),
                (lambda s: str(s.year), lambda s: str(s.month), lambda s: str(s.day), lambda s: str(s.hour), lambda s: str(s.minute),
                 lambda s: str(s.second)))
    us = [i * 10 * US + (7200 * US if i >= 30 else 0) for i in range(70)]
    yield form("oddtime_16_pause", lambda s: f"{s:%Y-%m-%d %H:%M:%S}", rows=70, times_us=us)
    jitter = Record("oddtime_17_jitter", 2, US).rng
    us = [i * US + jitter.randrange(0, 200) * 1000 for i in range(120)]
    us = [u - us[0] for u in us]
    yield form("oddtime_17_jitter", lambda s: f"{s:%Y-%m-%d %H:%M:%S}" + clock.micro(s.microsecond), rows=120, times_us=us, keys=("speed", "Z"))
    yield nanoseconds()
    yield since_1904()
    yield run("oddtime_20_minutes_seconds", 120, 60 * US, lambda s: f"{s // 60:02d}:{s % 60:02d}", "Time [mm:ss]")
    yield form("oddtime_21_hours_minutes", lambda s: f"{s:%H:%M}", head="Time [hh:mm]", interval_us=60 * US, rows=90, dated=False)
    yield run("oddtime_22_days_point", 120, 1800 * US, lambda s: (f"{s // 86400}." if s >= 86400 else "") +
              f"{s // 3600 % 24:02d}:{s // 60 % 60:02d}:{s % 60:02d}", "Elapsed")
    yield form("oddtime_23_a_day_a_row", lambda s: f"{s:%Y-%m-%d}", head="Date", interval_us=86400 * US, rows=45,
               start=datetime(2026, 9, 28), keys=("T_bed", "T_room", "Z"))
    yield uptime()
    # Days up to 12 first; the 13th decides for the American order
    yield form("oddtime_25_later_day_decides", lambda s: f"{s:%m/%d/%Y %H:%M:%S}", start=datetime(2026, 11, 12, 23, 50), interval_us=60 * US, rows=80)
    yield form("oddtime_26_zone_name", lambda s: f"{s:%Y-%m-%d %H:%M:%S} CET")
    yield minutes_only()
    yield beside_each_other()


def back_an_hour(record):
    return [s - timedelta(hours=1) if s >= datetime(2026, 10, 25, 3) else s for s in record.stamps]


def nanoseconds():
    r = Record("oddtime_18_epoch_ns", 80, 100_000, START)
    texts = [str(clock.since_epoch_us(s) * 1000) for s in r.stamps]
    return delimited(r.name + ".csv", FAMILY, clock.Times(["t_ns"], [texts], r.time_s, START.isoformat(), {}), r.signals(["speed", "load"]))


def since_1904():
    """LabVIEW counts the seconds from 1904; as a count since 1970 it would be in 2092. Only the differences are judged."""
    r = Record("oddtime_19_since_1904", 90, 500_000, START)
    texts = [f"{(s - datetime(1904, 1, 1)) / timedelta(seconds=1):.3f}" for s in r.stamps]
    times = clock.Times(["Time (s since 1904)"], [texts], r.time_s, None, {"started_also": [START.isoformat()]})
    return delimited(r.name + ".csv", FAMILY, times, r.signals(["T_bearing_front", "T_room"]))


def run(name, rows, interval_us, text, head):
    r = Record(name, rows, interval_us, START)
    times = clock.Times([head], [[text(us // US) for us in r.times_us]], r.time_s, None, {})
    return delimited(name + ".csv", FAMILY, times, r.signals(["T_bed", "T_room"]), style="round")


def uptime():
    """Seconds since the logger was switched on: they are kept."""
    r = Record("oddtime_24_uptime", 80, 500_000, START)
    seconds = [123_456.5 + t for t in r.time_s]
    times = clock.Times(["uptime [s]"], [[f"{t:.1f}" for t in seconds]], seconds, None, {})
    return delimited(r.name + ".csv", FAMILY, times, r.signals(["speed", "T_bearing_front"]))


def minutes_only():
    """German stamps without seconds: six rows a minute, spread evenly."""
    r = Record("oddtime_27_minutes_de", 90, 10 * US, datetime(2026, 11, 22, 9, 0))
    times = clock.Times(["Zeit"], [[f"{s:%d.%m.%Y %H:%M}" for s in r.stamps]], r.time_s, r.start.isoformat(), {})
    return delimited(r.name + ".csv", FAMILY, times, r.signals(["T_bed", "Z"], "de"), separator=";", decimal=",")


def beside_each_other():
    """A stamp and the seconds since the start: either is the time; the seconds may stay as a column."""
    r = Record("oddtime_28_stamp_and_seconds", 80, 10 * US, START)
    seconds = r.signal("X1", unit="", name="Elapsed", role=None)
    seconds.numbers, seconds.text, seconds.digits, seconds.optional = r.time_s, "s", 1, True
    log = delimited(r.name + ".csv", FAMILY, clock.absolute(r, "iso_blank"), [seconds] + r.signals(["T_bearing_front", "T_room"]))
    log.extra["started_also"] = [START.isoformat()]
    return log
