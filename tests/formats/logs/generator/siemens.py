"""Traces of a SINUMERIK and its drives, saved as CSV; a trace of the PLC; the data log of a panel."""

from datetime import datetime

import clock
from delimited import delimited, no_times
from record import Log, Record, Signal

FAMILY = "siemens"

GERMAN = {"speed": "Drehzahlistwert (SP1)", "torque": "Drehmomentistwert (SP1)", "current": "Iq-Istwert (SP1)",
          "load": "Auslastung (SP1)", "T_motor": "Motortemperatur (SP1)", "pos_X": "Lageistwert (X1)", "pos_Y": "Lageistwert (Y1)",
          "pos_Z": "Lageistwert (Z1)"}
ENGLISH = {"speed": "Actual speed value (SP1)", "torque": "Actual torque (SP1)", "current": "Current actual value Iq (SP1)",
           "load": "Utilization (SP1)", "T_motor": "Motor temperature (SP1)", "pos_X": "Actual position (X1)",
           "pos_Y": "Actual position (Y1)", "pos_Z": "Actual position (Z1)"}


def named(record, keys, words, spell=None):
    return [record.signal(k, unit=(spell or {}).get(k), name=words[k]) for k in keys]


def operate(name, keys, words, interval_us, rows, separator, decimal, per_s, unit, spell=None):
    """A session of the trace: lines on the session and its signals, then the rows."""
    r = Record(name, rows, interval_us, datetime(2026, 10, 29, 10, 20, 30))
    signals = named(r, keys, words, spell)
    q = separator
    above = [f"SINUMERIK Trace{q}V2.0", f"Session{q}{name}", f"{'Datum' if words is GERMAN else 'Date'}{q}{r.start:%Y-%m-%d %H:%M:%S}",
             f"{'Abtastzeit' if words is GERMAN else 'Sample time'}{q}{interval_us / 1000:g}{q}ms".replace(".", decimal), ""]
    head = ("Zeit" if words is GERMAN else "Time") + f" [{unit}]"
    times = clock.counted(r, per_s, 3 if per_s == 1 else 0 if interval_us % 1000 == 0 else 3, head, decimal)
    return delimited(name + ".csv", FAMILY, times, signals, separator=separator, decimal=decimal, above="\n".join(above) + "\n",
                     extra={"started_also": [r.start.isoformat()]})


def logs():
    yield operate("siemens_01_operate_de", ["speed", "torque", "current"], GERMAN, 4_000, 300, ";", ",", 1, "s", {"speed": "1/min"})
    yield operate("siemens_02_operate_en", ["speed", "load", "pos_X", "pos_Y"], ENGLISH, 2_000, 250, ",", ".", 1000, "ms")
    yield operate("siemens_03_tabs", ["pos_X", "pos_Z", "load"], GERMAN, 1_000, 200, "\t", ",", 1000, "ms")
    # Drive trace: units in a row of their own
    r = Record("siemens_04_drive", 220, 8_000)
    yield delimited("siemens_04_drive.csv", FAMILY, clock.counted(r, 1000, 0, "Zeit"),
                    [r.signal("speed", unit="1/min", name="r21: Drehzahlistwert geglättet"),
                     r.signal("current", unit="A", name="r78[0]: Stromistwert momentenbildend"),
                     r.signal("T_motor", name="r35: Motortemperatur")], separator=";", decimal=",", units_row=True, time_unit="ms",
                    encoding="cp1252")
    # PLC trace: running number, stamp to the microsecond
    r = Record("siemens_05_plc", 180, 10_000)
    yield delimited("siemens_05_plc.csv", FAMILY, clock.absolute(r, "iso_us", "Timestamp"),
                    r.signals(["speed", "load", "T_coolant"], unit=""), separator=";",
                    lead=[("Index", [str(i + 1) for i in range(180)])])
    # Panel: one tag a file; the time stands twice
    r = Record("siemens_06_panel", 150, 1_000_000, datetime(2026, 11, 22, 6, 0, 0))
    value = r.signal("T_bearing_front", unit="", name="VarValue", role=None)
    twice = r.signal("X1", unit="", name="Time_ms", role=None)
    show = [f"{clock.serial(s) * 1e6:.4f}".replace(".", ",") for s in r.stamps]
    twice.numbers, twice.optional = [float(t.replace(",", ".")) for t in show], True
    valid = r.signal("X2", unit="", name="Validity", role=None)
    valid.numbers, valid.digits, valid.optional = [1.0] * 150, 0, True
    yield delimited("siemens_06_panel.csv", FAMILY, clock.absolute(r, "dots", "TimeString"), [value, valid, twice], separator=";",
                    decimal=",", lead=[("VarName", "Lager_vorne")], show={2: show})
    r = Record("siemens_07_rate_above", 120, 4_000)
    yield delimited("siemens_07_rate_above.csv", FAMILY, no_times(120, 0.004), named(r, ["speed", "torque"], GERMAN), separator=";",
                    decimal=",", above="SINUMERIK Trace;V2.0\nAbtastzeit [ms];4\nAnzahl Werte;120\n\n", options=["--every", "0.004s"])
    r = Record("siemens_08_negative_time", 160, 5_000)
    times = clock.counted(r, 1, 3, "Time [s]")
    before = 0.2                  # the trigger is at 0
    times.time_s = [round(t - before, 3) for t in times.time_s]
    times.columns = [[f"{t:.3f}" for t in times.time_s]]
    yield delimited("siemens_08_negative_time.csv", FAMILY, times, named(r, ["speed", "current", "pos_Z"], ENGLISH))
    # Two tags below each other, row by row
    r = Record("siemens_09_several_tags", 60, 10_000_000)
    signals = [Signal("Drehzahl", "", [i * 100.0 for i in range(60)], 0, "speed"),
               Signal("T_Lager", "", [round(20 + i / 10, 1) for i in range(60)], 1, "bearing")]
    body = [[f'"{s.source}"', f"{stamp:%d.%m.%Y %H:%M:%S}", f"{s.numbers[i]:.{s.digits}f}".replace(".", ","), "1"]
            for i, stamp in enumerate(r.stamps) for s in signals]
    text = '"VarName";"TimeString";"VarValue";"Validity"\r\n' + "".join(";".join(row) + "\r\n" for row in body)
    yield Log("siemens_09_several_tags.csv", FAMILY, text.encode("cp1252"), r.time_s, signals)
