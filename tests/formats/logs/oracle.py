#!/usr/bin/env python3
"""A program that knows the truth, to test check.py: it writes what the truth says, with the fault that ORACLE_FAULT names."""

import json
import os
import sys
from pathlib import Path


def main(arguments):
    file = Path(arguments[1])
    truth = json.loads(Path(str(file) + ".truth.json").read_text(encoding="utf-8"))
    fault = os.environ.get("ORACLE_FAULT", "")
    out = Path(arguments[arguments.index("--out") + 1])
    options = arguments[2:arguments.index("--out")]
    refuses = truth["expect"] != "read" or fault == "refuses"
    if refuses and not options and fault != "reads all":
        line = "" if fault == "no line" else "1:"
        print(f"ballbar: {file}:{line} expected a date that can be read in one way", file=sys.stderr)
        return 2 if fault == "misuse" else 1
    columns = [c for c in truth["columns"] if not (fault == "no optional" and c.get("optional"))]
    times, values = list(truth["time_s"]), [list(c["values"]) for c in columns]
    names = [f"c{i}" + (f"_{c['unit']}" if c["unit"] else "") for i, c in enumerate(columns)]
    if fault == "time" and times:
        times[-1] += 0.01
    if fault == "value" and values:
        values[0] = [None if v is None else v * (1 + 3e-9) + 1e-9 for v in values[0]]
    if fault == "unit" and names:
        names[0] += "_K"
    if fault == "no unit":
        names = [f"c{i}" for i in range(len(names))]
    if fault == "row":
        times, values = times[:-1], [v[:-1] for v in values]
    if fault == "column":
        names, values = names[:-1], values[:-1]
    if fault == "missing" and values:
        values[0][0] = 0.0 if values[0][0] is None else None
    with out.open("w", encoding="utf-8") as text:
        text.write(",".join(["time_s", *names]) + "\n")
        for i, t in enumerate(times):
            text.write(",".join([repr(t), *("" if v[i] is None else repr(v[i]) for v in values)]) + "\n")
    roles = [{"name": n, "role": c["role"]} for n, c in zip(names, columns)]
    print(json.dumps({"started": truth["started"], "columns": roles}))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
