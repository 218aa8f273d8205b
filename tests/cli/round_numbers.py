"""Checks that stdin is JSON and prints it with numbers rounded to 6 decimals (or as many as stated), so that a whole output can be
compared on processors whose sine differs in the last bit.

    python3 round_numbers.py < fit.json
    python3 round_numbers.py 3 < check.json
"""
import json
import sys

decimals = int(sys.argv[1]) if len(sys.argv) > 1 else 6


def rounded(value):
    if isinstance(value, float):
        return round(value, decimals) + 0.0  # no minus zero
    if isinstance(value, list):
        return [rounded(item) for item in value]
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    return value


def refuse(word):
    raise ValueError(f"{word} is not JSON")


json.dump(rounded(json.load(sys.stdin, parse_constant=refuse)), sys.stdout, indent=2, ensure_ascii=False)
print()
