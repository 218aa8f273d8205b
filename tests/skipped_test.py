"""Tests of skipped.py.

    python3 skipped_test.py
"""
import contextlib
import io
import pathlib
import tempfile
import unittest

import skipped

RESULTS = """<?xml version="1.0" encoding="UTF-8"?>
<testsuite>
  <testcase name="a" status="run"><system-out>fine</system-out></testcase>
  <testcase name="cli.program" status="run"><system-out>section colour skipped: there is no pseudo terminal here
program.txt: 6 sections, 0 differ
</system-out></testcase>
  <testcase name="hal" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/>
    <system-out>skipped: there are no user namespaces here
</system-out></testcase>
%s
  <testcase name="page" status="run"><system-out>ok 1 - done
ok 2 - not done # SKIP long: BALLBAR_ALL_SAME=1
﹣ nor this (0.1ms) # long: BALLBAR_ALL_SAME=1
</system-out></testcase>
  <testcase name="readme" status="run"><system-out>README.md: passed over what needs pandas</system-out></testcase>
</testsuite>
"""
EXTERNAL = """  <testcase name="external.%d  # GetParam() = 8-byte object &lt;D0-5C&gt;" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>
    <system-out>/x/data.hpp:11: Skipped
no folder of data

[  SKIPPED ] external.1 (0 ms)
</system-out></testcase>"""


def printed(results, configured):
    with tempfile.TemporaryDirectory() as folder:
        paths = [pathlib.Path(folder, name) for name in ("results.xml", "configured.log")]
        for path, text in zip(paths, (results, configured)):
            path.write_text(text, encoding="utf-8")
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            skipped.main(*map(str, paths))
        return out.getvalue()


class Printed(unittest.TestCase):
    def test_a_line_for_each_reason(self):
        configured = "-- Found X\n-- Left out: pictures (BALLBAR_IMAGES)\n-- tests/page: left out, for there is no chromium\n"
        self.assertEqual(
            printed(RESULTS % "\n".join(EXTERNAL % k for k in range(5)), configured),
            "Left out: pictures (BALLBAR_IMAGES)\n"
            "tests/page: left out, for there is no chromium\n"
            "Skipped (2), long: BALLBAR_ALL_SAME=1: page (not done), page (nor this)\n"
            "Skipped (5), no folder of data: external.0, external.1, external.2 and 2 more\n"
            "Skipped (1), python3 lacks pandas: readme (a block of README.md)\n"
            "Skipped (1), there are no user namespaces here: hal\n"
            "Skipped (1), there is no pseudo terminal here: cli.program (colour)\n",
        )

    def test_nothing(self):
        self.assertEqual(printed('<testsuite><testcase name="a"/></testsuite>', "-- Found X\n"),
                         "Nothing was skipped or left out.\n")


if __name__ == "__main__":
    unittest.main()
