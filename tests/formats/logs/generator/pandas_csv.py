"""DataFrame.to_csv: an index without a head, ISO stamps with and without a zone, empty for NaN, all digits of a float."""

from datetime import datetime

import clock
from delimited import delimited, no_times
from record import Record

FAMILY = "pandas"
START = datetime(2026, 11, 22, 13, 5, 10)


def floats(signals):
    """Numbers as Python prints them."""
    return {i: ["" if n is None else repr(n) for n in s.numbers] for i, s in enumerate(signals)}


def full(record, keys, names=None, unit=None):
    signals = record.signals(keys, unit=unit, digits=15)
    for s, name in zip(signals, names or []):
        s.source = name
    return signals


def stamped(record, zone="", head=""):
    micro = any(us % 1_000_000 for us in record.times_us)
    texts = [f"{s:%Y-%m-%d %H:%M:%S}" + (clock.micro(s.microsecond, 6) if micro else "") + zone for s in record.stamps]
    return clock.Times([head], [texts], record.time_s, record.start.isoformat(), {})


def numbered(rows):
    return [("", [str(i) for i in range(rows)])]


def logs():
    def out(name, times, signals, **more):
        return delimited(name + ".csv", FAMILY, times, signals, show=floats(signals), end="\n", **more)

    r = Record("pandas_01_index", 150, 1_000_000, START)
    s = full(r, ["speed", "T_bearing_front", "Z"], ["speed", "T_front", "z"])
    yield out(r.name, stamped(r, head="timestamp"), s, style="underscore", lead=numbered(150))
    r = Record("pandas_02_time_index", 200, 500_000, START)
    yield out(r.name, stamped(r), full(r, ["T_bearing_front", "T_room", "X1", "Y1"]), style="round")
    r = Record("pandas_03_zone", 120, 1_000_000, START)
    s = full(r, ["load", "T_motor"])
    s[1].blank((5, 6, 7, 60))
    yield out(r.name, stamped(r, "+01:00", "time"), s)
    r = Record("pandas_04_semicolon", 100, 10_000_000, START)
    yield out(r.name, stamped(r, head="ts"), full(r, ["T_bed", "T_column", "T_room"]), style="round", separator=";")
    r = Record("pandas_05_german", 100, 10_000_000, START)
    s = r.signals(["speed", "T_bearing_front"], "de")
    show = {i: [repr(n).replace(".", ",") for n in c.numbers] for i, c in enumerate(s)}
    yield delimited(r.name + ".csv", FAMILY, stamped(r, head="Zeit"), s, separator=";", decimal=",", show=show, end="\n")
    r = Record("pandas_06_seconds", 140, 20_000, START)
    s = full(r, ["voltage", "current"])
    yield out(r.name, clock.counted(r, 1, 2, "time_s"), s, style="underscore", lead=numbered(140))
    r = Record("pandas_07_epoch", 130, 1_000_000, START)
    yield out(r.name, clock.epoch(r, 0, "epoch"), full(r, ["T_bearing_front", "T_coolant"]))
    r = Record("pandas_08_epoch_ms", 130, 250_000, START)
    yield out(r.name, clock.epoch(r, 3, "timestamp_ms"), full(r, ["speed", "Z"]))
    r = Record("pandas_09_timedelta", 110, 30_000_000, START)
    texts = [f"{us // 86_400_000_000} days {us // 3_600_000_000 % 24:02d}:{us // 60_000_000 % 60:02d}:{us // 1_000_000 % 60:02d}"
             for us in r.times_us]
    yield out(r.name, clock.Times(["elapsed"], [texts], r.time_s, None, {}), full(r, ["T_head", "T_oil"]))
    r = Record("pandas_10_no_time", 90, 1_000, START)
    s = full(r, ["voltage", "speed"], unit="")
    yield out(r.name, no_times(90, 0.001), s, lead=numbered(90), expect="needs", options=["--every", "0.001s"],
              why="the only other column is the number of the row")
    r = Record("pandas_11_exponents", 80, 1_000_000, START)
    s = full(r, ["X1", "voltage"])
    s[0].numbers = [n * 1e-7 for n in s[0].numbers]
    yield out(r.name, stamped(r, "+00:00", "time"), s)
