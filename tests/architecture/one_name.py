"""A type has one header: two of one name in one namespace are one to the linker, which keeps the destructor of either.

    python3 one_name.py SOURCE_FOLDER
"""
import collections
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
found = collections.defaultdict(set)  # (namespace, name): headers
for part in ("libballbar", "formats", "apps"):
    for path in source.glob(f"{part}/**/*.hpp"):
        text = path.read_text(encoding="utf-8")
        namespace = re.search(r"^namespace ([\w:]+) \{", text, re.M)
        for line in re.finditer(r"^(template.*\n)?(?:struct|class|enum class) (\w+)[^;\n]*\{", text, re.M):
            if not line[1]:
                found[namespace[1] if namespace else "", line[2]].add(path.relative_to(source).as_posix())
wrong = [f"{namespace}::{name}: expected in one header, found in {', '.join(sorted(headers))}"
         for (namespace, name), headers in sorted(found.items()) if len(headers) > 1]
print("\n".join(wrong + [f"{len(found)} types, {len(wrong)} of them twice"]))
sys.exit(1 if wrong or not found else 0)
