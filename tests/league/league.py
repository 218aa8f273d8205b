"""A league of predictors: ballbar's beside scikit-learn's, on measured records, each judged by rows it was not trained on.

    league.py BALLBAR SAMPLE_RUNS [--folds N] [--only RECORD] [--target COLUMN] [--quick]

What is left out are whole runs, or all that comes after a row: never rows at random, which stand between neighbours
that are nearly alike (a small table shows what that would claim). BALLBAR_EXTERNAL_DATA names the folder of the measured
records; without it, or without scikit-learn, the status is 77. --folds takes so many folds of each record, evenly
spaced; --quick one fold and one target of each, without `add --auto`. Exit 1 where then a bound of kBounds does not hold.

Each predictor has the same columns: temperatures, and the speed where it is logged. Those of scikit-learn have them as
they are, as rises since the first row of the run, and the speed squared; "lagged" adds first-order low passes of rises
and speed with time constants of 10 min, 1 h and 4 h (without a clock of 10, 60 and 240 rows). The settings of
ridge and PLS are chosen within the training, by runs or stretches left out; trees are 200 of depth 3.
"""
import argparse
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time
import warnings

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"  # of scikit-learn: its rows are few

try:
    import numpy as np
    import pandas as pd
    from sklearn.cross_decomposition import PLSRegression
    from sklearn.ensemble import HistGradientBoostingRegressor
    from sklearn.linear_model import Ridge
    from sklearn.model_selection import GridSearchCV, GroupKFold, KFold
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import StandardScaler
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

kTimeConstants_s = (600.0, 3600.0, 14400.0)
kMostRows = 4000  # that scikit-learn is trained on, evenly spaced: neighbours are nearly alike
kStretches = 5    # of a single record, left out in turn where settings are chosen
kOrigins = {"spindle-46h": (3871, 4831, 5791)}  # changes of speed; of others half and three quarters of the rows
kAhead = 1920     # rows
# What --quick holds: of all rows within the interval of 95 % of ballbar's regression on effects, and its errors over
# the least of scikit-learn's, geometric mean over records.
kBounds = {"within": 0.80, "ratio": 1.25}


class Fold:
    """Training runs and one to predict, of which rows from `first` on are new; as files and as tables."""

    def __init__(self, train, test, first=0):
        self.train, self.test, self.first = train, test, first


class Record:
    def __init__(self, name, how, targets, folds, has_speed):
        self.name, self.how, self.targets, self.folds, self.has_speed = name, how, targets, folds, has_speed


class Run:
    """A file that ballbar reads, and its columns."""

    def __init__(self, path):
        self.path = path
        self.table = pd.read_csv(path, comment="#")
        self.has_clock = "# clock = false" not in path.read_text(encoding="utf-8")


def written(folder, name, source, rows=None, without=()):
    """The first rows of a series, without some columns, in a folder of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = source.read_text(encoding="utf-8").splitlines()
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    names = lines[head].split(",")
    kept = [i for i, one in enumerate(names) if one not in without]
    body = [",".join(line.split(",")[i] for i in kept) for line in lines[head : None if rows is None else head + 1 + rows]]
    path = folder / f"{name}.csv"
    path.write_text("\n".join(lines[:head] + body) + "\n", encoding="utf-8")
    return Run(path)


# ---- records

def later_stretches(folder, source, origins, name):
    folds, rows = [], len(Run(source).table)
    for origin in origins:
        train = written(folder / f"{name}-{origin}", "before", source, origin)
        test = written(folder / f"{name}-{origin}", "whole", source, min(rows, origin + kAhead))
        folds.append(Fold([train], test, origin))
    return folds


def runs_left_out(runs):
    return [Fold([other for other in runs if other is not run], run) for run in runs]


def records(data, samples, folder, ballbar):
    spindle = samples / "spindle-46h" / "measured.csv"
    yield Record("spindle-46h", "later rows", [f"ch{k}_um" for k in (3, 1, 2, 4, 5)],
                 later_stretches(folder, spindle, kOrigins["spindle-46h"], "spindle-46h"), True)
    sets = [data / "spindle-24krpm" / f"set-{number}.csv" for number in ("02", "04")]
    later = []
    for path in sets:
        rows = len(Run(path).table)
        later += later_stretches(folder, path, (rows // 2, 3 * rows // 4), path.stem)
    yield Record("spindle-24krpm", "later rows", ["z_um"], later, True)
    both = [written(folder / "24krpm", path.stem, path) for path in sets]
    yield Record("spindle-24krpm", "other record", ["z_um"], runs_left_out(both), True)
    listed = pd.read_csv(data / "lathe-chamber" / "runs.csv", comment="#", dtype={"run": str})
    runs = [written(folder / "lathe", name, data / "lathe-chamber" / f"{name}.csv", None, ("PT10_degC",))
            for name in listed["run"]]
    yield Record("lathe-chamber", "whole runs", ["z_um", "x_um"], runs_left_out(runs), False)
    days = []
    for sheet in range(1, 19):
        path = folder / "ace" / f"day{sheet:02}.csv"
        path.parent.mkdir(exist_ok=True)
        asked(ballbar, "import", data / "ace" / "ACE_X.xlsx", "--join", data / "ace" / "ACE_Y.xlsx", "--sheet", sheet,
              "--unit", "Dia Disp=um", "--out", path)
        days.append(Run(path))
    yield Record("ace", "whole days", ["Dia_Disp_um"], runs_left_out(days), False)


# ---- ballbar

class Refused(Exception):
    """What the program said where it does not take the data."""


def asked(ballbar, *arguments):
    done = subprocess.run([str(ballbar), *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Refused(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")


def predicted_by(path, target):
    table = pd.read_csv(path, comment="#")
    stem = target.rsplit("_", 1)[0] if target.endswith("_um") else target
    half = f"{stem}_half_width_um"
    return table[f"{stem}_model_um"].to_numpy(), table[half].to_numpy() if half in table else None


def by_effects(*more):
    def predict(ballbar, fold, target, folder):
        asked(ballbar, "train", *(run.path for run in fold.train), "--effects", *more, "--target", target,
              "--out", folder / "model.json")
        asked(ballbar, "predict", fold.test.path, "--model", folder / "model.json", "--out", folder / "predicted.csv")
        return predicted_by(folder / "predicted.csv", target)
    return predict


def by_temperatures(method):
    def predict(ballbar, fold, target, folder):
        parent = fold.train[0].path.parent
        if len(fold.train) < 2:
            return None
        names = parent / "left.csv"  # a list stands beside its files
        names.write_text("\n".join(["run", *(run.path.stem for run in fold.train)]) + "\n", encoding="utf-8")
        asked(ballbar, "train", names, "--method", method, "--target", target, "--keep-broken", "--out",
              folder / "model.json")
        asked(ballbar, "predict", fold.test.path, "--model", folder / "model.json", "--anyway", "--out",
              folder / "predicted.csv")
        return predicted_by(folder / "predicted.csv", target)
    return predict


def by_growth(ballbar, fold, target, folder):
    """`add --auto` from the speed alone, squared behind a low pass; of one record."""
    if len(fold.train) > 1 or "speed_rpm" not in fold.test.table:
        return None
    start = folder / "start.toml"
    start.write_text(f'format = "ballbar-model 1"\ntarget = ["{target}"]\n\n[[effect]]\nname = "speed_heating"\n'
                     'speed = "speed_rpm"\nexponent = 2.0\n', encoding="utf-8")
    asked(ballbar, "add", "--auto", fold.train[0].path, "--model", start, "--target", target, "--out",
          folder / "grown.toml")
    asked(ballbar, "predict", fold.train[0].path, "--model", folder / "grown.toml", "--target", target, "--on",
          fold.test.path, "--out", folder / "predicted.csv")
    return predicted_by(folder / "predicted.csv", target)


# ---- scikit-learn

def low_pass(time_s, values, tau_s):
    """Exact where the values are straight lines between the rows, as ballbar's."""
    out = np.empty_like(values)
    out[0] = values[0]
    for i in range(1, len(values)):
        dt_s = time_s[i] - time_s[i - 1]
        towards = -np.expm1(-dt_s / tau_s)
        out[i] = out[i - 1] + towards * (values[i - 1] - out[i - 1]) + (values[i] - values[i - 1]) * (1 - towards * tau_s / dt_s)
    return out


def features(run, lagged):
    key = "lagged" if lagged else "plain"
    if not hasattr(run, key):
        table = run.table
        degC = table[[name for name in table if name.endswith("_degC")]].interpolate(limit_direction="both").to_numpy()
        rise = degC - degC[0]
        speed = table[["speed_rpm"]].to_numpy() / 1000.0 if "speed_rpm" in table else np.zeros((len(table), 0))
        inputs = [degC, rise, speed, speed**2]
        if lagged:
            time_s = table["time_s"].to_numpy()
            for tau_s in kTimeConstants_s:
                inputs.append(low_pass(time_s, np.hstack((rise, speed, speed**2)), tau_s if run.has_clock else tau_s / 60.0))
        setattr(run, key, np.hstack(inputs))
    return getattr(run, key)


def training_rows(fold, target, lagged):
    """Inputs, target, and the group of each row: its run, or its stretch of the only one."""
    x, y, group = [], [], []
    for number, run in enumerate(fold.train):
        um = run.table[target].to_numpy()
        rows = np.flatnonzero(np.isfinite(um))
        x.append(features(run, lagged)[rows])
        y.append(um[rows])
        group.append(np.full(len(rows), number))
    x, y, group = np.vstack(x), np.concatenate(y), np.concatenate(group)
    if len(fold.train) < 2:
        group = np.arange(len(y)) * kStretches // len(y)
    every = -(-len(y) // kMostRows)
    return x[::every], y[::every], group[::every]


def chosen(model, grid, x, y, group):
    """The setting of the least squared error of groups left out, on all rows."""
    folds = GroupKFold(min(kStretches, len(np.unique(group))))
    return GridSearchCV(model, grid, scoring="neg_mean_squared_error", cv=folds).fit(x, y, groups=group)


def sklearn_model(kind, x, y, group):
    if kind == "ridge":
        return chosen(make_pipeline(StandardScaler(), Ridge()), {"ridge__alpha": np.logspace(-2, 6, 9)}, x, y, group)
    if kind == "PLS":
        return chosen(PLSRegression(), {"n_components": [1, 2, 3, 5, 8, 12]}, x, y, group)
    return HistGradientBoostingRegressor(max_depth=3, max_iter=200, random_state=1, early_stopping=False).fit(x, y)


def by_sklearn(kind, lagged):
    def predict(_ballbar, fold, target, _folder):
        model = sklearn_model(kind, *training_rows(fold, target, lagged))
        return np.ravel(model.predict(features(fold.test, lagged))), None
    return predict


def by_nothing(_ballbar, fold, target, _folder):
    """The last value held; of runs left out the mean of all others."""
    um = fold.test.table[target].to_numpy()
    value = um[: fold.first][-1] if fold.first else np.nanmean(np.concatenate([run.table[target] for run in fold.train]))
    return np.full(len(um), value), None


kPredictors = {
    "train": by_effects(),
    "train --few": by_effects("--few"),
    "train --method pcr": by_temperatures("pcr"),
    "train --method ridge": by_temperatures("ridge"),
    "add --auto": by_growth,
    "sklearn ridge": by_sklearn("ridge", False),
    "sklearn ridge, lagged": by_sklearn("ridge", True),
    "sklearn PLS, lagged": by_sklearn("PLS", True),
    "sklearn trees, lagged": by_sklearn("trees", True),
    "last value or mean": by_nothing,
}


# ---- the table

def cpu_s():
    """Of this process and of the programs that it ran: the load of the machine does not change it much."""
    return sum(sum(resource.getrusage(who)[:2]) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


class Score:
    def __init__(self):
        self.squares, self.rows, self.worst, self.within, self.with_interval = 0.0, 0, 0.0, 0, 0
        self.folds, self.cpu_s = 0, 0.0

    def add(self, fold, target, um, half_um, spent_s):
        measured = fold.test.table[target].to_numpy()[fold.first :]
        error = measured - um[fold.first :]
        known = np.isfinite(measured)
        if not np.isfinite(error[known]).all():
            sys.exit(f"{fold.test.path.name}, {target}: expected a prediction of every row, found none of some.")
        squares = float(np.sum(error[known] ** 2))
        self.squares += squares
        self.rows += int(known.sum())
        self.worst = max(self.worst, (squares / known.sum()) ** 0.5)
        if half_um is not None:
            self.within += int(np.sum(np.abs(error[known]) <= half_um[fold.first :][known]))
            self.with_interval += int(known.sum())
        self.folds += 1
        self.cpu_s += spent_s

    @property
    def rmse(self):
        return (self.squares / self.rows) ** 0.5

    @property
    def within_share(self):
        return self.within / self.with_interval if self.with_interval else None


def some(folds, most):
    if most is None or len(folds) <= most:
        return folds
    return [folds[(2 * i + 1) * len(folds) // (2 * most)] for i in range(most)]


def league_of(record, target, ballbar, folds, without):
    scores = {}
    for name, predict in kPredictors.items():
        if name in without:
            continue
        score = Score()
        for fold in folds:
            with tempfile.TemporaryDirectory() as folder:
                began_s = cpu_s()
                try:
                    result = predict(ballbar, fold, target, pathlib.Path(folder))
                except Refused as why:
                    print(f"{record.name}, {target}, {name}: refused: {why}", file=sys.stderr)
                    result = None
                if result is None:
                    break
                score.add(fold, target, *result, cpu_s() - began_s)
        else:
            scores[name] = score
    return scores


def printed(record, target, scores):
    best = min(score.rmse for score in scores.values())
    for name, score in scores.items():
        share = "" if score.within_share is None else f"{100 * score.within_share:.0f}"
        print(f"{record.name:15} {record.how:13} {target:9} {score.folds:5}  {name:22} {score.rmse:7.2f}"
              f"{'*' if score.rmse == best else ' '} {score.worst:8.2f} {share:>9} {score.cpu_s / score.folds:8.1f}", flush=True)
    print(flush=True)


def rows_at_random(record, target, folds, scores):
    """What five folds of shuffled rows would claim, beside what whole runs or later rows show."""
    everything = Fold(list({id(run): run for fold in folds for run in fold.train}.values()), None)
    if len(folds[0].train) == 1:
        everything = Fold([folds[-1].test], None)
    x, y, group = training_rows(everything, target, True)
    for kind in ("ridge", "trees"):
        name = f"sklearn {kind}, lagged"
        squares = 0.0
        for train, test in KFold(5, shuffle=True, random_state=1).split(x):
            squares += float(np.sum((np.ravel(sklearn_model(kind, x[train], y[train], group[train]).predict(x[test])) - y[test]) ** 2))
        claimed = (squares / len(y)) ** 0.5
        print(f"{record.name:15} {target:9} {name:22} {claimed:14.2f} {scores[name].rmse:19.2f} {scores[name].rmse / claimed:8.1f}",
              flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("ballbar", type=pathlib.Path)
    parser.add_argument("samples", type=pathlib.Path)
    parser.add_argument("--folds", type=int)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only")
    parser.add_argument("--target")
    options = parser.parse_args()
    external = os.environ.get("BALLBAR_EXTERNAL_DATA")
    if external is None:
        print("skipped: BALLBAR_EXTERNAL_DATA does not name a folder")
        sys.exit(77)
    data = pathlib.Path(external)
    warnings.filterwarnings("ignore")
    began_s = time.monotonic()
    print(f"{'record':15} {'left out':13} {'target':9} {'folds':>5}  {'predictor':22} {'RMSE um':>8} {'worst um':>8} "
          f"{'within %':>9} {'CPU s':>8}")
    within, with_interval, ratios, random = 0, 0, [], []
    with tempfile.TemporaryDirectory() as name:
        for record in records(data, options.samples.resolve(), pathlib.Path(name), options.ballbar):
            if options.only not in (None, record.name):
                continue
            folds = some(record.folds, 1 if options.quick else options.folds)
            for target in record.targets[: 1 if options.quick else None]:
                if options.target not in (None, target):
                    continue
                scores = league_of(record, target, options.ballbar, folds, ("add --auto",) if options.quick else ())
                printed(record, target, scores)
                within += scores["train"].within
                with_interval += scores["train"].with_interval
                ratios.append(scores["train"].rmse / min(s.rmse for n, s in scores.items() if n.startswith("sklearn")))
                if (record.name, target) in (("spindle-46h", "ch3_um"), ("lathe-chamber", "z_um")):
                    random.append((record, target, folds, scores))
        share, ratio = within / with_interval, float(np.exp(np.mean(np.log(ratios))))
        print(f"train: {100 * share:.0f} % of all rows within its interval of 95 %; its RMSE over the least of scikit-learn's: "
              f"{ratio:.2f} (geometric mean of {len(ratios)})")
        if random:
            print(f"\n{'record':15} {'target':9} {'predictor':22} {'rows at random':>14} {'as in the league um':>19} {'times':>8}")
        for one in random:
            rows_at_random(*one)
    print(f"\n{time.monotonic() - began_s:.0f} s in all")
    if not options.quick:
        return
    if share < kBounds["within"]:
        sys.exit(f"expected at least {100 * kBounds['within']:.0f} % of rows within the interval of train, found {100 * share:.0f} %.")
    if ratio > kBounds["ratio"]:
        sys.exit(f"expected train at most {kBounds['ratio']} times the least error of scikit-learn, found {ratio:.2f}.")


if __name__ == "__main__":
    main()
