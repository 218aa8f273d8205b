"""Each option of a command is an argument of its function, and each key of a result is one of its class."""
import inspect
import os
import re
import subprocess
import tempfile
import unittest

import ballbar

PROGRAM = os.environ["BALLBAR"]
NOT_OF_PYTHON = {"help", "json", "follow", "page", "open", "signals", "format", "all", "radius"}
FUNCTIONS = {
    "fit": [ballbar.fit], "errors": [ballbar.errors], "drift": [ballbar.drift], "compare": [ballbar.compare],
    "import": [ballbar.import_log, ballbar.merge], "history": [ballbar.history], "effects": [ballbar.effects],
    "could": [ballbar.preflight, ballbar.inject], "check": [ballbar.check], "diagnose": [ballbar.diagnose], "plan": [ballbar.plan],
    "add": [ballbar.add, ballbar.try_effect], "undo": [ballbar.undo], "ledger": [ballbar.ledger],
    "train": [ballbar.train, ballbar.select], "predict": [ballbar.predict], "compensate": [ballbar.compensate],
    "simulate": [ballbar.simulate], "report": [ballbar.report],
}
# What only the program has, or what another function of Python is for.
OF_THE_PROGRAM = {
    "diagnose": {"every", "hours", "patience", "keep"}, "errors": {"show"}, "effects": {"terms"}, "add": {"dry_run"}, "report": {"tool"},
    "history": {"table", "workers", "scheduler"},
    "simulate": {"hidden", "n", "schedule", "answers"},
    "compensate": {
        "from_picture", "start_degC", "expansion_ppm_per_K", "plot", "from_mm", "to_mm", "min_degC", "max_degC", "legend", "colours",
        "region", "edge_px", "vertical",
    },
}


def options_of(command):
    text = subprocess.run([PROGRAM, "help", command], stdout=subprocess.PIPE, text=True, check=True).stdout
    return {name.replace("-", "_") for name in re.findall(r"(?m)^  (?:-\w,)?--([\w-]+)", text)}


def trained(data, target="z_um", **how):
    with tempfile.TemporaryDirectory() as folder:
        return [ballbar.train(data, target, f"{folder}/model.json", **how)]


class Options(unittest.TestCase):
    def test_every_option_is_an_argument(self):
        for command, functions in FUNCTIONS.items():
            parameters = {name: one for function in functions for name, one in inspect.signature(function).parameters.items()}
            if any(one.kind is inspect.Parameter.VAR_KEYWORD for one in parameters.values()):
                continue
            known = {re.sub(r"_(s|mm|um|percent|min|rpm)$", "", name) for name in parameters} | set(parameters)
            for option in options_of(command) - NOT_OF_PYTHON - OF_THE_PROGRAM.get(command, set()):
                self.assertIn(option, known, f"{command}: --{option}")

    def test_a_flag_is_true_or_false_and_a_value_is_neither(self):
        he = "sample-runs/two-arcs-he2015"
        for wrong, sentence in (
            ({"robust": 1}, "robust: expected True or False, found 1."), ({"max_gap_s": True}, "max_gap: expected a value, found True."),
        ):
            with self.assertRaises(ballbar.UsageError) as told:
                ballbar.check(he, **wrong)
            self.assertEqual(str(told.exception), sentence)

    def test_documented(self):
        for name in ballbar.__all__:
            self.assertTrue(inspect.getdoc(getattr(ballbar, name)), name)
        for function in {ballbar.effect, ballbar.read_series, ballbar.read_recordings, *sum(FUNCTIONS.values(), [])}:
            for heading in ("Parameters", "Returns", "Raises"):
                self.assertRegex(inspect.getdoc(function), rf"(?m)^{heading}\n-+$", function.__name__)
        for function in sum(FUNCTIONS.values(), []):
            self.assertIn("Examples\n---", inspect.getdoc(function), function.__name__)
            for name in inspect.signature(function).parameters:
                self.assertRegex(inspect.getdoc(function), rf"\b{name}\b", function.__name__)
        for kind in (ballbar.Series, ballbar.Recording):
            for name, value in vars(kind).items():
                self.assertTrue(name.startswith("_") or value.__doc__, name)

    def test_keys_are_of_the_class(self):
        he, model = "sample-runs/two-arcs-he2015", "sample-runs/two-arcs-he2015/model.toml"
        hidden = "sample-runs/hidden-effect/01/"
        for result in (
            ballbar.fit("sample-runs/qc20-style-b5r/00.b5r"), ballbar.errors("sample-runs/machine-history"), ballbar.drift(he),
            ballbar.drift(f"{he}/five-probe.csv", from_plane_1_mm=0), ballbar.compare(he), ballbar.history("sample-runs/machine-history"),
            ballbar.import_log("sample-runs/foreign-logs/warmup.csv"), ballbar.effects(), ballbar.preflight(he, target="y_um"),
            ballbar.check(he, model), ballbar.diagnose(he, model), ballbar.errors("sample-runs/qc20-style-b5r/00.b5r", ranked=True),
            ballbar.try_effect("expansion(T_room_degC)", he, model), ballbar.inject("expansion(T_room_degC)", he, 2.0, model=model),
            ballbar.plan(hidden + "data.csv", hidden + "model.toml"), ballbar.report(he, model), ballbar.report(he, compare=f"{he}/five-probe.csv"),
            *trained(hidden + "data.csv", effects=True), *trained("sample-runs/batches-tan2024/runs.csv", target="y_um"),
        ):
            known = {key for base in type(result).__mro__ for key in base.__dict__.get("__annotations__", {})}
            for key in result:
                self.assertIn(key, known | {"with"}, type(result).__name__)
                said = next((base.__annotations__[key] for base in type(result).__mro__ if key in base.__dict__.get("__annotations__", {})), "")
                if said == "Rows" and not (type(result) is ballbar.Imported and key == "columns"):
                    self.assertIsInstance(result[key], ballbar.Rows, f"{type(result).__name__}.{key}")

    def test_empty_lists_are_what_they_are_lists_of(self):
        skipped = ballbar.errors("sample-runs/qc20-style-b5r").skipped
        self.assertEqual((type(skipped), skipped, len(skipped["file"])), (ballbar.Rows, [], 0))
        self.assertEqual(type(ballbar.Errors({"remarks": []}).remarks), list)
        self.assertEqual((2.0 * ballbar.Checked({"correlation": []}).correlation).shape, (0,))


if __name__ == "__main__":
    unittest.main()
