"""The guide, apps/README.md, has a row for every command of the program and for every verdict, and for no others; the manual
of diagnose has the same verdicts.

    python3 guide.py PROGRAM SOURCE_FOLDER
"""
import pathlib
import re
import subprocess
import sys

program, source = sys.argv[1], pathlib.Path(sys.argv[2])


def page(name):
    return (source / name).read_text(encoding="utf-8")


def first_words(text):
    """Of the first cell of each row of the tables."""
    return set(re.findall(r"(?m)^\| (\w+) \|", text)) - {"verdict"}


helped = subprocess.run([program, "help"], stdout=subprocess.PIPE, text=True, check=True).stdout
header = page("libballbar/include/ballbar/diagnosis/verdict/diagnosis.hpp")
guide = page("apps/README.md")
of_diagnose = re.search(r"(?ms)^\| verdict \| .*?\n\n", page("apps/diagnose/README.md"))[0]
commands = set(re.findall(r"(?m)^  (\w+) {2,}\w", helped)) - {"help"}
verdicts = set(re.findall(r"(?m)^\s*(\w+),", re.search(r"(?s)enum class Verdict \{(.*?)\}", header)[1]))
lists = {
    "commands of the guide": (commands, set(re.findall(r"`(\w+)", "".join(
        row.split(" | ")[1] for row in re.findall(r"(?m)^\| .*\n", guide[guide.index("## All commands"):]))))),
    "verdicts of the guide": (verdicts, first_words(guide[guide.index("## What a verdict"):guide.index("## What ballbar")])),
    "verdicts of diagnose": (verdicts, first_words(of_diagnose)),
}

faults = [f"{name}: lack {sorted(code - said)}, have {sorted(said - code)} too" for name, (code, said) in lists.items()
          if code != said or not code]
print("\n".join(faults) or f"{len(commands)} commands, {len(verdicts)} verdicts")
sys.exit(bool(faults))
