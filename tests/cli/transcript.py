"""Runs transcripts, which are sessions with the program that a person reads: all NAME.txt here but readme-pages.txt.

    # fit-truncated-b5r: A .b5r file that is cut short says where it ends.

      $ head -c 6000 sample-runs/qc20-style-b5r/00.b5r > half.b5r
      $ ballbar fit half.b5r
      ! ballbar: half.b5r:34:4878: expected a complete XML file, found damage or an early end: Start-end tags mismatch. Copy the file again.
      [1]

Its lines:

    # NAME: SENTENCE   a section: one shell in an empty folder with sample-runs/; `ballbar` is the program, $tools is here
    with PDF, PAGE     only where ballbar is built with these; `without PDF`: only where it is built without
    slow               minutes under sanitizers
    tolerance 1e-7: REASON   how far numbers may differ where same.py's 1e-9 is too narrow
    any other that is not indented   for the reader, as are the empty lines around it
      $ COMMAND        and, behind `>`, its further lines
      TEXT             what it prints on standard output
      ! TEXT           then, on standard error
      [STATUS]         then, its exit status where that is not 0

Outputs are compared by same.py. An output line that begins as one of these has a backslash before it; a lone backslash
ends a text that ends without a newline. A shell that exits with 77 skips its section; the last line it printed on
standard error says why.

    python3 transcript.py PROGRAM [FILE [WORD]] [--update] [--slow | --quick] [--first] [--without PAGE,PDF]

FILE: one transcript, fit.txt; all otherwise. WORD: only sections whose names hold it. --update writes outputs anew where
they are not the same: read the difference (git diff) before keeping it. --slow runs only slow sections, --quick none of
them, --first one of each file. --without names what the program is built without.
"""
import argparse
import concurrent.futures
import dataclasses
import functools
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # beside the sources
import same  # noqa: E402

kHere = pathlib.Path(__file__).resolve().parent
kComponents = {"PAGE", "IMAGES", "MAT", "PDF", "XLSX"}
kSkipped = 77
kAtOnce = 2  # sections

HEADING = re.compile(r"# ([\w-]+): (.+)")
CONDITION = re.compile(r"(with|without) ([A-Z, ]+)")
TOLERANCE = re.compile(r"tolerance (\S+): .+")
STATUS = re.compile(r"\[(-?\d+)\]")
MARKED = re.compile(r"\\|[$>!](?: |$)|\[-?\d+\]$")


@dataclasses.dataclass
class Output:
    stdout: str = ""
    stderr: str = ""
    status: int = 0


@dataclasses.dataclass
class Step:
    """A command, and the lines `begin` to `end` of the file that are its output."""

    command: str
    begin: int
    end: int
    lines: list = dataclasses.field(default_factory=list)

    @functools.cached_property
    def expected(self):
        out, err, status = [], [], 0
        for line in self.lines:
            if STATUS.fullmatch(line):
                status = int(STATUS.fullmatch(line)[1])
            elif line == "!" or line.startswith("! "):
                err.append(line[2:])
            else:
                out.append(line)
        return Output(text_of(out), text_of(err), status)


@dataclasses.dataclass
class Section:
    path: pathlib.Path
    name: str
    sentence: str
    needs: set = dataclasses.field(default_factory=set)
    lacks: set = dataclasses.field(default_factory=set)
    slow: bool = False
    tolerance: float = same.kTolerance
    steps: list = dataclasses.field(default_factory=list)


def text_of(lines):
    text = "".join(line.removeprefix("\\") + "\n" for line in lines if line != "\\")
    return text[:-1] if lines[-1:] == ["\\"] else text


def lines_of(text, mark=""):
    *lines, last = text.split("\n")
    lines = ["\\" + line if MARKED.match(line) else line for line in lines + [last] * (last != "")] + ["\\"] * (last != "")
    return ["  " + mark + line if line else ("  " + mark).rstrip() for line in lines]


def output_lines(output):
    status = [f"  [{output.status}]"] if output.status else []
    return lines_of(output.stdout) + lines_of(output.stderr, "! ") + status


def read_lines(path):
    """Bytes that are no UTF-8 are kept apart."""
    return path.read_bytes().decode("utf-8", "surrogateescape").removesuffix("\n").split("\n")


def add_note(section, line, where):
    """A line that is not indented: a condition, or prose."""
    condition, tolerance = CONDITION.fullmatch(line), TOLERANCE.fullmatch(line)
    if condition:
        words = set(condition[2].split(", "))
        if not words <= kComponents:
            raise SystemExit(f"{where}: expected some of {', '.join(sorted(kComponents))}, found {condition[2]}")
        (section.needs if condition[1] == "with" else section.lacks).update(words)
    elif tolerance:
        section.tolerance = float(tolerance[1])
    elif line == "slow":
        section.slow = True
    elif line.startswith(("#", "tolerance")):
        raise SystemExit(f"{where}: expected `# NAME: SENTENCE` or `tolerance NUMBER: REASON`, found {line}")


def sections_of(path):
    """Those of a transcript."""
    sections, step = [], None
    for at, line in enumerate(read_lines(path)):
        where = f"{path.name}:{at + 1}"
        if line.startswith("  $ "):
            step = Step(line[4:], at + 1, at + 1)
            if not sections:
                raise SystemExit(f"{where}: expected a heading, `# NAME: SENTENCE`, before a command")
            sections[-1].steps.append(step)
        elif step and step.begin == at and (line == "  >" or line.startswith("  > ")):
            step.command += "\n" + line[4:]
            step.begin = step.end = at + 1
        elif step and (line.startswith("  ") or line == ""):
            step.lines.append(line[2:])
            step.end = at + 1
        elif line.startswith(" "):
            raise SystemExit(f"{where}: expected a command, `  $ COMMAND`, before its output")
        elif line:
            if step and step.lines[-1:] == [""]:
                step.lines.pop()
                step.end -= 1
            step = None
            heading = HEADING.fullmatch(line)
            if heading:
                sections.append(Section(path, *heading.groups()))
            elif sections:
                add_note(sections[-1], line, where)
    for section in sections:
        if not section.steps:
            raise SystemExit(f"{path.name}: expected a command in {section.name}, found none")
    return sections


def transcripts():
    return sorted(path for path in kHere.glob("*.txt") if path.name not in ("CMakeLists.txt", "readme-pages.txt"))


def all_sections():
    """{name: section} of all transcripts."""
    found = {}
    for section in (section for path in transcripts() for section in sections_of(path)):
        if section.name in found:
            raise SystemExit(f"{section.path.name}: expected names of sections to differ, found {section.name} again")
        found[section.name] = section
    return found


class Skipped(Exception):
    pass


def run(section, program):
    """What each step prints; None for those that a shell which ended has not come to."""
    with tempfile.TemporaryDirectory() as scratch:
        work, came = pathlib.Path(scratch, "work"), pathlib.Path(scratch, "came")
        work.mkdir()
        came.mkdir()
        (work / "sample-runs").symlink_to(kHere.parents[1] / "sample-runs")
        script, to = pathlib.Path(scratch, "script"), shlex.quote(str(came))
        script.write_text("".join(f"exec >{to}/{k}.stdout 2>{to}/{k}.stderr\n{step.command}\necho $? >{to}/{k}.status\n"
                                  for k, step in enumerate(section.steps)), "utf-8", "surrogateescape")
        environment = dict(os.environ, LC_ALL="C", PATH=f"{program.parent}:{os.environ['PATH']}", tools=str(kHere))
        ended = subprocess.run(["sh", script], cwd=work, env=environment, stdin=subprocess.DEVNULL, check=False).returncode

        def text(k, what):
            return (came / f"{k}.{what}").read_bytes().decode("utf-8", "surrogateescape")

        outputs = []
        for k in range(len(section.steps)):
            if not (came / f"{k}.stdout").exists():
                outputs.append(None)
                continue
            status = int(text(k, "status")) if (came / f"{k}.status").exists() else ended
            outputs.append(Output(text(k, "stdout"), text(k, "stderr"), status))
            if status == kSkipped and ended == kSkipped:
                raise Skipped((outputs[-1].stderr.splitlines() or ["said by the test"])[-1])
        return outputs


def differences(expected, came, tolerance):
    if came is None:
        yield "not run, for the shell ended before"
        return
    for what in ("stdout", "stderr"):
        found = same.differences(getattr(expected, what), getattr(came, what), tolerance)
        yield from ([what] if found else []) + found[:same.kShown]
        if len(found) > same.kShown:
            yield f"and {len(found) - same.kShown} more lines"
    if expected.status != came.status:
        yield f"status: expected {expected.status}, came {came.status}"


def result(section, program):
    """(lines to print, [(step, what came)] of those that differ)"""
    try:
        came = run(section, program)
    except Skipped as reason:
        return [f"section {section.name} skipped: {reason}"], []
    lines, wrong = [], []
    for step, output in zip(section.steps, came):
        found = list(differences(step.expected, output, section.tolerance))
        if found:
            command = step.command.split("\n")
            lines += ["", f"{section.name}, {section.path.name}:{step.begin - len(command) + 1}: $ {command[0]}", *found]
            wrong.append((step, output))
    return lines, wrong


def rewrite(path, wrong):
    lines = read_lines(path)
    for step, output in sorted(wrong, key=lambda one: -one[0].begin):
        lines[step.begin:step.end] = output_lines(output or Output())
    path.write_bytes("".join(line + "\n" for line in lines).encode("utf-8", "surrogateescape"))


def run_file(path, options):
    """Whether all is as expected, or written anew."""
    chosen = [section for section in sections_of(path) if options.word in section.name
              and not (options.slow and not section.slow) and not (options.quick and section.slow)]
    lacking = set(options.without.split(",")) & kComponents
    here = [section for section in chosen if not section.needs & lacking and section.lacks <= lacking]
    if options.first:
        chosen = here = here[:1]
    wrong, failed = [], 0
    with concurrent.futures.ThreadPoolExecutor(kAtOnce) as pool:
        for lines, of_section in pool.map(lambda section: result(section, options.program), here):
            print("".join(line + "\n" for line in lines), end="", flush=True)
            wrong += of_section
            failed += bool(of_section)
    if options.update:
        rewrite(path, wrong)
    others = f", {len(chosen) - len(here)} left out for what ballbar is built with" if len(chosen) > len(here) else ""
    print(f"{path.name}: {len(here)} sections, {failed} {'written anew' if options.update else 'differ'}{others}")
    return len(chosen), not failed or options.update


def main():
    sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")
    parser = argparse.ArgumentParser(usage=__doc__.split("\n\n    python3 ")[1].split("\n")[0])
    parser.add_argument("program", type=lambda word: pathlib.Path(word).resolve())
    parser.add_argument("file", nargs="?")
    parser.add_argument("word", nargs="?", default="")
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--slow", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--first", action="store_true")
    parser.add_argument("--without", default="")
    options = parser.parse_args()
    paths = [kHere / options.file] if options.file else transcripts()
    results = [run_file(path, options) for path in paths]
    if options.word and not sum(count for count, _ in results):
        sys.exit(f"expected a section whose name holds {options.word!r}, found none")
    sys.exit(0 if all(fine for _, fine in results) else 1)


if __name__ == "__main__":
    main()
