"""Every name of the package is documented and typed, and the examples hold."""
import doctest
import importlib
import importlib.util
import inspect
import os
import re
import subprocess
import sys
import tempfile
import typing
import unittest

import ballbar as bb
from ballbar import _functions, _kinds

USER = """
import ballbar as bb
table = bb.read("run.csv")
model: bb.Model = bb.Model("y_um", ["expansion(T_degC)"]) + bb.LaggedExpansion("T_degC", time_constant_s=bb.free(1800.0))
fit = model.fit(table, robust=True)
rmse: float = fit.rmse_um
found: bb.Diagnosis = fit.diagnose()
better = model + found.best
sentence: str = better.fit(table).compare(fit).sentence
low = fit.predict(table.iloc[5:])["y_um_low"]
summary: str = fit.summary() + f"{fit.aic} {fit.bic} {fit.log_likelihood} {fit.r_squared}"
stepped = bb.read("run.csv", every="10s", units={"T": "degF"})
centre: float = bb.fit_circle([100.0, 100.1], angle_deg=[0.0, 90.0]).recordings[0].centre_a_um
rows: int = len(bb.drift("session.toml").points)
"""


def functions():
    return [value for _, value in inspect.getmembers(_functions, inspect.isfunction) if value.__module__ == _functions.__name__]


def results():
    return [value for _, value in inspect.getmembers(_kinds, inspect.isclass) if issubclass(value, bb.Result) and value is not bb.Result]


class Docs(unittest.TestCase):
    def test_examples(self):
        for name in ("_core", "_measure", "_model", "_terms", "fleet", "plot", "sklearn"):
            needs = {"fleet": "dask", "plot": "matplotlib", "sklearn": "sklearn"}.get(name)
            if needs and importlib.util.find_spec(needs) is None:
                continue
            found = doctest.testmod(importlib.import_module(f"ballbar.{name}"), verbose=False)
            self.assertEqual(found.failed, 0, name)
            self.assertGreater(found.attempted, 0, name)

    def test_every_name(self):
        for name in bb.__all__:
            self.assertTrue(inspect.getdoc(getattr(bb, name)), name)
        for function in [*functions(), bb.read, bb.write, bb.fit_circle, bb.effect, bb.Model.fit, bb.Fit.diagnose]:
            text = inspect.getdoc(function)
            for heading in ("Parameters",) if function is bb.write else ("Parameters", "Returns"):
                self.assertRegex(text, rf"(?m)^{heading}\n-+$", function.__name__)
            for name, one in inspect.signature(function).parameters.items():
                if name == "self" or one.kind is inspect.Parameter.VAR_KEYWORD:
                    continue
                self.assertRegex(text, rf"(?m)^{name}\b[^\n]*:[^\n]*\n +\S", f"{function.__name__}: {name}")
        for kind in (bb.Series, bb.Recording):
            for name, value in vars(kind).items():
                self.assertTrue(name.startswith("_") or value.__doc__, name)

    def test_every_attribute_has_a_meaning_and_a_type(self):
        attributes = 0
        for kind in results():
            hints = typing.get_type_hints(kind)
            for name in kind.__dict__.get("__annotations__", ()):
                self.assertIn(name, hints)
                self.assertRegex(inspect.getdoc(kind), rf"(?m)^{name} : .+\n {{4}}\S", f"{kind.__name__}.{name}")
                attributes += 1
        self.assertGreater(attributes, 300)
        for function in [*functions(), bb.read, bb.fit_circle, bb.effect, bb.free, bb.Model.fit, bb.Fit.diagnose, bb.Fit.compare]:
            self.assertIn("return", typing.get_type_hints(function), function.__name__)

    def test_every_key_is_an_attribute_of_its_class(self):
        he, hidden = "sample-runs/two-arcs-he2015", "sample-runs/hidden-effect/01/"
        fit = bb.Model.load(f"{he}/model.toml").fit(he)
        with tempfile.TemporaryDirectory() as folder:
            trained = bb.train(hidden + "data.csv", target="z_um", out=f"{folder}/model.json", effects=True)
        for result in (
            bb.circles("sample-runs/qc20-style-b5r/00.b5r"), bb.drift(he), bb.drift(f"{he}/five-probe.csv", from_plane_1_mm=0), bb.compare(he),
            bb.history("sample-runs/machine-history"), bb.import_log("sample-runs/foreign-logs/warmup.csv"), bb.effects(), fit, fit.could(),
            fit.diagnose(), bb.machine_errors("sample-runs/qc20-style-b5r/00.b5r"), fit.test("expansion(T_room_degC)"), trained,
            bb.could(he, effect="expansion(T_room_degC)", amplitude_um=2.0, model=f"{he}/model.toml"), bb.report(he, model=f"{he}/model.toml"),
            bb.compensate(model="sample-runs/spindle-rotation-huang2022/mean-point.toml", on="sample-runs/spindle-rotation-huang2022", to="z"),
        ):
            self.keys(result)

    def keys(self, result):
        kind = type(result)
        if kind is bb.Result:  # a table of names
            for value in result:
                if isinstance(result[value], bb.Result):
                    self.keys(result[value])
            return
        known = {key for base in kind.__mro__ for key in base.__dict__.get("__annotations__", {})}
        keyed = set(re.findall(r"(?m)^(\w+) :", inspect.getdoc(kind)))
        for key in result:
            if not any(name.isupper() for name in keyed):  # whose keys are known once it is made
                of_unit = {name for name in known | keyed if name.endswith("_UNIT") and key.startswith(name[: -len("UNIT")])}
                self.assertIn(key, known | keyed | ({key} if of_unit else set()), kind.__name__)
            value = result[key]
            for one in value if isinstance(value, bb.Rows) else [value]:
                if isinstance(one, bb.Result):
                    self.keys(one)

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
    def test_types(self):
        package = os.path.dirname(bb.__file__)
        strict = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--allow-untyped-calls", "--cache-dir", os.devnull]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "user.py")
            with open(path, "w", encoding="utf-8") as file:
                file.write(USER)
            for what in (package, path):
                done = subprocess.run([*strict, what], stdout=subprocess.PIPE, text=True, check=False, env={**os.environ, "MYPYPATH": os.path.dirname(package)})
                self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    unittest.main()
