"""The program also compiles for the page, against a C++ library (libc++ 14) that lacks parts of C++20.

    python3 page_library.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
lacking = re.compile(
    r"std::ranges::\w+|std::views::\w+|std::span [a-z_]+[({](?=[^;]*\.begin\(\))|std::format\b")
wrong = []
for part in ("libballbar", "formats", "apps"):
    for path in sorted(source.glob(f"{part}/**/*.[ch]pp")):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            found = lacking.search(line.partition("//")[0])
            if found:
                wrong.append(f"{path.relative_to(source)}:{number}: {found[0]} is not in the library of the page's compiler")
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
