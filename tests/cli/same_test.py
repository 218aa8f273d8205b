"""Tests of same.py: what it tells apart, and what it does not.

    python3 same_test.py
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import same


def differ(a, b, tolerance=same.kTolerance):
    return bool(same.differences(a, b, tolerance))


def json_differ(a, b, tolerance=same.kTolerance):
    return differ(json.dumps(a, indent=2), json.dumps(b, indent=2), tolerance)


class Text(unittest.TestCase):
    def test_numbers_of_many_digits_to_1e_9_of_themselves(self):
        self.assertFalse(differ("gain = 0.2737634828364261\n", "gain = 0.27376348283642604\n"))
        self.assertFalse(differ("gain = 0.27376348280\n", "gain = 0.27376348299\n"))
        self.assertTrue(differ("gain = 0.27376348280\n", "gain = 0.27376348320\n"))
        self.assertTrue(differ("1.2345678901234e-05\n", "1.2345679901234e-05\n"))
        self.assertFalse(differ("1.2345678901234e-05\n", "1.2345679901234e-05\n", 1e-6))

    def test_few_digits_by_one_in_the_last(self):
        self.assertFalse(differ("rms 0.20 um\n", "rms 0.21 um\n"))
        self.assertTrue(differ("rms 0.20 um\n", "rms 0.22 um\n"))
        self.assertTrue(differ("rms 0.20 um\n", "rms 0.201 um\n"))
        self.assertTrue(differ("0.12345678\n", "0.12345679\n"))  # eight digits are a number to be held

    def test_of_many_numbers_only_a_few_in_the_last_digit(self):
        rows = [f"{k}.10 {k}.20\n" for k in range(10)]
        moved = ["0.11 0.21\n", "1.11 1.20\n", *rows[2:]]
        self.assertFalse(differ("".join(rows), "".join(moved)))
        moved[2] = "2.11 2.20\n"
        self.assertTrue(differ("".join(rows), "".join(moved)))

    def test_columns_make_up_for_a_longer_number(self):
        self.assertFalse(differ("  9.99  a\n", " 10.00  a\n"))
        self.assertFalse(differ("9.99   a\n", "10.00  a\n"))
        self.assertTrue(differ("  9.99  a\n", "  9.99   a\n"))
        self.assertTrue(differ("9.99 a\n", "10.00a\n"))

    def test_text(self):
        self.assertTrue(differ("It fails at 1.5 K.\n", "It holds at 1.5 K.\n"))
        self.assertTrue(differ("a\nb\n", "a\n"))
        self.assertTrue(differ("a\n", "a"))
        self.assertTrue(differ("1.5 2.5\n", "1.5\n"))
        self.assertTrue(differ("1.5 2.5\n", "1.5 2.5 3.5\n"))
        self.assertTrue(differ("1.5\n", "nan\n"))
        self.assertTrue(differ("nan\n", "inf\n"))

    def test_counts_are_text(self):
        self.assertTrue(differ("1000000000000 values\n", "1000000000001 values\n"))
        self.assertTrue(differ("14 %\n", "15 %\n"))
        self.assertTrue(differ("14.0\n", "14\n"))

    def test_the_sign(self):
        self.assertTrue(differ("0.1234567890123\n", "-0.1234567890123\n"))
        self.assertTrue(differ("0.00 um\n", "-0.00 um\n"))
        self.assertTrue(differ("1.5e-10\n", "1.5e+10\n"))

    def test_dates_versions_names_and_seals_are_text(self):
        for a, b in (("2026-01-15", "2026-01-16"), ("15.01.2026", "15.02.2026"), ("08:00:12.5", "08:00:12.6"),
                     ("1.2.3", "1.2.4"), ("version 1.2", "version 1.3"), ("v1.2", "v1.3"), ("run-1.5.csv", "run-1.6.csv"),
                     ("run-1.5", "run-1.6"), ("runs/1.5", "runs/1.6"), ("1.5-cold.csv", "1.6-cold.csv"),
                     ("a1.5", "a1.6"), ("12345678e4", "12345678e5"), ("seal 3e45f100", "seal 3e45f101")):
            self.assertTrue(differ(f"{a} x\n", f"{b} x\n"), a)

    def test_the_end_of_a_sentence(self):
        self.assertFalse(differ("It leaves 4.0. More.\n", "It leaves 4.1. More.\n"))

    def test_lines_that_are_the_same_are_not_shown(self):
        lines = same.differences("0.123456789012\nb\n", "0.123456789013\nc\n")
        self.assertFalse([line for line in lines if line.startswith(("-0.1", "+0.1"))])
        self.assertIn("-b", lines)


class Json(unittest.TestCase):
    def test_numbers_of_themselves_their_list_their_sigma_or_one(self):
        self.assertFalse(json_differ({"a": 1.0, "b": "x"}, {"a": 1 + 5e-10, "b": "x"}))
        self.assertTrue(json_differ({"a": 1.0}, {"a": 1 + 2e-9}))
        self.assertFalse(json_differ({"a": 1.0}, {"a": 1 + 2e-9}, 1e-8))
        self.assertFalse(json_differ([1.0, 1e-3], [1.0, 1e-3 + 5e-10]))
        self.assertTrue(json_differ([1.0, 1e-3], [1.0, 1e-3 + 2e-9]))
        self.assertFalse(json_differ({"value": 1e-3, "sigma": 1.0}, {"value": 1e-3 + 5e-10, "sigma": 1.0}))
        self.assertTrue(json_differ({"value": 1e-3}, {"value": 1e-3 + 5e-10}))
        self.assertFalse(json_differ({"p_value": 0.3}, {"p_value": 0.3 + 5e-10}))

    def test_few_of_a_list_in_the_seventh_digit(self):
        self.assertFalse(json_differ([0.1234567, 0.2345678], [0.1234568, 0.2345678]))
        self.assertTrue(json_differ([0.1234567, 0.2345678], [0.1234569, 0.2345678]))
        many = [[(1000001 + 2 * k + last) / 1e6 for k in range(100)] for last in (0, 1)]
        self.assertTrue(json_differ(*many))

    def test_keys_kinds_and_counts(self):
        self.assertTrue(json_differ({"a": 1}, {"b": 1}))
        self.assertTrue(json_differ({"a": 1, "b": 2}, {"b": 2, "a": 1}))
        self.assertTrue(json_differ({"a": None}, {"a": 0.0}))
        self.assertTrue(json_differ({"a": 1}, {"a": 1.0}))
        self.assertTrue(json_differ({"a": True}, {"a": 1}))
        self.assertTrue(json_differ([1.0, 2.0], [1.0]))
        self.assertTrue(json_differ({"rows": 10**12}, {"rows": 10**12 + 1}))
        self.assertTrue(json_differ({"a": 0.5}, {"a": -0.5}))
        self.assertTrue(json_differ({"a": 1.5}, {"a": float("nan")}))

    def test_sentences_and_layout(self):
        self.assertTrue(json_differ({"a": "x"}, {"a": "y"}))
        self.assertFalse(json_differ({"a": "falls to 0.43 um"}, {"a": "falls to 0.44 um"}))
        self.assertTrue(json_differ({"a": "falls to 0.43 um"}, {"a": "falls to 0.45 um"}))
        self.assertTrue(differ('{"a": 1}\n', '{"a":  1}\n'))
        self.assertFalse(json_differ({"made_on": "2026-01-01"}, {"made_on": "2026-01-02"}))


class Readme(unittest.TestCase):
    def test_any_lines(self):
        came = ["a", "gain 0.12345678901", "c", "d 1.5", "e"]
        for block in (came, ["..."], ["a", "..."], ["...", "e"], ["...", "gain 0.12345678902", "..."],
                      ["a", "...", "d 1.6", "..."], ["a", "...", "c", "...", "e"]):
            self.assertTrue(same.matches(block, came), block)
        for block in (came[:-1], ["b", "..."], ["...", "d 1.5"], ["...", "gain 0.123457", "..."], ["...", "d 1.7", "..."],
                      ["a", "...", "a", "..."], ["...", "e", "...", "e"], []):
            self.assertFalse(same.matches(block, came), block)
        self.assertTrue(same.matches([], []))


class Program(unittest.TestCase):
    def ended(self, a, b, *options):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder, name) for name in ("expected", "came")]
            for path, text in zip(paths, (a, b)):
                path.write_bytes(text)
            return subprocess.run([sys.executable, same.__file__, *map(str, paths), *options],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False).returncode

    def test_status(self):
        self.assertEqual(self.ended(b"a\n", b"a\n"), 0)
        self.assertEqual(self.ended(b"a\n", b"b\n"), 1)
        self.assertEqual(self.ended(b"\xff\n", b"\xfe\n"), 1)
        self.assertEqual(self.ended(b"1.00000001\n", b"1.00000002\n"), 1)
        self.assertEqual(self.ended(b"1.00000001\n", b"1.00000002\n", "--tolerance", "1e-7"), 0)


if __name__ == "__main__":
    unittest.main()
