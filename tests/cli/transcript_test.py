"""Tests of transcript.py: what it reads, what it tells apart, what it writes.

    python3 transcript_test.py
"""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import transcript

PROGRAM = '#!/bin/sh\necho "$1"\necho "$2" >&2\nexit "$3"\n'


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file, self.program = pathlib.Path(folder.name, "some.txt"), pathlib.Path(folder.name, "ballbar")
        self.program.write_text(PROGRAM, encoding="utf-8")
        self.program.chmod(0o755)

    def ended(self, text, *words):
        """(exit status, what is printed) of a transcript with this text."""
        self.file.write_text(text, encoding="utf-8", errors="surrogateescape")
        printed = io.StringIO()
        printed.reconfigure = lambda **_: None
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed), \
                unittest.mock.patch.object(sys, "argv", ["transcript.py", str(self.program), str(self.file), *words]):
            try:
                transcript.main()
            except SystemExit as end:
                return end.code, printed.getvalue()
        raise AssertionError("expected an end")

    def holds(self, text):
        code, printed = self.ended(text)
        self.assertEqual(code, 0, printed)

    def fails(self, text, *parts):
        code, printed = self.ended(text)
        self.assertEqual(code, 1, printed)
        for part in parts:
            self.assertIn(part, printed)

    def test_streams_and_status(self):
        self.holds("# a: A.\n\n  $ ballbar out err 3\n  out\n  ! err\n  [3]\n")
        self.fails("# a: A.\n\n  $ ballbar out err 3\n  out\n  ! err\n", "a, some.txt:3: $ ballbar out err 3",
                   "status: expected 0, came 3")
        self.fails("# a: A.\n\n  $ ballbar out err 0\n  out\n  err\n", "stdout", "-err", "stderr", "+err")
        self.fails("# a: A.\n\n  $ ballbar out err 0\n  other\n  ! err\n", "-other", "+out")

    def test_the_first_section_alone(self):
        text = "# a: A.\nwith PDF\n\n  $ echo 1\n  2\n\n# b: B.\n\n  $ echo 1\n  1\n\n# c: C.\n\n  $ echo 1\n  2\n"
        code, printed = self.ended(text, "--first", "--without=PDF")
        self.assertEqual((code, printed), (0, "some.txt: 1 sections, 0 differ\n"))

    def test_a_shell_with_further_lines_goes_on_after_a_failure(self):
        self.holds("# a: A.\n\n  $ word=x\n  $ cat <<END\n  > one $word\n  >\n  > two\n  > END\n  one x\n\n  two\n  $ false\n  [1]\n"
                   "\nA remark.\n\n  $ echo $word; ls\n  x\n  sample-runs\n\n# b: B.\n\n  $ echo \"$word\"\n\n")

    def test_a_shell_that_ends(self):
        self.fails("# a: A.\n\n  $ exit 3\n  [3]\n  $ echo x\n  x\n", "$ echo x", "not run, for the shell ended before")

    def test_lines_that_look_like_others(self):
        for text in ("$ x\n", "> x\n", "! x\n", "!\n", "[1]\n", "\\x\n", "\\\n", "\n", "\n\n", " x\n", "x", "\\", "x\n\n", "#\n", "é\n", "\udcff\n"):
            output = transcript.Output(text, text, 7)
            lines = transcript.output_lines(output)
            self.assertEqual(transcript.Step("", 0, 0, [line[2:] for line in lines]).expected, output, repr(text))

    def test_numbers(self):
        same = "# a: A.\n{}\n  $ echo 0.12345678901\n  {}\n"
        self.holds(same.format("", "0.12345678902"))
        self.fails(same.format("", "0.12346678901"))
        self.holds(same.format("tolerance 1e-3: Rounded.\n", "0.12346678901"))
        self.assertIn("tolerance NUMBER: REASON", self.ended(same.format("tolerance 1e-3\n", "0.12346678901"))[0])

    def test_what_is_run(self):
        text = "# fast: A.\n\n  $ false\n\n# late: B.\nslow\n\n  $ false\n\n# drawn: C.\nwith PAGE, PDF\n\n  $ false\n"
        self.assertEqual([word for word in ("fast", "late", "drawn") if f"{word}, some.txt" in self.ended(text, "--slow")[1]], ["late"])
        self.assertEqual([word for word in ("fast", "late", "drawn") if f"{word}, some.txt" in self.ended(text, "--quick")[1]],
                         ["fast", "drawn"])
        self.assertIn("3 sections, 3 differ", self.ended(text)[1])
        self.assertIn("2 sections, 2 differ, 1 left out", self.ended(text, "--without=PDF")[1])
        self.assertIn("1 sections, 1 differ\n", self.ended(text, "rawn")[1])
        self.assertIn("found none", self.ended(text, "absent")[0])
        self.assertIn("0 sections, 0 differ, 1 left out", self.ended("# a: A.\nwithout PAGE\n\n  $ false\n")[1])
        self.assertIn("1 sections, 1 differ\n", self.ended("# a: A.\nwithout PAGE\n\n  $ false\n", "--without=PAGE")[1])
        self.assertIn("expected a command in a", self.ended("# a: A.\n\n# b: B.\n\n  $ false\n")[0])
        self.assertIn("expected some of", self.ended("# a: A.\nwith PAEG\n\n  $ false\n")[0])

    def test_skipped(self):
        code, printed = self.ended("# a: A.\n\n  $ echo no terminal >&2; exit 77\n  $ echo x\n")
        self.assertEqual((code, printed), (0, "section a skipped: no terminal\nsome.txt: 1 sections, 0 differ\n"))

    def test_update_writes_what_is_not_the_same(self):
        text = "# a: A.\n\n  $ echo 0.12345678901\n  0.12345678902\n  $ ballbar out err 2\n{}\nA remark.\n\n  $ printf x\n  {}\n"
        code, _ = self.ended(text.format("  no\n", "x"), "--update")
        self.assertEqual(code, 0)
        self.assertEqual(self.file.read_text(encoding="utf-8"), text.format("  out\n  ! err\n  [2]\n", "x\n  \\"))


if __name__ == "__main__":
    unittest.main()
