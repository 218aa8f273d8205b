"""Numbers, units and missing values as people and programs write them."""

from datetime import datetime

import clock
import table
from delimited import delimited
from record import Record

FAMILY = "people_numbers"
START = datetime(2026, 11, 23, 7, 0, 0)
US = 1_000_000


def plain(name, rows, columns, *, language="en", interval_us=10 * US, time="iso", **more):
    """`columns` are (key, unit) or (key, unit, digits)."""
    r = Record(name, rows, interval_us, START)
    signals = [r.signal(c[0], language, unit=c[1], digits=c[2] if len(c) > 2 else None) for c in columns]
    for i, lost in (more.pop("lost", None) or {}).items():
        signals[i].blank(lost)
    return delimited(name + ".csv", FAMILY, clock.absolute(r, time), signals, **more)


def exponent_columns(name, decimal, separator, letter, columns, language):
    r = Record(name, 70, 10 * US, START)
    signals = [r.signal(k, language, unit=u, digits=8) for k, u in columns]
    for s in signals:
        s.numbers = [float(table.exponent(n, 4)) for n in s.numbers]
    show = {i: [table.exponent(n, 4, decimal, letter) for n in s.numbers] for i, s in enumerate(signals)}
    return delimited(name + ".csv", FAMILY, clock.absolute(r, "iso"), signals, separator=separator, decimal=decimal, show=show)


def logs():
    de = {"separator": ";", "decimal": ",", "language": "de", "time": "dots"}
    t3 = [("T_bearing_front", None), ("T_bearing_rear", None), ("T_room", None)]
    # units
    yield plain("unit_01_min_1", 60, [("speed", "min-1"), ("T_motor", "°C")], **de)
    yield plain("unit_02_u_min", 70, [("speed", "U/min"), ("load", "%"), ("T_bearing_front", "Grad C")], **de)
    yield plain("unit_03_tr_min", 60, [("speed", "tr/min"), ("T_room", "°C"), ("Z", "µm")], language="fr", separator=";", decimal=",")
    yield plain("unit_04_giri_min", 60, [("speed", "giri/min"), ("T_room", "gradi C"), ("Z", "um")], language="it", separator=";", decimal=",")
    yield plain("unit_05_ordinal", 60, [("T_bearing_front", "ºC"), ("T_coolant", "ºC"), ("X1", "μm")], language="es", separator=";", decimal=",")
    yield plain("unit_06_mojibake", 60, [("T_bearing_front", "Â°C"), ("T_column", "Â°C"), ("X1", "Âµm")], style="round")
    yield plain("unit_07_fahrenheit", 80, [("T_bearing_front", "°F", 1), ("T_room", "°F", 1), ("speed", "rpm")], style="round")
    yield plain("unit_08_inches", 80, [("Z", "in", 6), ("X1", "in", 6), ("T_room", "deg F", 1)], style="round")
    yield plain("unit_09_kelvin", 80, [("T_bed", "K", 2), ("T_column", "K", 2), ("Z", "nm", 0)])
    yield plain("unit_10_mm", 80, [("X1", "mm", 5), ("Y1", "mm", 5), ("Z", "mm", 5), ("T_room", "deg C")], style="comma", separator=";")
    yield plain("unit_11_power", 90, [("power", "kW"), ("torque", "Nm"), ("current", "A"), ("voltage", "V")])
    yield plain("unit_12_fluids", 90, [("pressure", "bar"), ("flow", "l/min"), ("feed", "mm/min"), ("T_coolant", "°C")], style="slash")
    yield plain("unit_13_watts", 90, [("power", "W", 0), ("torque", "N·m"), ("load", "percent")], style="round")
    yield plain("unit_14_superscript", 70, [("speed", "min⁻¹"), ("T_bearing_front", "℃"), ("Z", "㎛")], language="ja")
    yield plain("unit_15_chinese", 70, [("speed", "转/分"), ("load", "%"), ("T_bearing_front", "℃")], language="zh", style="round")
    yield plain("unit_16_none", 90, [("speed", ""), ("load", ""), ("T_bearing_front", ""), ("T_room", "")])
    yield plain("unit_17_row", 90, [("speed", "1/min"), ("load", "%"), ("T_bearing_front", "°C"), ("Z", "µm")], units_row=True, **de)
    yield plain("unit_18_row_brackets", 90, [("speed", "rpm"), ("T_room", "°C"), ("X1", "µm")], units_row=True, edit=bracketed)
    # numbers
    yield plain("number_01_thousands_en", 70, [("speed", "rpm", 1), ("power", "W", 1)], thousands=",")
    yield plain("number_02_thousands_swiss", 70, [("speed", "1/min", 1), ("power", "W", 1)], thousands="'", separator=";")
    yield plain("number_03_thousands_de", 70, [("speed", "U/min", 0), ("T_room", "°C"), ("load", "%")], thousands=".", **de)
    yield exponent_columns("number_04_exponents_de", ",", ";", "E", [("X1", "mm"), ("voltage", "V")], "de")
    yield exponent_columns("number_05_exponents", ".", ",", "e", [("X1", "µm"), ("T_room", "°C")], "en")
    yield plain("number_06_plus", 60, t3, sign="+")
    yield plain("number_07_integers", 60, [("speed", "rpm", 0), ("load", "%", 0), ("T_motor", "°C", 0)])
    # missing
    yield plain("missing_01_empty", 80, t3, lost={0: (3, 4), 2: range(40, 52)})
    yield plain("missing_02_nan", 80, t3, lost={1: (0, 79)}, missing=lambda row: ("NaN", "nan", "NAN", "-nan")[row % 4])
    yield plain("missing_03_nv", 80, t3, lost={0: range(10, 15)}, missing="#NV", **de)
    yield plain("missing_04_na", 80, t3, lost={2: (5, 6, 33)}, missing=lambda row: ("#N/A", "n/a", "NA", "N/A")[row % 4])
    yield plain("missing_05_dashes", 80, t3, lost={1: range(20, 30)}, missing=lambda row: ("---", "--", "-", "--.--")[row % 4])
    yield plain("missing_06_over", 80, t3, lost={0: range(50, 60)}, missing=lambda row: ("OVER", "+OVER", "-OVER", "OL")[row % 4])
    yield plain("missing_07_burnout", 80, t3, lost={2: range(60, 64)}, missing=lambda row: ("BURNOUT", "Burn Out", "OPEN", "ERR")[row % 4])
    yield plain("missing_08_minus_999", 80, t3, lost={0: (7, 8, 9), 1: range(30, 44)}, missing="-999")
    yield plain("missing_09_minus_9999", 80, t3, lost={1: (12, 13)}, missing="-9999.0")
    yield plain("missing_10_1e37", 80, t3, lost={2: range(15, 25)}, missing="1e+37")
    yield plain("missing_11_9e37", 80, t3, lost={0: range(15, 25)}, missing="9.9E37")
    yield plain("missing_12_null", 80, t3, lost={0: (1, 2), 1: (3,)}, missing=lambda row: ("null", "NULL", "None", "#REF!")[row % 4])


def bracketed(rows):
    rows[1][1:] = [f"[{text}]" for text in rows[1][1:]]
