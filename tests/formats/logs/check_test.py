"""The generator writes the same files each time, and check.py finds each fault of a program that knows the truth."""

import hashlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
FAULTS = ("refuses", "reads all", "no line", "misuse", "time", "value", "unit", "no unit", "row", "column", "missing")


def python(*arguments, fault=""):
    environment = os.environ | {"ORACLE_FAULT": fault, "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run([sys.executable, *map(str, arguments)], capture_output=True, text=True, env=environment)


def digest(folder):
    return [(p.name, hashlib.sha256(p.read_bytes()).hexdigest()) for p in sorted(folder.iterdir())]


def expect(what, holds, said=""):
    if not holds:
        sys.exit(f"{what}\n{said}")


def main():
    with tempfile.TemporaryDirectory() as text:
        folders = [Path(text) / "first", Path(text) / "second"]
        for folder in folders:
            made = python(HERE / "generator" / "make.py", folder)
            expect("make.py fails", made.returncode == 0, made.stderr)
        expect("two runs of make.py differ", digest(folders[0]) == digest(folders[1]))
        truths = len(list(folders[0].glob("*.truth.json")))
        expect(f"{truths} files, expected at least 140", truths >= 140)
        check = (HERE / "check.py", HERE / "oracle.py", folders[0])
        for harmless in ("", "no optional"):
            whole = python(*check, fault=harmless)
            expect("the truth itself is found wrong", whole.returncode == 0, whole.stdout + whole.stderr)
        for fault in FAULTS:
            part = python(*check, "_01", fault=fault)      # a few files of each family are enough
            expect(f"the fault '{fault}' is not found", part.returncode == 1, part.stdout + part.stderr)


if __name__ == "__main__":
    main()
