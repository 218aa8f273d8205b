"""Each sentence of formats/messages is said somewhere, and the build stops where a language lacks one or a place of it.

    python3 messages.py SOURCE_FOLDER CMAKE
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

source, cmake = pathlib.Path(sys.argv[1]), sys.argv[2]
catalogues = source / "formats/messages"
names = re.findall(r"^(\w+) = ", (catalogues / "en.toml").read_text(encoding="utf-8"), re.M)
code = "\n".join(path.read_text(encoding="utf-8") for part in ("libballbar", "formats", "apps")
                 for path in source.glob(f"{part}/**/*.[ch]pp"))
used = set(re.findall(r"\bmessages::(\w+)", code))
wrong = [f"formats/messages/en.toml: {name}: expected a use of messages::{name}, found none" for name in names if name not in used]
own = [set(re.findall(r"^((?:series|recording)_\w+) = ", (catalogues / file).read_text(encoding="utf-8"), re.M)) for file in ("de.toml", "zh.toml")]
wrong += [f"formats/messages: {name}: expected in de.toml and zh.toml, found in one" for name in sorted(own[0] ^ own[1])]

# Each change of a catalogue, and what the build says of it.
CHANGES = [
    ("de.toml", r"^negligible = .*\n", "", "expected a line for negligible, as en.toml has it"),
    ("zh.toml", r"\{before_um\}", "3", "lacks the place {before_um} of en.toml"),
    ("de.toml", r"^negligible = .*", 'negligible = "{much}"', "has a place {much} that en.toml does not have"),
    ("zh.toml", r"^negligible", "neglected", "neglected is no sentence of en.toml"),
    ("en.toml", r"^negligible = .*", "negligible", 'expected name = "text", found: negligible'),
]
for file, pattern, text, expected in [("en.toml", "$^", "", "")] + CHANGES:
    with tempfile.TemporaryDirectory() as scratch:
        changed = shutil.copytree(catalogues, pathlib.Path(scratch) / "messages") / file
        changed.write_text(re.sub(pattern, text, changed.read_text(encoding="utf-8"), flags=re.M), encoding="utf-8")
        ran = subprocess.run([cmake, "-P", changed.parent / "messages.cmake"], cwd=scratch, capture_output=True, text=True)
        said = " ".join(ran.stderr.split())
        if expected not in said or (ran.returncode == 0) != (expected == ""):
            wrong.append(f"{file}, {pattern}: expected the build to say {expected!r}, found {said!r}")
print("\n".join(wrong + [f"{len(names)} sentences, {len(wrong)} faults"]))
sys.exit(1 if wrong or not names else 0)
