"""The program also compiles for the page, against a C++ library (libc++ 14) that lacks parts of C++20, and whose random
distributions give other numbers. Program and page have one answer.

    python3 page_library.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
lacking = re.compile(
    r"std::ranges::\w+|std::views::\w+|std::span [a-z_]+[({](?=[^;]*\.begin\(\))|std::format\b")
other = re.compile(r"std::\w+_distribution\b|std::shuffle\b|std::sample\b")
wrong = []
for part in ("libballbar", "formats", "apps"):
    for path in sorted(source.glob(f"{part}/**/*.[ch]pp")):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            code = line.partition("//")[0]
            where = f"{path.relative_to(source)}:{number}"
            if found := lacking.search(code):
                wrong.append(f"{where}: {found[0]} is not in the library of the page's compiler")
            if found := other.search(code):
                wrong.append(f"{where}: {found[0]} gives other numbers there; numerics/random_streams.hpp gives the same")
print("\n".join(wrong))
sys.exit(1 if wrong else 0)
