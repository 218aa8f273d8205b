"""What people and their programs put around the rows: titles, notes, blank lines, quotes, odd separators and ends of lines."""

from datetime import datetime

import clock
from delimited import delimited
from record import Record

FAMILY = "people_layouts"
START = datetime(2026, 11, 24, 6, 30, 0)
US = 1_000_000


def layout(name, keys, rows=70, *, time=None, language="en", interval_us=10 * US, ending=".csv", prepare=None, **more):
    r = Record(name, rows, interval_us, START)
    signals = r.signals(keys, language)
    if prepare:
        prepare(signals)
    times = time(r) if time else clock.absolute(r, "iso")
    return delimited(name + ending, FAMILY, times, signals, **more)


def after(row, *texts):
    """Lines of text that somebody put below the row of that number."""
    def edit(rows):
        for text in reversed(texts):
            rows.insert(row + 1, text)

    return edit


def aligned(rows):
    """Columns of equal width, as a printed table."""
    for j in range(len(rows[0])):
        width = max(len(row[j]) for row in rows)
        for row in rows:
            row[j] = row[j].rjust(width)


def broken_head(rows):
    """A head that a spreadsheet shows in two lines."""
    rows[0][3] = rows[0][3].replace(" [", "\n[")


def padded(rows):
    for row in rows:
        row[:] = [f" {c} " for c in row]


def all_quoted(rows):
    for row in rows:
        row[:] = [f'"{c}"' for c in row]


def ragged(rows):
    """Readings at the end of a row that are missing are not even separated."""
    for row in rows[1:]:
        while row and row[-1] == "":
            row.pop()


def logs():
    de = {"separator": ";", "decimal": ",", "language": "de", "time": lambda r: clock.absolute(r, "dots", "Zeit")}
    t3 = ["T_bearing_front", "T_bearing_rear", "T_room"]
    yield layout("layout_01_notes_above", ["speed"] + t3, above="Warmlauf M7, 22.11.2026\nPrüfer: K. L.\nWerkzeug: HSK63; Länge 120 mm\n\n", **de)
    yield layout("layout_02_notes_below", t3, below="\n# stopped because of the shift\n# next: cooling\n")
    yield layout("layout_03_prose_below", t3 + ["Z"], below="\nEnd of recording\n")
    yield layout("layout_04_blank_lines", t3, edit=after(30, [""], [""]))
    yield layout("layout_05_comments_among", t3, edit=after(25, ["# door opened"]))
    yield layout("layout_06_quoted_newline", ["speed", "load"] + t3, edit=broken_head)
    yield layout("layout_07_trailing_separators", t3, trail=";", **de)
    yield layout("layout_08_trailing_three", t3 + ["X1"], trail=",,,")
    yield layout("layout_09_all_quoted", ["speed"] + t3, edit=all_quoted, quote=False)
    yield layout("layout_10_quoted_decimal_comma", ["speed", "load", "T_room"], decimal=",", separator=",")
    yield layout("layout_11_aligned", t3, time=lambda r: clock.counted(r, 1, 1, "t_s"), separator="  ", edit=aligned, style="underscore",
                 quote=False, ending=".txt")
    yield layout("layout_12_padded", ["speed", "load", "Z"], separator=";", edit=padded)
    yield layout("layout_13_old_mac", t3, end="\r")
    yield layout("layout_14_lone_newline", t3, end="\n", separator="\t", ending=".txt")
    cut = layout("layout_15_no_last_newline", t3, end="\n")
    cut.content = cut.content.rstrip(b"\n")
    yield cut
    yield layout("layout_16_ragged", t3 + ["Z"], prepare=some_missing, edit=ragged)
    yield layout("layout_17_no_heads", ["speed", "T_bearing_front", "Z"], heads=False, prepare=bare)
    yield layout("layout_18_hash_heads", t3, edit=lambda rows: rows[0].__setitem__(0, "# " + rows[0][0]))
    yield layout("layout_19_percent_heads", t3, separator="\t", ending=".txt", edit=lambda rows: rows[0].__setitem__(0, "% " + rows[0][0]))
    yield layout("layout_20_running_number", t3, lead=[("Nr.", [str(i + 1) for i in range(70)])], **de)
    yield layout("layout_21_remarks", ["load"] + t3, behind=[("Remark", ["tool change" if i == 20 else "" for i in range(70)])])
    yield layout("layout_22_program_names", ["speed", "load"], lead=[("Program", ["O1001" if i < 25 else "O2002" if i < 50 else "O3003" for i in range(70)])])
    yield layout("layout_23_heads_again", t3, edit=lambda rows: rows.insert(36, list(rows[0])))
    yield layout("layout_24_mean_below", t3, below="Mean,22.1,21.9,20.8\nMax,25.0,24.1,21.3\n")
    yield layout("layout_25_title_line", t3, above='"Warm-up of 24 November, all doors closed"\n', style="round")
    yield layout("layout_26_key_values", ["speed"] + t3, above="Machine: M7\nOperator: K. L.\nInterval: 10 s\nChannels: 4\n\n", separator="\t",
                 ending=".txt")
    yield layout("layout_27_same_names", ["T_bearing_front", "T_bearing_rear", "T_room"], prepare=same_names)
    yield layout("layout_28_heads_over_units_over_numbers", t3 + ["X1"], units_row=True, edit=after(1, ["", "1", "2", "3", "4"]),
                 separator=";")
    yield layout("layout_29_one_column", ["T_bed"])
    yield layout("layout_30_rows_without_time", t3, edit=lambda rows: rows.insert(20, ["", "21.0", "21.0", "21.0"]))
    yield layout("layout_31_pipe", t3, separator="|")
    yield layout("layout_32_umlauts_latin", ["T_column", "T_coolant", "T_oil"], encoding="cp1252", **de)


def some_missing(signals):
    signals[3].blank((5, 6, 40))
    signals[2].blank((6, 40))


def bare(signals):
    for s in signals:
        s.source, s.text, s.role = "", "", None


def same_names(signals):
    for s in signals:
        s.source, s.role = "Temp", None
