"""QuantumX recordings that catman wrote as ASCII: a block about the file, a block a channel, then tabs."""

from datetime import datetime

import clock
from delimited import delimited
from record import Record

FAMILY = "catman"

TEMPERATURES = ["T_bearing_front", "T_bearing_rear", "T_motor", "T_housing", "T_head", "T_column", "T_bed", "T_room", "T_coolant"]


def block(record, signals, language, decimal):
    """Above the rows: seven lines on the file, an empty one, lines on the channels, an empty one."""
    de = language == "de"
    count = len(signals) + 1
    rate = f"{1e6 / record.interval_us:g}".replace(".", decimal)
    date = f"{record.start:%d.%m.%Y}" if de else f"{record.start.month}/{record.start.day}/{record.start.year}"
    lines = [f"HBM catman {'Datei' if de else 'file'}: D:\\Data\\{record.name}.BIN", f"{'Bediener' if de else 'Operator'}: Lab 2",
             f"{'Abteilung' if de else 'Department'}: ", f"{'Kommentar' if de else 'Comment'}: ",
             f"{'Datum' if de else 'Date'}: {date} {record.start:%H:%M:%S}", f"{'Anzahl Kanäle' if de else 'Channels'}: {count}",
             f"{'Länge' if de else 'Length'}:  {record.rows}", ""]
    time = "Zeit  1 - Standardmessrate" if de else "Time  1 - default sample rate"
    lines.append("\t".join([time] + [s.source for s in signals]))
    lines.append("\t".join(["s"] + [s.text for s in signals]))
    lines.append("\t".join([f"SR={rate} Hz"] * count))
    lines.append("\t".join(["---"] + [f"MX1609KB CH {i + 1}" for i in range(len(signals))]))
    lines.append("\t".join(["---"] + ["Typ K" if s.unit == "degC" and de else "Type K" if s.unit == "degC" else "SG bridge"
                                      for s in signals]))
    return "\n".join(lines) + "\n\n"


def with_blocks(name, language, decimal, keys, rows, interval_us, encoding="cp1252", missing=None):
    r = Record(name, rows, interval_us, datetime(2026, 10, 14, 7, 48, 3))
    signals = r.signals(keys, language)
    if missing:
        signals[1].blank((7, 8, 31))
    times = clock.counted(r, 1, 3, "", decimal)
    return delimited(name + ".ASC", FAMILY, times, signals, separator="\t", decimal=decimal, encoding=encoding, heads=False,
                     above=block(r, signals, language, decimal), missing=missing or "",
                     extra={"started_also": [r.start.isoformat()]})


def logs():
    probes = ["X1", "X2", "Y1", "Y2", "Z"]
    yield with_blocks("catman_01_warmlauf", "de", ",", ["speed", "load"] + TEMPERATURES + probes[:3], 320, 1_000_000)
    yield with_blocks("catman_02_warmup", "en", ".", ["speed"] + TEMPERATURES[:5] + ["Z"], 200, 500_000)
    yield with_blocks("catman_03_taster", "de", ",", probes, 150, 100_000)
    yield with_blocks("catman_04_overflow", "de", ",", ["T_bearing_front", "T_room", "X1"], 90, 2_000_000, missing="-1000000")
    yield with_blocks("catman_05_palier", "en", ",", ["T_room"] + probes, 60, 5_000_000)
    # One line of heads, names and units together, absolute time of the amplifier's clock
    r = Record("catman_06_ntp", 240, 5_000_000, datetime(2026, 11, 3, 6, 0, 0))
    yield delimited("catman_06_ntp.txt", FAMILY, clock.absolute(r, "dots_ms", "Zeit  1 - Standardmessrate"),
                    r.signals(["speed", "power"] + TEMPERATURES, "de"), separator="\t", decimal=",", encoding="cp1252")
    r = Record("catman_07_csv", 120, 250_000)
    yield delimited("catman_07_csv.csv", FAMILY, clock.counted(r, 1, 2, "Time  1 - default sample rate [s]"),
                    r.signals(["speed", "torque", "current", "T_motor"], "en"), separator=";", encoding="cp1252")
    r = Record("catman_08_units_below", 100, 1_000_000)
    yield delimited("catman_08_units_below.asc", FAMILY, clock.counted(r, 1, 1, "Zeit  1 - Standardmessrate", ","),
                    r.signals(["T_bearing_front", "T_room"] + probes, "de"), separator="\t", decimal=",", units_row=True,
                    time_unit="s", encoding="cp1252", end="\n")
    # Exponents as catman writes them at full precision
    r = Record("catman_09_exponents", 80, 20_000)
    signals = r.signals(["speed", "Z"], "en", digits=5)
    from table import exponent
    for s in signals:
        s.numbers = [float(exponent(n, 7)) for n in s.numbers]
    show = {i: [exponent(n, 7) for n in s.numbers] for i, s in enumerate(signals)}
    yield delimited("catman_09_exponents.asc", FAMILY, clock.counted(r, 1, 2, "Time  1 - default sample rate [s]"), signals,
                    separator="\t", show=show, encoding="cp1252")
    r = Record("catman_10_twenty", 60, 10_000_000)
    keys = ["speed", "load", "power", "torque", "current"] + TEMPERATURES + ["T_oil"] + probes
    yield delimited("catman_10_twenty.asc", FAMILY, clock.counted(r, 1, 0, "Zeit  1 - Standardmessrate [s]", ","),
                    r.signals(keys, "de"), separator="\t", decimal=",", encoding="utf-8", mark=b"\xef\xbb\xbf")
