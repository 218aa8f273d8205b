"""The guide, apps/README.md, has a row for every command of the program and for every verdict, and for no others; the manual
of diagnose has the same verdicts. The help of every command is one screen, and --details names every option that it names.

    python3 guide.py PROGRAM SOURCE_FOLDER
"""
import pathlib
import re
import subprocess
import sys

program, source = sys.argv[1], pathlib.Path(sys.argv[2])


SCREEN_LINES = 40  # kScreenLines of terminal_table.hpp


def page(name):
    return (source / name).read_text(encoding="utf-8")


def first_words(text):
    """Of the first cell of each row of the tables."""
    return set(re.findall(r"(?m)^\| (\w+) \|", text)) - {"verdict"}


def help_of(*words):
    return subprocess.run([program, "help", *words], stdout=subprocess.PIPE, text=True, check=True).stdout


def commands_in(text):
    return re.findall(r"(?m)^  ([a-z]+) {2,}\w", text)


def options_in(text):
    return set(re.findall(r"--[A-Za-z][\w-]*", text))


def faults_of_help(*command):
    short, whole = help_of(*command), help_of(*command, "--details")
    name = " ".join(("ballbar", *command))
    if len(short.splitlines()) > SCREEN_LINES:
        yield f"{name} --help: {len(short.splitlines())} lines, expected at most {SCREEN_LINES}"
    for option in sorted(options_in(short) - options_in(whole) - {"--help", "--details"}):
        yield f"{name} --help --details: expected {option}, found none"
    for option in sorted(set(re.findall(r"(?m)^  (?:-\w,)?(--[\w-]+)", whole)) - options_in(short)):
        yield f"{name} --help: expected {option} or its name, found none"
    for inner in commands_in(short):
        yield from faults_of_help(*command, inner)


helped = help_of()
header = page("libballbar/include/ballbar/diagnosis/verdict/diagnose.hpp")
guide = page("apps/README.md")
of_diagnose = re.search(r"(?ms)^\| verdict \| .*?\n\n", page("apps/diagnose/README.md"))[0]
commands = set(commands_in(helped)) - {"help"}
verdicts = set(re.findall(r"(?m)^\s*(\w+),", re.search(r"(?s)enum class Verdict \{(.*?)\}", header)[1]))
lists = {
    "commands of the guide": (commands, set(re.findall(r"`(\w+)", "".join(
        row.split(" | ")[1] for row in re.findall(r"(?m)^\| .*\n", guide[guide.index("## All commands"):]))))),
    "verdicts of the guide": (verdicts, first_words(guide[guide.index("## What a verdict"):guide.index("## What ballbar")])),
    "verdicts of diagnose": (verdicts, first_words(of_diagnose)),
}

faults = [f"{name}: lack {sorted(code - said)}, have {sorted(said - code)} too" for name, (code, said) in lists.items()
          if code != said or not code] + list(faults_of_help())
print("\n".join(faults) or f"{len(commands)} commands, {len(verdicts)} verdicts")
sys.exit(bool(faults))
