"""No algorithm names an effect or a parameter: fails where a source outside the folder of the effects does.

    python3 names.py PROGRAM SOURCE_FOLDER
"""
import json
import pathlib
import re
import subprocess
import sys

program, source = sys.argv[1], pathlib.Path(sys.argv[2])
# Words that stand for something else there too.
elsewhere = {
    "circle",  # a kind of recording
    "gain",  # a kind of parameter
    "step",  # of an offset
    "recording",  # a column of a trace
    "length_mm", "expansion_ppm_per_K",  # of a bar or a spindle
    "centre_a_um", "centre_b_um",  # of a fitted circle
}
by_name = {
    # The models that sets with hidden effects are written with.
    "blind.cpp": {"speed_heating", "expansion", "lagged_expansion", "load_heating", "gradient_bending"},
    "expression.cpp": {"onset_s"},  # what a user's formula calls an onset
}

effects = json.loads(subprocess.run([program, "effects", "--json"], stdout=subprocess.PIPE, check=True).stdout)
names = {effect["name"] for effect in effects} - {"expression"}
names |= {parameter["name"] for effect in effects for parameter in effect["parameters"]}
found = []
for folder in ("libballbar", "formats", "apps"):
    for file in sorted(source.glob(f"{folder}/**/*.?pp")):
        path = file.relative_to(source).as_posix()
        if path.startswith("libballbar/src/effects/"):
            continue
        allowed = elsewhere | by_name.get(file.name, set())
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            code = re.sub(r"^\s*//.*|\s//.*", "", line)
            for name in re.findall(r'"(\w+)"', code):
                if name in names - allowed:
                    found.append(f"{path}:{number}: {name}")
if found:
    raise SystemExit("expected no effect or parameter by its name, found\n" + "\n".join(found))
