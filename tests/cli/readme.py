"""Holds README.md to what the program does. Fenced blocks, in the order of the page:

    ```csv cold.csv          a plain name: the block is written to a file of that name
    ```cpp tests/x/main.cpp  a path: the block must stand in that file
    ```console               lines `$ command` (a closing backslash continues) are run, `ballbar` being the
                             program built and sample-runs/ being there; the lines below each are its
                             output, where a line `...` stands for any lines

    python3 readme.py PROGRAM SOURCE_FOLDER SCRATCH [--update]

Files of tests/cli/readme/ are there too. --update rewrites the outputs that differ.
"""
import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys

program, source, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
update = "--update" in sys.argv[4:]
readme = source / "README.md"


def run(command):
    environment = dict(os.environ, LC_ALL="C", PATH=f"{program.parent}:{os.environ['PATH']}")
    return subprocess.run(["sh", "-c", command], cwd=scratch, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout.splitlines()


def same(expected, came):
    pattern = "".join(r"(?s:.*)" if line == "..." else re.escape(line + "\n") for line in expected)
    return re.fullmatch(pattern, "".join(line + "\n" for line in came)) is not None


def steps_of(block):
    """[(command lines, output lines)] of a console block."""
    steps = []
    for line in block:
        if line.startswith("$ ") or (steps and not steps[-1][1] and steps[-1][0][-1].endswith("\\")):
            if line.startswith("$ "):
                steps.append(([], []))
            steps[-1][0].append(line)
        elif steps:
            steps[-1][1].append(line)
        else:
            raise SystemExit(f"README.md: a console block starts without `$ `: {line}")
    return steps


shutil.rmtree(scratch, ignore_errors=True)
scratch.mkdir(parents=True)
(scratch / "sample-runs").symlink_to(source / "sample-runs")
extra = source / "tests" / "cli" / "readme"
if extra.is_dir():
    shutil.copytree(extra, scratch, dirs_exist_ok=True)

lines = readme.read_text(encoding="utf-8").splitlines()
kept, wrong, commands = [], 0, 0
at = 0
while at < len(lines):
    kept.append(lines[at])
    fence = re.fullmatch(r"```(\w+)(?: (\S+))?", lines[at])
    at += 1
    if not fence:
        continue
    language, name = fence.groups()
    end = lines.index("```", at)
    block = lines[at:end]
    at = end
    text = "".join(line + "\n" for line in block)
    if language == "console":
        steps, block = steps_of(block), []
        for command, expected in steps:
            commands += 1
            came = run("\n".join(command)[2:])
            block += command
            if same(expected, came):
                block += expected
                continue
            block += came
            wrong += 1
            print("\n".join(command))
            print("\n".join(difflib.unified_diff(expected, came, "README.md", "program", lineterm="")))
    elif name and "/" in name:
        if text not in (source / name).read_text(encoding="utf-8"):
            wrong += 1
            print(f"README.md: the block from {name} is not in that file")
    elif name:
        (scratch / name).write_text(text, encoding="utf-8")
    kept += block

if update:
    readme.write_text("\n".join(kept) + "\n", encoding="utf-8")
    raise SystemExit(0)
print(f"README.md: {commands} commands run, {wrong} blocks wrong")
raise SystemExit(1 if wrong or not commands else 0)
