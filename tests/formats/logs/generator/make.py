"""Writes log files as loggers, spreadsheets and people write them, each with the truth beside it: make.py OUT_FOLDER."""

import sys
from importlib import import_module
from pathlib import Path

FAMILIES = ("catman", "national_instruments", "siemens", "fanuc", "heidenhain", "linuxcnc", "keyence", "picolog", "graphtec",
            "excel_csv", "xlsx", "matlab", "pandas_csv", "people_times", "people_numbers", "people_layouts", "ambiguous", "odd_text",
            "odd_clock", "odd_files", "layouts")


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    seen, count = set(), {}
    for module in FAMILIES:
        for log in import_module(module).logs():
            if log.file in seen:
                sys.exit(f"{log.file} is made twice")
            seen.add(log.file)
            log.write(folder)
            count[log.family] = count.get(log.family, 0) + 1
    for family, number in count.items():
        print(f"{family:14} {number:4}")
    print(f"{'files':14} {len(seen):4}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("make.py OUT_FOLDER")
    main(Path(sys.argv[1]))
