"""Thresholds and priors in the README of a room are those of its code: a number with the name of a constant or of a
number of its Tuning behind it, as `0.9 (`kNamed`)` or `95 % (`credible`)`, is its value in the room.

    python3 thresholds.py SOURCE_FOLDER
"""
import pathlib
import re
import sys

kFewest = 15  # numbers: fewer, and the pages are written otherwise

library = pathlib.Path(sys.argv[1]) / "libballbar"


def values_of(room):
    """{name: values}"""
    values = {}
    for path in sorted(library.rglob("*.[hc]pp")):
        if room in path.relative_to(library).parts:
            text = path.read_text(encoding="utf-8")
            for name, value in re.findall(r"constexpr (?:double|std::size_t) (k\w+) = ([-\d.e]+);", text):
                values.setdefault(name, set()).add(float(value))
            if "struct Tuning" in text:
                for name, value in re.findall(r"^  (?:double|int|std::size_t) (\w+) = ([-\d.e]+);", text, re.M):
                    values.setdefault(name, set()).add(float(value))
    return values


found, faults = 0, []
for page in sorted(library.glob("src/*/README.md")):
    values = values_of(page.parent.name)
    for number, percent, name in re.findall(r"(\d[\d.]*)( %)?\s+\(`(k[A-Z]\w+|[a-z_]+)`\)", page.read_text(encoding="utf-8")):
        found += 1
        if values.get(name) != {float(number) / (100 if percent else 1)}:
            faults.append(f"{page.relative_to(library)}: {number}{percent} ({name}), in the code {values.get(name, 'none')}")

if found < kFewest:
    faults.append(f"only {found} numbers with a name were found")
print("\n".join(faults) or f"{found} numbers with a name, each as in the code")
sys.exit(bool(faults))
