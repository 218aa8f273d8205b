"""MATLAB: .mat of version 5 (vectors, a struct, compressed, datenum), and what writetable and writetimetable write."""

import struct
from datetime import datetime

import clock
from delimited import delimited
from mat_file import INT16, SINGLE, Writer
from record import Log, Record

START = datetime(2026, 11, 22, 13, 5, 10)


def suffixed(record, keys, spelling):
    """Columns whose unit stands in the name: T_bearing_front_degC."""
    suffix = {"rpm": "rpm", "%": "percent", "kW": "kW", "°C": "degC", "µm": "um", "Nm": "Nm", "A": "A", "bar": "bar"}
    signals = record.signals(keys)
    for key, s in zip(keys, signals):
        s.source = spelling.get(key, key)
    return signals, [f"{s.source}_{suffix[s.text]}" if s.text else s.source for s in signals]


NAMES = {"speed": "spindle_speed", "load": "spindle_load", "power": "power", "X1": "probe_X1", "Y1": "probe_Y1", "Z": "probe_Z"}


def mat(name, keys, rows, interval_us, time, *, compress=False, order="<", shape="vectors", dims=None, extra=None, more=()):
    """`time` is (name, function of the record that gives its numbers, started)."""
    r, w = Record(name, rows, interval_us, START), Writer(order)
    signals, names = suffixed(r, keys, NAMES)
    time_name, numbers, started = time
    across = (1, rows) if dims == "row" else None
    if shape == "struct":
        fields = [(time_name, w.numbers("", numbers(r), dims=across))]
        fields += [(n, w.numbers("", s.numbers, dims=across)) for n, s in zip(names, signals)]
        elements = [w.structure("log", fields)]
    else:
        elements = [w.numbers(time_name, numbers(r), dims=across)]
        elements += [w.numbers(n, s.numbers, dims=across) for n, s in zip(names, signals)]
    elements += [w.text(n, t) for n, t in more]
    if compress:
        elements = [w.compressed(e) for e in elements]
    return Log(name + ".mat", "matlab_mat", w.file(elements), r.time_s, signals, started=START.isoformat() if started else None,
               skipped=[n for n, _ in more], extra=extra or {})


def seconds(record):
    return record.time_s


def datenum(record):
    return [clock.serial(s) + 693960 for s in record.stamps]


def mats():
    s = ("time_s", seconds, False)
    yield mat("mat_01_vectors", ["speed", "load", "T_bearing_front", "Z"], 150, 1_000_000, s)
    yield mat("mat_02_compressed", ["speed", "T_motor", "T_room", "X1", "Y1", "Z"], 300, 500_000, s, compress=True)
    yield mat("mat_03_struct", ["T_bearing_front", "T_column", "T_coolant"], 120, 10_000_000, s, shape="struct")
    yield mat("mat_04_struct_compressed", ["speed", "T_bed", "Z"], 100, 10_000_000, ("t_s", seconds, False), shape="struct",
              compress=True, dims="row")
    yield mat("mat_05_datenum", ["T_bearing_front", "T_room"], 90, 60_000_000, ("datenum", datenum, True),
              extra={"time_tolerance_s": 1e-3})
    yield mat("mat_06_row_vectors", ["speed", "power", "current"], 80, 100_000, s, dims="row")
    yield mat("mat_07_texts_beside", ["T_bed", "T_room"], 70, 1_000_000, s, more=(("machine", "M7"), ("comment", "warm up, doors closed")))
    yield mat("mat_08_big_endian", ["speed", "T_bearing_front"], 60, 1_000_000, s, order=">")
    yield mat("mat_09_time_without_unit", ["speed", "T_bearing_front", "Z"], 110, 250_000, ("t", seconds, False),
              extra={"may_refuse": True})
    # Whole numbers in a smaller type, single precision, int16
    r, w = Record("mat_10_classes", 130, 1_000_000, START), Writer()
    signals, names = suffixed(r, ["speed", "load", "T_bearing_front"], NAMES)
    signals[1].numbers = [float(int(n)) for n in signals[1].numbers]
    signals[2].numbers = [struct.unpack("<f", struct.pack("<f", n))[0] for n in signals[2].numbers]
    elements = [w.numbers("time_s", r.time_s, stored=INT16), w.numbers(names[0], signals[0].numbers, stored=INT16),
                w.numbers(names[1], signals[1].numbers, INT16), w.numbers(names[2], signals[2].numbers, SINGLE)]
    yield Log(r.name + ".mat", "matlab_mat", w.file(elements), r.time_s, signals)
    # Gaps are NaN
    r, w = Record("mat_11_nan", 100, 2_000_000, START), Writer()
    signals, names = suffixed(r, ["T_bearing_front", "T_room", "X1"], NAMES)
    signals[1].blank(range(10, 25))
    arrays = [w.numbers(n, [float("nan") if x is None else x for x in s.numbers]) for n, s in zip(names, signals)]
    yield Log(r.name + ".mat", "matlab_mat", w.file([w.numbers("time_s", r.time_s)] + arrays), r.time_s, signals)


def logs():
    yield from mats()
    family = "matlab_csv"
    r = Record("writetable_01_datetime", 120, 1_000_000, START)
    signals = r.signals(["speed", "T_bearing_front", "Z"], unit="")
    for s in signals:
        s.source = s.source.replace(" ", "")
    yield delimited("writetable_01_datetime.csv", family, clock.absolute(r, "mon_en"), signals, end="\n")
    r = Record("writetable_02_duration", 100, 500_000, START)
    signals = [r.signal("speed", name="speed", unit="rpm"), r.signal("T_bearing_front", name="T_bearing", unit="degC")]
    texts = [f"{us / 1e6:g} sec" for us in r.times_us]      # a timetable whose rows are durations
    yield delimited("writetable_02_duration.csv", family, clock.Times(["Time"], [texts], r.time_s, None, {}), signals,
                    style="underscore", end="\n")
    r = Record("writetable_03_hms", 90, 10_000_000, START)
    yield delimited("writetable_03_hms.csv", family, clock.run(r, "hms", "Time"), r.signals(["T_bed", "T_room"], unit="degC"),
                    style="underscore", end="\n")
    r = Record("writetable_04_nan", 110, 1_000_000, START)
    signals = [r.signal(k, name=n, unit=u) for k, n, u in
               (("T_bearing_front", "T_bearing", "degC"), ("T_motor", "T_motor", "degC"), ("X1", "probe_X1", "um"))]
    signals[0].blank((2, 3, 90))
    yield delimited("writetable_04_nan.csv", family, clock.counted(r, 1, 0, "time_s"), signals, style="underscore", missing="NaN", end="\n")

