"""Adds an effect as libballbar/src/effects/README.md says, in copies, and runs the tests of the effects with it.

    python3 add_effect.py SOURCE_FOLDER LIBRARY SCRATCH CMAKE LINK... -- COMPILER...

The page's blocks are applied to copies of the files they name: a file that is not there is written; of cmake, the first
line stands in the file and the second is put below it; a test goes to the end of its file. Compiled is what they touch,
the catalogue and the tests; all else is taken from LIBRARY. LINK: what tests are linked with besides.
"""
import concurrent.futures
import pathlib
import re
import shutil
import subprocess
import sys

source, library, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
cmake = sys.argv[4]
link, compiler = sys.argv[5 : sys.argv.index("--")], sys.argv[sys.argv.index("--") + 1 :]
page = source / "libballbar/src/effects/README.md"


def run(command, **arguments):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **arguments)
    if done.returncode != 0:
        raise SystemExit(f"{page}: {' '.join(str(word) for word in command)}\n{done.stdout}")
    return done.stdout


blocks = re.findall(r"^```(\w+) (\S+)\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S)
if sorted(path.split("/")[0] for _, path, _ in blocks) != ["libballbar", "libballbar", "tests"]:
    raise SystemExit(f"{page}: expected its file, one list line and its test, found {[path for _, path, _ in blocks]}")
shutil.rmtree(scratch, ignore_errors=True)
for folder in ("libballbar/src", "tests/libballbar/effects"):
    shutil.copytree(source / folder, scratch / folder)
for language, path, text in blocks:
    file = scratch / path
    if not file.exists():
        file.write_text(text, encoding="utf-8")
        continue
    old = file.read_text(encoding="utf-8")
    if language == "cmake":
        above, line = text.splitlines()
        if old.count(above + "\n") != 1:
            raise SystemExit(f"{page}: expected `{above}` once in {path}")
        file.write_text(old.replace(above + "\n", f"{above}\n{line}\n"), encoding="utf-8")
    else:
        end = old.rindex("\n}  // namespace\n}  // namespace ballbar")
        file.write_text(old[:end] + "\n" + text + old[end:], encoding="utf-8")

lists = [scratch / path for language, path, _ in blocks if language == "cmake"]
run([cmake, "-P", lists[0]], cwd=scratch)
touched = [scratch / path for language, path, _ in blocks if language != "cmake"]
sources = touched + [scratch / "catalogue.cpp", scratch / "tests/libballbar/effects/all_effects_test.cpp"]
flags = ["-std=c++20", "-O0", "-I", source / "libballbar/include", "-I", scratch / "libballbar/src"]
objects = [scratch / f"{number}.o" for number in range(len(sources))]
with concurrent.futures.ThreadPoolExecutor(2) as pool:
    for _ in pool.map(lambda pair: run([*compiler, *flags, "-c", pair[0], "-o", pair[1]]), zip(sources, objects)):
        pass
run([*compiler, *objects, library, *link, "-o", scratch / "effects"])
named = pathlib.Path(touched[0]).stem
record = scratch / "effects.xml"
ran = run([scratch / "effects", f"--gtest_output=xml:{record}"])
if f"{named} on a " not in record.read_text(encoding="utf-8"):
    raise SystemExit(f"{page}: expected {named} in the catalogue, found it in no test:\n{ran}")
print(next(line for line in ran.splitlines() if "PASSED" in line))
