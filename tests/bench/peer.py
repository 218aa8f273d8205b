"""The same work as the benchmarks with numpy, scipy, sklearn and ElementTree, and one table of both.

    python3 peer.py FILES_FOLDER REPETITIONS GOOGLE_BENCHMARK_JSON...

FILES_FOLDER is what bench_files wrote. Each figure is processor time, the median of the repetitions. A `.b5r` is read from disk and
both its circles fitted, by the peer in two ways: as usually written, and with the exact Jacobian and MINPACK. The peer has no
autocorrelation in its covariance, the second way no covariance; ours has both. Five probes: read, drift and tilt, written; the peer
without sigma, ours with a column of it for each. Errors of a machine: the peer is one least squares of their columns over all readings,
with the covariance of white noise and the pitches of the screws known; ours searches the pitches, adds what shows at the reversals, and
has the noise with a memory, the ranks and what is left.
"""
import json
import os
import pathlib
import statistics
import sys
import time
import xml.etree.ElementTree as xml

import numpy as np
from scipy.optimize import least_squares
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, DotProduct, WhiteKernel

folder = pathlib.Path(sys.argv[1])
repetitions = int(sys.argv[2])


def median_ms(work, times_done=repetitions):
    times = []
    for _ in range(times_done):
        start = time.process_time()
        work()
        times.append((time.process_time() - start) * 1e3)
    return statistics.median(times)


def fit(angle_rad, length_mm):
    """Centre a, b and radius R of L = |(a, b) + R (cos, sin)|, with the exact Jacobian."""
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)

    def residual(p):
        return np.hypot(p[0] + p[2] * cos, p[1] + p[2] * sin) - length_mm

    def jacobian(p):
        x, y = p[0] + p[2] * cos, p[1] + p[2] * sin
        length = np.hypot(x, y)
        return np.column_stack((x / length, y / length, (x * cos + y * sin) / length))

    return least_squares(residual, (0.0, 0.0, length_mm.mean()), jac=jacobian, method="lm").x


def fit_usual(angle_rad, length_mm):
    """The same as a user writes it: least_squares as it comes, covariance from its Jacobian."""
    cos, sin = np.cos(angle_rad), np.sin(angle_rad)
    found = least_squares(lambda p: np.hypot(p[0] + p[2] * cos, p[1] + p[2] * sin) - length_mm,
                          (0.0, 0.0, length_mm.mean()))
    variance = 2.0 * found.cost / (length_mm.size - 3)
    return found.x, variance * np.linalg.inv(found.jac.T @ found.jac)


def read_b5r(path):
    root = xml.parse(path).getroot()
    bar = root.find("TEST_SPEC/INSTRUMENT/DYNAMIC_BALLBAR")
    nominal_mm = float(bar.findtext("NOMINAL_LENGTH"))
    start_deg, end_deg = float(bar.findtext("START_ANGLE")), float(bar.findtext("END_ANGLE"))
    arc_deg = (end_deg - start_deg) % 360.0 or 360.0
    runs = []
    for run in root.iterfind("RUN_RESULTS/BALLBAR_RUN"):
        first, last = int(run.findtext("START_INDEX")), int(run.findtext("END_INDEX"))
        length_mm = nominal_mm + np.array(run.findtext("READINGS").split(), dtype=float)[first : last + 1]
        step_deg = (np.arange(length_mm.size) + 0.5) * arc_deg / length_mm.size
        ccw = run.findtext("RUN_DIRECTION") == "CCW"
        runs.append((np.radians(start_deg + step_deg if ccw else end_deg - step_deg), length_mm))
    return runs


def machine_errors(runs, length_mm=100.0, feed_mm_per_min=1000.0, pitch_mm=10.0):
    """Values and white sigma of the errors that are linear, over both runs."""
    blocks = []
    for run, (angle_rad, _) in enumerate(runs):
        way = 1.0 if angle_rad[1] > angle_rad[0] else -1.0
        c, s = np.cos(angle_rad), np.sin(angle_rad)
        along_a, along_b = -np.sign(s) * way, np.sign(c) * way
        double = np.sin(2.0 * angle_rad)
        columns = [np.ones_like(c), c, s, way / 2.0 * np.ones_like(c), way / 2.0 * c, way / 2.0 * s,
                   np.cos(2.0 * angle_rad) / 4.0, -length_mm / 2e3 * double, np.sin(3.0 * angle_rad) / 4.0,
                   -np.cos(3.0 * angle_rad) / 4.0, way * feed_mm_per_min / 120.0 * double,
                   way / 2.0 * np.sin(4.0 * angle_rad), np.cos(4.0 * angle_rad) / 2.0, np.sin(4.0 * angle_rad) / 2.0]
        for end in (1.0, -1.0):
            columns += [-along_a * c * (1.0 + end * c) / 4.0, -along_b * s * (1.0 + end * s) / 4.0,
                        along_a * s * (1.0 + end * c) / 4.0, along_b * c * (1.0 + end * s) / 4.0]
        for x, along in ((c, along_a), (s, along_b)):
            wave = 2.0 * np.pi * length_mm / pitch_mm * x
            for of_run in range(len(runs)):
                for forwards in (1.0, -1.0):
                    here = (along == forwards) * (of_run == run) * x / 2.0
                    columns += [here * np.sin(wave), here * np.cos(wave)]
        away = np.abs((np.degrees(angle_rad) + 45.0) % 90.0 - 45.0) > 1.5
        blocks.append(np.column_stack(columns)[away])
        runs[run] = (angle_rad, runs[run][1], away)
    x = np.vstack(blocks)
    y = np.concatenate([1e3 * (length - length_mm)[away] for _, length, away in runs])
    inverse = np.linalg.pinv(x.T @ x)
    gains = inverse @ (x.T @ y)
    variance = np.sum((y - x @ gains) ** 2) / (y.size - x.shape[1])
    return gains, np.sqrt(variance * np.diag(inverse))


def read_log(path):
    with open(path, encoding="utf-8") as file:
        header = next(line for line in file if not line.startswith("#")).strip().split(",")
        table = np.loadtxt(file, delimiter=",")
    return np.radians(table[:, header.index("angle_deg")]), table[:, header.index("length_mm")]


def five_probes(path, out, spacing_mm=80.0, from_plane_1_mm=25.0):
    """Drift at the ball and tilt as changes since the first row, as a user writes it: loadtxt, savetxt."""
    time_s, x1, x2, y1, y2, z = np.loadtxt(path, delimiter=",", comments=["#", "time_s"], unpack=True)
    x1, x2, y1, y2, z = (probe - probe[0] for probe in (x1, x2, y1, y2, z))
    share = from_plane_1_mm / spacing_mm
    columns = (time_s, x1 + (x2 - x1) * share, y1 + (y2 - y1) * share, z,
               -(y2 - y1) / spacing_mm * 1e3, (x2 - x1) / spacing_mm * 1e3)
    np.savetxt(out, np.column_stack(columns), delimiter=",", comments="",
               header="time_s,x_um,y_um,z_um,tilt_a_urad,tilt_b_urad")


def warm_ups(count):
    """As warm_ups in bench_data.cpp: temperatures and error of each batch."""
    random = np.random.default_rng(5)
    time_s, sensor = 30.0 * np.arange(600), np.arange(23)
    batches = []
    for _ in range(count):
        room, heat_K = random.uniform(10.0, 30.0), random.uniform(15.0, 35.0)
        fast, slow = heat_K * (1.0 - np.exp(-time_s / 1800.0)), heat_K * (1.0 - np.exp(-time_s / 7200.0))
        degC = np.full((600, 24), room)
        degC[:, :23] += np.outer(fast, 0.1 + 0.9 * (sensor * 7 % 23) / 22.0) + np.outer(slow, 0.3 * (sensor * 5 % 23) / 22.0)
        um = 0.04 * room * fast + 0.3 * slow + random.normal(0.0, 0.5, 600)
        batches.append((np.round(degC + random.normal(0.0, 0.05, degC.shape), 1), um))
    return batches


def gaussian_process(batch):
    """A regression with a discrepancy that remembers, as a user would write it: no lags, kernel by its likelihood."""
    degC, um = batch
    kernel = ConstantKernel() * DotProduct() + ConstantKernel() * RBF(1.0) + WhiteKernel()
    return GaussianProcessRegressor(kernel, normalize_y=True).fit(degC - degC[0], um)


circle = read_log(folder / "circle.csv")
both_runs = read_b5r(folder / "test.b5r")
with open(folder / "probes.csv", encoding="utf-8") as probes:
    probe_rows = sum(1 for line in probes if line[0].isdigit())
batches = warm_ups(int(os.environ.get("BALLBAR_BENCH_BATCHES", "1000")))
log_MB = (folder / "log.csv").stat().st_size / 1e6

ours = {}
for path in sys.argv[3:]:
    for entry in json.loads(pathlib.Path(path).read_text())["benchmarks"]:
        if repetitions == 1 or entry.get("aggregate_name") == "median":
            ours[entry["run_name"]] = entry

rows = [
    (".b5r, the peer as usually written", "b5r_open_and_fit",
     median_ms(lambda: [fit_usual(*run) for run in read_b5r(folder / "test.b5r")])),
    (".b5r, the peer with exact Jacobian, method lm", "b5r_open_and_fit",
     median_ms(lambda: [fit(*run) for run in read_b5r(folder / "test.b5r")])),
    ("all errors of a machine, 2 x 1500 readings", "machine_errors", median_ms(lambda: machine_errors(list(both_runs)))),
    (f"log of {log_MB:.0f} MB read", "log_read", median_ms(lambda: read_log(folder / "log.csv"))),
    (f"circle of {circle[0].size} readings fitted", "circle_fit", median_ms(lambda: fit(*circle))),
    (f"sine and cosine of {circle[0].size} angles", "circle_sine_pass",
     median_ms(lambda: (circle[1] * (np.cos(circle[0]) + np.sin(circle[0]))).sum())),
    ("15 tests of two arcs from disk, their drift", "session_drift", None),
    (f"five probes, {probe_rows} rows: read, drift, .csv", "five_probe_file",
     median_ms(lambda: five_probes(folder / "probes.csv", folder / "probes-drift.csv"))),
    ("  of it the drift and its uncertainty", "five_probe_reduced", None),
    (f"{len(batches)} batches of 600 rows, their moments", "batches_moments/process_time", None),
    ("  their weights for a job", "batches_weighted/process_time", None),
    ("a regression on effects, 600 rows, 24 columns", "prediction_trained/process_time",
     median_ms(lambda: gaussian_process(batches[0]), 1)),
    ("46 h of the finite-volume spindle", "spindle_46h", None),
]
print(f"{'':46} {'ours ms':>10} {'peer ms':>10} {'peer/ours':>10}")
for title, name, peer_ms in rows:
    ours_ms = ours[name]["cpu_time"]
    peer = f"{peer_ms:10.2f} {peer_ms / ours_ms:10.1f}" if peer_ms is not None else f"{'-':>10} {'-':>10}"
    print(f"{title:46} {ours_ms:10.2f} {peer}")
print()
print(f"log: {ours['log_read']['bytes_per_second'] / 1e6:.0f} MB/s")
for name in ("circle_fit", "circle_fit_polar", "circle_fit_robust"):
    entry = ours[name]
    print(f"{name}: {entry['times_sine_pass']:.1f} x the sine and cosine pass, "
          f"{entry['peak_bytes_a_reading']:.0f} bytes a reading at the peak")
