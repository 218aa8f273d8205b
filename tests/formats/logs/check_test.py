"""The generator writes the same files each time, and check.py finds each fault of a program that knows the truth."""

import contextlib
import hashlib
import io
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE))
import check    # noqa: E402
import oracle   # noqa: E402

FAULTS = ("refuses", "reads all", "no line", "misuse", "time", "value", "unit", "no unit", "row", "column", "missing")


def oracle_called(command, **_):
    """What subprocess.run answers of the oracle, called here: a thousand processes would take minutes."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = oracle.main([str(word) for word in command[1:]])
    return subprocess.CompletedProcess(command, status, out.getvalue(), err.getvalue())


def judged(folder, part="", fault=""):
    """The exit status of check.py and what it printed."""
    os.environ["ORACLE_FAULT"] = fault
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        status = check.main(HERE / "oracle.py", folder, part)
    return status, out.getvalue()


def digest(folder):
    return [(p.name, hashlib.sha256(p.read_bytes()).hexdigest()) for p in sorted(folder.iterdir())]


def expect(what, holds, said=""):
    if not holds:
        sys.exit(f"{what}\n{said}")


def main():
    with tempfile.TemporaryDirectory() as text:
        folders = [Path(text) / "first", Path(text) / "second"]
        for folder in folders:
            made = subprocess.run([sys.executable, "-B", HERE / "generator" / "make.py", folder], capture_output=True, text=True)
            expect("make.py fails", made.returncode == 0, made.stderr)
        expect("two runs of make.py differ", digest(folders[0]) == digest(folders[1]))
        truths = len(list(folders[0].glob("*.truth.json")))
        expect(f"{truths} files, expected at least 140", truths >= 140)
        called, check.subprocess.run = check.subprocess.run, oracle_called
        for harmless in ("", "no optional"):
            status, said = judged(folders[0], fault=harmless)
            expect("the truth itself is found wrong", status == 0, said)
        for fault in FAULTS:
            status, said = judged(folders[0], "_01", fault)      # a few files of each family are enough
            expect(f"the fault '{fault}' is not found", status == 1, said)
        check.subprocess.run = called
        # As a program of its own, called as one.
        os.environ["ORACLE_FAULT"] = ""
        whole = subprocess.run([sys.executable, "-B", HERE / "check.py", HERE / "oracle.py", folders[0], "catman_01"],
                               capture_output=True, text=True)
        expect("check.py fails as a program", whole.returncode == 0, whole.stdout + whole.stderr)


if __name__ == "__main__":
    main()
