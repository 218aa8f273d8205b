"""The package of Python against the library and the program: a call, many files in one call, tables of many files.

    python3 python_bench.py PROGRAM SCRATCH TESTS FILES [RESULT_OF_bench_calls.json]

TESTS: in one call of errors; FILES: of tables, such as 1000,10000,100000.
"""
import json
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import time

import ballbar
import numpy as np
from ballbar import _core, fleet

program, scratch, tests, sizes = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]), [int(n) for n in sys.argv[4].split(",")]
SOURCE = pathlib.Path("sample-runs/qc20-style-b5r/00.b5r").read_text(encoding="utf-8-sig")


def seconds(work, repetitions=5):
    taken = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        work()
        taken.append(time.perf_counter() - begin)
    return statistics.median(taken)


def files(folder, count):
    """Tests of other days, a machine a hundred."""
    folder = scratch / folder
    for k in range(count):
        path = folder / f"machine-{k // 100:04}" / f"{k % 100:02}.b5r"
        if path.exists():
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        day = k % 100 + 336 * (k // 100)
        date = f"{1990 + day // 336 % 80:04}{day // 28 % 12 + 1:02}{day % 28 + 1:02}"
        text = re.sub(r"(?<=<DATE_STARTED>)\d{8}-\d{6}", f"{date}-{k // 26880 % 24:02}{k // 448 % 60:02}00", SOURCE)
        path.write_text(text, encoding="utf-8-sig")
    return folder


def row(what, value, unit):
    print(f"{what:64}{value:12.4g} {unit}")


angle_deg = np.arange(0.0, 360.0)
length_mm = 100.0 + 0.005 * np.cos(np.radians(angle_deg))
count = 2000
row("ballbar.fit_circle of 360 readings", 1e6 * seconds(lambda: [ballbar.fit_circle(length_mm, angle_deg=angle_deg) for _ in range(count)]) / count, "us")
if len(sys.argv) > 5:
    runs = json.loads(pathlib.Path(sys.argv[5]).read_text())["benchmarks"]
    row("the same of C++", statistics.median(one["real_time"] for one in runs if one["run_type"] == "iteration"), "us")

folder = files(f"of-{tests}", tests)
paths = sorted(str(path) for path in folder.rglob("*.b5r"))
row(f"ballbar.errors of {tests} files", seconds(lambda: ballbar.errors(paths), 3), "s")
with open(os.devnull, "w", encoding="utf-8") as nowhere:
    row("ballbar errors --json", seconds(lambda: subprocess.run([program, "errors", "--json", *paths], stdout=nowhere, check=True), 3), "s")

for size in sizes:
    folder, table = files(f"of-{size}", size), scratch / f"table-{size}"
    subprocess.run(["rm", "-rf", table], check=True)
    row(f"table of {size} files", seconds(lambda: fleet.update(str(folder), str(table)), 1), "s")
    extra = files(f"more-{size}", 100)
    begin = time.perf_counter()
    subprocess.run([sys.executable, "-c", "import sys; from ballbar import fleet; fleet.update(sys.argv[1:3], sys.argv[3])", folder, extra, table], check=True)
    row("  again with 100 new files, a process of its own", time.perf_counter() - begin, "s")
    row("  memory of this process, at most", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, "MB")
