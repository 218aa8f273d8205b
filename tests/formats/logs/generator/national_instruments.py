"""LabVIEW measurement files (.lvm), and TDMS files exported to CSV by NI's tools and by scripts."""

from datetime import datetime

import clock
from delimited import delimited, no_times
from record import Log, Record
import table

SPELT = {"V": "Volts", "A": "Amps", "°C": "Deg C"}


def lvm(name, keys, rows, interval_us, *, x_columns="One", decimal=".", headings="No", units_label=True, comment=True, spelt=True):
    r = Record(name, rows, interval_us, datetime(2026, 9, 8, 15, 45, 2, 741850))
    signals = r.signals(keys)
    if spelt:
        for s in signals:
            s.text = SPELT.get(s.text, s.text)
    if not units_label:
        for s in signals:
            s.text, s.role = "", None if s.role == "measured" else s.role
    n = len(signals)
    stamp = [f"{r.start:%Y/%m/%d}", f"{r.start:%H:%M:%S}{decimal}7418508529663085938"]
    d = interval_us / 1e6
    head = [["LabVIEW Measurement", ""], ["Writer_Version", "2"], ["Reader_Version", "2"], ["Separator", "Tab"],
            ["Decimal_Separator", decimal], ["Multi_Headings", headings], ["X_Columns", x_columns], ["Time_Pref", "Relative"],
            ["Operator", "lab"], ["Date", stamp[0]], ["Time", stamp[1]], ["***End_of_Header***", ""], ["", ""],
            ["Channels", str(n)] + [""] * n, ["Samples"] + [str(rows)] * n, ["Date"] + [stamp[0]] * n, ["Time"] + [stamp[1]] * n]
    if units_label:
        head.append(["Y_Unit_Label"] + [s.text for s in signals])
    head += [["X_Dimension"] + ["Time"] * n, ["X0"] + [table.exponent(0.0, 16, decimal).replace("E+00", "E+0")] * n,
             ["Delta_X"] + [table.number(d, 6, decimal)] * n, ["***End_of_Header***"] + [""] * n]
    times = [table.number(us / 1e6, 6, decimal) for us in r.times_us]
    text = [table.cells(s, decimal) for s in signals]
    if x_columns == "Multi":
        top = [h for s in signals for h in ("X_Value", s.source)]
        body = [c for column in text for c in (times, column)]
        for i, s in reversed(list(enumerate(signals))):
            if i:
                again = r.signal("X1", unit="")
                again.source, again.numbers, again.text, again.role, again.optional = "X_Value", r.time_s, "s", None, True
                signals.insert(i, again)
    else:
        top, body = ["X_Value"] + [s.source for s in signals], [times if x_columns == "One" else [""] * rows] + text
    if comment:
        top, body = top + ["Comment"], body + [[""] * rows]
    lines = head + [top] + table.rows(body)
    content = table.lines(lines, "\t", "\r\n", False).encode("cp1252")
    also = [r.start.isoformat(), r.start.replace(microsecond=0).isoformat()]
    return Log(name + ".lvm", "labview", content, r.time_s, signals, skipped=["Comment"] if comment else [],
               extra={"started_also": also})


def logs():
    yield lvm("lvm_01_voltage", ["voltage"], 200, 1_000)
    yield lvm("lvm_02_no_x_column", ["voltage", "current"], 100, 10_000, x_columns="No")
    yield lvm("lvm_03_decimal_comma", ["T_bearing_front", "T_room", "Z"], 120, 500_000, decimal=",")
    yield lvm("lvm_04_multi", ["voltage", "T_motor"], 90, 100_000, x_columns="Multi")
    yield lvm("lvm_05_no_units", ["speed", "T_bearing_front", "X1"], 150, 1_000_000, units_label=False)
    yield lvm("lvm_06_many", ["speed", "load", "T_bearing_front", "T_bearing_rear", "T_room", "T_coolant", "X1", "Y1", "Z"], 240,
              1_000_000, comment=False, spelt=False)
    family = "tdms_csv"
    r = Record("tdms_01_group_sheet", 130, 200_000)
    yield delimited("tdms_01_group_sheet.csv", family, clock.counted(r, 1, 1, "Time (s)"),
                    r.signals(["voltage", "current", "T_motor"]), style="round")
    r = Record("tdms_02_stamps", 90, 1_000_000, datetime(2026, 12, 1, 9, 30, 0))
    yield delimited("tdms_02_stamps.csv", family, clock.absolute(r, "month_ampm", "Timestamp"),
                    r.signals(["T_bearing_front", "T_room", "Z"]), style="round", expect="refuse",
                    why="12/1/2026 can be 1 December or 12 January, and no row decides", options=["--dates", "month-first"])
    # As a script writes it: paths of channels, absolute index
    r = Record("tdms_03_paths", 110, 100_000)
    signals = r.signals(["speed", "T_bearing_front", "T_column"], unit="")
    for s in signals:
        s.source = f"/'Warm up'/'{s.source}'"
    yield delimited("tdms_03_paths.csv", family, clock.absolute(r, "iso_us", ""), signals, end="\n")
    r = Record("tdms_04_waveform_without_time", 100, 1_000)
    yield delimited("tdms_04_waveform_without_time.csv", family, no_times(100, 0.001), r.signals(["voltage", "current"], unit=""),
                    expect="needs", why="neither a time nor a rate is in the file", options=["--every", "0.001s"])
    r = Record("tdms_05_increment", 140, 2_000)
    yield delimited("tdms_05_increment.csv", family, no_times(140, 0.002), r.signals(["voltage", "current"]), style="brackets",
                    above="wf_start_time,11/22/2026 13:05:10\nwf_increment,0.002\nwf_samples,140\nwf_xunit_string,s\n\n",
                    extra={"started_also": ["2026-11-22T13:05:10"], "may_refuse": True}, options=["--every", "0.002s"])
    r = Record("tdms_06_diadem", 95, 50_000)
    yield delimited("tdms_06_diadem.csv", family, clock.counted(r, 1, 2, "Zeit", ","),
                    r.signals(["speed", "torque", "T_motor"], "de"), separator=";", decimal=",", units_row=True, time_unit="s",
                    encoding="cp1252")
    r = Record("tdms_07_flexlogger", 160, 1_000_000)
    yield delimited("tdms_07_flexlogger.csv", family, clock.absolute(r, "month_loose", "Time"),
                    r.signals(["T_bearing_front", "T_bearing_rear", "T_coolant", "X1", "Y1", "Z"]), style="round",
                    above="Log start: 11/22/2026 1:05:10 PM\nTest: warm up\n\n", mark=b"\xef\xbb\xbf")
