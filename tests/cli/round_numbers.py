"""Checks that stdin is JSON and prints it with numbers rounded to 6 decimals, so that a whole output can be
compared on processors whose sine differs in the last bit.

    python3 round_numbers.py < fit.json
"""
import json
import sys


def rounded(value):
    if isinstance(value, float):
        return round(value, 6) + 0.0  # no minus zero
    if isinstance(value, list):
        return [rounded(item) for item in value]
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    return value


def refuse(word):
    raise ValueError(f"{word} is not JSON")


json.dump(rounded(json.load(sys.stdin, parse_constant=refuse)), sys.stdout, indent=2, ensure_ascii=False)
print()
