"""The model of bench_compensation.cpp, row by row, as a user writes it with csv and numpy: reads lines of sensors, writes lines of
offsets. Low passes are exact for inputs that are straight lines between rows. No limits, no holds, no state: less than
`ballbar compensate` does.

    python3 compensate_peer.py EFFECTS    lines from the standard input, offsets to the standard output; EFFECTS 1 or 4
"""
import csv
import sys

import numpy as np

effects = int(sys.argv[1])
gains_um_per_K = np.array([1.2, -0.8, 0.5])
lags_s = np.array([600.0, 3600.0, 7200.0])
rows = csv.reader(sys.stdin)
names = next(rows)
time_at = names.index("time_s")
at = [names.index(name) for name in ("T_front_degC", "T_rear_degC", "T_room_degC")[: 3 if effects == 4 else 1]]
out = csv.writer(sys.stdout, lineterminator="\n")
out.writerow(["time_s", "z_um", "z_counts", "z_predicted_um"])
sys.stdout.flush()
first = before = before_s = lag = None
for row in rows:
    time_s = float(row[time_at])
    now = np.array([float(row[i]) for i in at])
    if first is None:
        first, lag = now, now.copy()
    elif effects == 4:
        step_s = time_s - before_s
        share = np.exp(-step_s / lags_s)
        mean = (1.0 - share) * lags_s / step_s
        lag = share * lag + (mean - share) * before + (1.0 - mean) * now
    before, before_s = now, time_s
    error_um = 2.244 * (now[0] - first[0])
    if effects == 4:
        error_um += np.dot(gains_um_per_K, lag - first)
    counts = int(np.round(-error_um / 0.1))
    out.writerow([time_s, counts * 0.1, counts, error_um])
    sys.stdout.flush()
