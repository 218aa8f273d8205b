"""The keys of a report's data, nested, with the length of lists and what the first of them holds."""
import json
import sys


def show(value, name, depth):
    indent = "  " * depth
    if isinstance(value, dict):
        print(f"{indent}{name}")
        for key, part in value.items():
            show(part, key, depth + 1)
    elif isinstance(value, list) and value and isinstance(value[0], (dict, list)):
        print(f"{indent}{name}: {len(value)} of")
        show(value[0], "", depth + 1)
    elif isinstance(value, list):
        kind = type(value[0]).__name__ if value else "nothing"
        print(f"{indent}{name}: {len(value)} of {'number' if kind in ('int', 'float', 'NoneType') else kind}")
    else:
        print(f"{indent}{name}")


for key, part in json.load(open(sys.argv[1], encoding="utf-8")).items():
    show(part, key, 0)
