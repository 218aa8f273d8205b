"""The examples of the docstrings hold, and so do the types."""
import doctest
import importlib
import importlib.util
import os
import subprocess
import sys
import unittest

import ballbar


class Docs(unittest.TestCase):
    def test_examples(self):
        for name in [*(f"ballbar.{one}" for one in ("_catalogue", "_core", "_logs", "_measure", "_models", "_predict", "_revisions", "_call", "fleet", "plot"))]:
            needs = {"ballbar.fleet": "dask", "ballbar.plot": "matplotlib"}.get(name)
            if needs and importlib.util.find_spec(needs) is None:
                continue
            found = doctest.testmod(importlib.import_module(name), verbose=False)
            self.assertEqual(found.failed, 0, name)
            self.assertGreater(found.attempted, 0, name)

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "mypy is not installed")
    def test_types(self):
        package = os.path.dirname(ballbar.__file__)
        done = subprocess.run(
            [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--allow-untyped-calls", "--implicit-reexport", "--cache-dir", os.devnull, package],
            stdout=subprocess.PIPE, text=True, check=False,
        )
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    unittest.main()
