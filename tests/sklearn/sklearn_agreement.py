"""The slopes of `ballbar train` against scikit-learn's on the same rows.

    sklearn_agreement.py BALLBAR

Twelve batches of warm-ups, 8 sensors to 0.1 K, each a .csv, and their list: more batches than sensors, so that rises and temperatures
together are not collinear. Both must agree to 1e-8 of the norm of the slope, and of the target's RMS: ours are from merged moments, whose condition is the square of the rows'. Exit 1 with a sentence where they
do not, 77 where scikit-learn is not installed.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from sklearn.decomposition import PCA
    from sklearn.linear_model import LinearRegression, Ridge
    from sklearn.pipeline import make_pipeline
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

ballbar = sys.argv[1]
TOLERANCE = 1e-8
PENALTY_K2 = 0.01
NAMES = "abcdefghijkl"
SENSORS = [f"T{j:02}_degC" for j in range(1, 8)] + ["T_room_degC"]


def made_batches(folder):
    """Rows of each batch, temperatures and target, as they stand in the files."""
    random = np.random.default_rng(20240607)
    batches = []
    for name in NAMES:
        time_s = 30.0 * np.arange(random.integers(80, 160))
        room, heat = random.uniform(10.0, 30.0), random.uniform(15.0, 35.0)
        fast, slow = heat * (1.0 - np.exp(-time_s / 600.0)), heat * (1.0 - np.exp(-time_s / 2400.0))
        near_fast, near_slow = np.linspace(0.1, 1.0, 7), 0.3 * np.array([3, 0, 5, 1, 6, 2, 4]) / 6.0
        degC = room + 0.5 * np.sin(time_s / 1500.0)[:, None] + np.zeros((time_s.size, 8))
        degC[:, :7] += fast[:, None] * near_fast + slow[:, None] * near_slow
        degC = np.round(degC + random.normal(0.0, 0.05, degC.shape), 1)
        um = np.round(0.8 * fast + 0.3 * slow + 0.1 * room + random.normal(0.0, 0.5, time_s.size), 3)
        np.savetxt(folder / f"{name}.csv", np.column_stack((time_s, degC, um)), fmt=["%g"] + ["%.1f"] * 8 + ["%.3f"],
                   delimiter=",", comments="", header=",".join(["time_s", *SENSORS, "z_um"]))
        batches.append((degC, um))
    (folder / "runs.csv").write_text("\n".join(["run", *NAMES, ""]), encoding="utf-8")
    return batches


def stacked(batches, inputs):
    """Temperatures, rises since a batch's first row, or both, in this order."""
    degC = np.vstack([batch[0] for batch in batches])
    rise = np.vstack([batch[0] - batch[0][0] for batch in batches])
    kinds = {"temperature": degC, "rise": rise, "both": np.hstack((degC, rise))}
    return kinds[inputs], np.concatenate([batch[1] for batch in batches])


def of_sklearn(method, x, y):
    """Slopes and intercept."""
    if method == "pcr":
        model = make_pipeline(PCA(n_components=3, svd_solver="full"), LinearRegression()).fit(x, y)
        slope = model[0].components_.T @ model[1].coef_
        return slope, y.mean() - x.mean(axis=0) @ slope
    model = Ridge(alpha=PENALTY_K2 * y.size, solver="svd").fit(x, y)
    return model.coef_, model.intercept_


def of_ballbar(folder, method, inputs):
    """Slopes and intercept."""
    command = [ballbar, "train", str(folder / "runs.csv"), "--target", "z_um", "--method", method, "--inputs", inputs,
               "--out", str(folder / f"{method}-{inputs}.json")]
    command += ["--components", "3"] if method == "pcr" else ["--penalty", str(PENALTY_K2)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: expected status 0, found {done.returncode}: {done.stderr.strip()}")
    model = json.loads(pathlib.Path(command[command.index("--out") + 1]).read_text(encoding="utf-8"))
    if model["sensors"] != SENSORS:
        sys.exit(f"{' '.join(command)}: expected the sensors {SENSORS}, found {model['sensors']}.")
    return np.array(model["slope_um_per_K"]), model["intercept_um"]


wrong = []
print(f"{'method':8}{'inputs':14}{'slopes apart':>14}{'intercept apart':>18}   relative to the norm, to the target's RMS")
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    batches = made_batches(folder)
    for method in ("pcr", "ridge"):
        for inputs in ("temperature", "rise", "both"):
            x, y = stacked(batches, inputs)
            slope, intercept_um = of_sklearn(method, x, y)
            ours, our_intercept_um = of_ballbar(folder, method, inputs)
            if ours.shape != slope.shape:
                sys.exit(f"{method}, inputs {inputs}: expected {slope.size} slopes, found {ours.size}.")
            apart = np.linalg.norm(ours - slope) / np.linalg.norm(slope)
            intercept_apart = abs(our_intercept_um - intercept_um) / np.sqrt(np.mean(y**2))
            print(f"{method:8}{inputs:14}{apart:14.1e}{intercept_apart:18.1e}")
            if not max(apart, intercept_apart) < TOLERANCE:  # NaN is wrong, too
                wrong.append(f"{method}, inputs {inputs}")
if wrong:
    sys.exit(f"expected the slopes and intercepts of scikit-learn to {TOLERANCE:g}, found others for {'; '.join(wrong)}.")
