"""Holds README.md, or another page, to what the program does, and its links to what is there. Its fenced blocks:

    ```csv cold.csv          a plain name: the block is a file of that name
    ```cpp tests/x/main.cpp  a path: the block must stand in that file
    ```console               lines `$ command` (a closing backslash continues) are run, in a folder that has
                             the files above, those of tests/cli/readme/ and sample-runs/; `ballbar` is the
                             program built. The lines below each are its output, to the letter but for the last
                             digits of numbers (same.py); `...` stands for any lines.
    ```console numpy,pandas  passed over where Debian's python3 lacks one of these modules
    ```console SECTION       not run: its command and output stand in that section of the transcripts of tests/cli

and every `ballbar ...` of a table below the line `<!-- each command is run -->` ends with status 0 and prints one screen.

    python3 readme.py PROGRAM SOURCE_FOLDER SCRATCH [PAGE] [--update]

PAGE is relative to the source folder; default README.md. --update rewrites the outputs that differ.
"""
import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # beside the sources
import same  # noqa: E402
import transcript  # noqa: E402

kScreenLines = 40  # that a command prints without --details, with its remarks on the standard error

program, source, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
update = "--update" in sys.argv[4:]
page = next((argument for argument in sys.argv[4:] if argument != "--update"), "README.md")
readme = source / page
sections = transcript.all_sections()


def ran(command):
    # Debian's own python3 first: modules are installed for that one.
    environment = dict(os.environ, LC_ALL="C", PATH=f"{program.parent}:/usr/bin:{os.environ['PATH']}")
    return subprocess.run(["sh", "-c", command], cwd=scratch, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def run(command):
    return ran(command).stdout.splitlines()


def pattern_of(expected):
    return "".join(r"(?s:.*)" if line == "..." else re.escape(line + "\n") for line in expected)


def stands_in(section, command, expected):
    """A command may be broken into lines elsewhere."""
    def whole(text):
        return re.sub(r" *\\\n *", " ", text)

    return any(whole(step.command) == whole(command) and re.search("(?m)^" + pattern_of(expected), step.expected.stdout)
               for step in section.steps)


def lacking(modules):
    return "".join(run("python3 -c 'from importlib.util import find_spec\n"
                       f"print(*[name for name in \"{modules}\".split(\",\") if not find_spec(name)])'"))


def anchors(path):
    """Those that a page's headings make."""
    text = re.sub(r"(?ms)^```.*?^```$", "", path.read_text(encoding="utf-8"))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in re.findall(r"(?m)^#+ (.*)$", text)}


def links_of(lines):
    """(link, whether something is there) of all that stay in the repository."""
    links = re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`\n]*`", "", "\n".join(lines)))
    for link in links:
        name, _, anchor = link.partition("#")
        target = readme.parent / name if name else readme
        if "://" not in link:
            yield link, target.exists() and (not anchor or anchor in anchors(target))


def commands_of_tables(lines):
    """Those of the table below each line that says so."""
    tables = re.findall(r"(?m)^<!-- each command is run -->\n\n((?:\|.*\n)+)", "".join(line + "\n" for line in lines))
    return re.findall(r"`(ballbar [^`]+)`", "".join(tables))


def steps_of(block):
    """[(lines of the command, lines of its output)] of a console block."""
    steps = []
    for line in block:
        if line.startswith("$ "):
            steps.append(([line], []))
        elif not steps:
            raise SystemExit(f"{page}: a console block starts without `$ `: {line}")
        elif not steps[-1][1] and steps[-1][0][-1].endswith("\\"):
            steps[-1][0].append(line)
        else:
            steps[-1][1].append(line)
    return steps


# The page as pieces: (None, None, lines) outside the blocks, (language, name, lines) inside.
pieces = [(None, None, [])]
for line in readme.read_text(encoding="utf-8").splitlines():
    fence = re.fullmatch(r"```(\w*)(?: (\S+))?", line)
    if pieces[-1][0] is not None and line == "```":
        pieces.append((None, None, [line]))
    elif pieces[-1][0] is None and fence:
        pieces[-1][2].append(line)
        pieces.append((fence[1], fence[2], []))
    else:
        pieces[-1][2].append(line)

shutil.rmtree(scratch, ignore_errors=True)
scratch.mkdir(parents=True)
(scratch / "sample-runs").symlink_to(source / "sample-runs")
shutil.copytree(source / "tests" / "cli" / "readme", scratch, dirs_exist_ok=True)

wrong = commands = held = links = 0
for language, name, block in pieces:
    if not name or language == "console":
        continue
    text = "".join(line + "\n" for line in block)
    if "/" not in name:
        (scratch / name).write_text(text, encoding="utf-8")
        continue
    held += 1
    if text not in (source / name).read_text(encoding="utf-8"):
        wrong += 1
        print(f"{page}: the block of {name} does not stand in that file")

for language, _, lines in pieces:
    for link, whole in links_of(lines) if language is None else []:
        links += 1
        if not whole:
            wrong += 1
            print(f"{page}: nothing is at {link}")

for command in (one for language, _, lines in pieces if language is None for one in commands_of_tables(lines)):
    came = ran(command)
    commands += 1
    if came.returncode:
        wrong += 1
        print(f"{page}: {command}: exit status {came.returncode}\n{came.stdout}")
    elif came.stdout.count("\n") > kScreenLines:
        wrong += 1
        print(f"{page}: {command}: expected at most {kScreenLines} lines, found {came.stdout.count(chr(10))}")

for language, name, block in pieces:
    if language != "console":
        continue
    if name in sections:
        held += 1
        for command, expected in steps_of(block):
            if not stands_in(sections[name], "\n".join(command)[2:], expected):
                wrong += 1
                print(f"{page}: the block of {name} is not what stands in {sections[name].path.name}")
        continue
    if name and lacking(name):
        print(f"{page}: passed over what needs {name}")
        continue
    rewritten = []
    for command, expected in steps_of(block):
        commands += 1
        came = run("\n".join(command)[2:])
        if same.matches(expected, came):
            came = expected
        else:
            wrong += 1
            print("\n".join(command))
            print("\n".join(difflib.unified_diff(expected, came, page, "program", lineterm="")))
        rewritten += command + came
    block[:] = rewritten

print(f"{page}: {commands} commands run, {held} blocks and {links} links held, {wrong} differences")
if update:
    readme.write_text("".join(line + "\n" for _, _, lines in pieces for line in lines), encoding="utf-8")
elif wrong or not commands + held + links:
    raise SystemExit(1)
