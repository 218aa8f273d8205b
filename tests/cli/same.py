"""Whether two outputs of the program are the same where only the last digits of numbers may differ: another BLAS, or
another processor, rounds otherwise. The one comparer of the transcripts of tests/cli, of the README blocks and of the page.

    python3 same.py EXPECTED CAME [--tolerance NUMBER]

Text is compared to the letter. A number has a decimal point or an exponent; a count, a date, a version, a name of a
file and a hash are text. Two numbers are the same where

    they differ by at most the tolerance, 1e-9 if none is given, times the number itself and have the same sign, or
    both have at most seven digits and differ by one in the last of them; so may three numbers of an output do, or one
    in a hundred: more than a rounding at the border of two digits explains is a difference.

In JSON the tolerance is also that of the largest number in the same list (residuals are small differences of large
numbers), of the sigma beside it (a value far below its sigma means nothing), and of 1 for a probability.

Prints what differs and ends with 1, or with 0.
"""
import difflib
import json
import math
import pathlib
import re
import sys
from decimal import Decimal

kTolerance = 1e-9
kTiny = 1e-15  # in JSON, what two sums that vanish may differ by
kDigits = 7
kFewBorders = 3
kBorders = 0.01
kShown = 40

# Not preceded by a word, a point, a path, `name-`, a time of the day or `version `; not followed by a word, by a point
# and a word, or by `-name`. A mantissa without a point needs the sign of the exponent: a hash may read 12e4.
NUMBER = re.compile(r"(?<![\w./])(?<![A-Za-z]-)(?<!\d:)(?<![Vv]ersion )"
                    r"[-+]?(?:\d+\.\d+(?:[eE][-+]?\d+)?|\d+[eE][-+]\d+)(?!\w|\.\w|-[A-Za-z])")
MADE_ON = re.compile(r'("made_on": *)"[^"]*"')
PROBABILITY = re.compile(r"p|p_\w+|chance|share")


class Borders:
    """Counts numbers, and those of them that differ in the last digit only."""

    def __init__(self):
        self.numbers = self.found = 0

    def too_many(self):
        if self.found > max(kFewBorders, kBorders * self.numbers):
            yield f"{self.found} of {self.numbers} numbers differ in the last digit"


def are_close(a, b, tolerance):
    return abs(a - b) <= tolerance * max(abs(a), abs(b))


def are_neighbours(a, b):
    """Decimals, as they are printed."""
    place = a.as_tuple().exponent
    few = max(len(a.as_tuple().digits), len(b.as_tuple().digits)) <= kDigits
    return few and place == b.as_tuple().exponent and abs(a - b) <= Decimal(1).scaleb(place)


def same_number(a, b, tolerance, borders):
    borders.numbers += 1
    if a == b:
        return True
    x, y = Decimal(a), Decimal(b)
    if x.is_signed() != y.is_signed():
        return False
    if are_close(float(x), float(y), tolerance):
        return True
    if not are_neighbours(x, y):
        return False
    borders.found += 1
    return True


def same_text(a, b, wider_before, wider_after):
    """Text between numbers; blanks beside a number that became longer or shorter make up for it."""
    for side, wider in ((str.lstrip, wider_before), (str.rstrip, wider_after)):
        if wider and (side(a, " ") != a) == (side(b, " ") != b):
            a, b = side(a, " "), side(b, " ")
    return a == b


def same_line(a, b, tolerance, borders):
    if a == b:
        borders.numbers += len(NUMBER.findall(a))
        return True
    numbers, others = NUMBER.findall(a), NUMBER.findall(b)
    if len(numbers) != len(others):
        return False
    wider = [False, *(len(one) != len(other) for one, other in zip(numbers, others)), False]
    if not all(map(same_text, NUMBER.split(a), NUMBER.split(b), wider, wider[1:])):
        return False
    return all([same_number(one, other, tolerance, borders) for one, other in zip(numbers, others)])


def text_differences(expected, came, tolerance):
    a, b = expected.split("\n"), came.split("\n")
    borders = Borders()
    # Lines that are the same take the place of those that came: what is shown are the others.
    shown = list(b)
    for k in range(min(len(a), len(b))):
        if same_line(a[k], b[k], tolerance, borders):
            shown[k] = a[k]
        elif len(a) != len(b):
            break  # it is a difference anyway, and the lines that follow may be shifted
    if a != shown:
        yield from difflib.unified_diff(a, shown, "expected", "came", lineterm="")
    yield from borders.too_many()


def largest(value):
    if isinstance(value, list):
        return max(map(largest, value), default=0.0)
    return abs(value) if isinstance(value, float) else 0.0


def is_short(value):
    return float(f"{value:.{kDigits}g}") == value


def are_short_neighbours(a, b):
    size = max(abs(a), abs(b))
    return is_short(a) and is_short(b) and abs(a - b) < 1.001 * 10.0 ** (math.floor(math.log10(size)) - kDigits + 1)


class Json:
    """Differences of two values that JSON holds, whose layout is the same."""

    def __init__(self, tolerance):
        self.tolerance = tolerance
        self.borders = Borders()  # of the sentences

    def are_same(self, a, b, size):
        if not (math.isfinite(a) and math.isfinite(b)):
            return a == b
        return abs(a - b) <= max(kTiny, self.tolerance * max(abs(a), abs(b), size))

    def of_lists(self, a, b, place, size):
        if len(a) != len(b):
            yield f"{place}: {len(a)} and {len(b)} entries"
        size = max(size, largest(a))
        borders = Borders()
        for k, (one, other) in enumerate(zip(a, b)):
            if isinstance(one, float) and isinstance(other, float):
                borders.numbers += 1
                if not self.are_same(one, other, size) and are_short_neighbours(one, other):
                    borders.found += 1
                    continue
            yield from self.of(one, other, f"{place}[{k}]", size)
        for line in borders.too_many():
            yield f"{place}: {line}"

    def of_objects(self, a, b, place):
        sigma = max((abs(one) for key, one in a.items() if "sigma" in key and isinstance(one, float)), default=0.0)
        if list(a) != list(b):
            yield f"{place}: the keys {', '.join(a)} and {', '.join(b)}"
        for key in a.keys() & b.keys() - {"made_on"}:
            yield from self.of(a[key], b[key], f"{place}.{key}", 1.0 if PROBABILITY.fullmatch(key) else sigma)

    def of(self, a, b, place="", size=0.0):
        if type(a) is not type(b):
            yield f"{place}: {a!r:.300} and {b!r:.300}"
        elif isinstance(a, float):
            if not self.are_same(a, b, size):
                yield f"{place}: {a!r} and {b!r}, {abs(a - b) / max(abs(a), abs(b)):.1e} of it"
        elif isinstance(a, list):
            yield from self.of_lists(a, b, place, size)
        elif isinstance(a, dict):
            yield from self.of_objects(a, b, place)
        elif isinstance(a, str):
            if not same_line(a, b, self.tolerance, self.borders):
                yield f"{place}: {a!r} and {b!r}"
        elif a != b:
            yield f"{place}: {a!r} and {b!r}"


def refuse(word):
    raise ValueError(f"{word} is not JSON")


def json_of(text):
    """(whether it is an object or a list of JSON, which)."""
    if text.lstrip()[:1] not in ("{", "["):
        return False, None
    try:
        return True, json.loads(text, parse_constant=refuse)
    except (ValueError, RecursionError):
        return False, None


def json_differences(expected, came, tolerance):
    (_, a), (_, b) = json_of(expected), json_of(came)
    found = Json(tolerance)
    lines = [*found.of(a, b), *found.borders.too_many()]
    yield from lines
    layouts = [NUMBER.sub("0.0", MADE_ON.sub(r'\1""', text)).split("\n") for text in (expected, came)]
    if not lines and layouts[0] != layouts[1]:
        yield from difflib.unified_diff(*layouts, "expected", "came", lineterm="")


def differences(expected, came, tolerance=kTolerance):
    """Lines that say where the two texts differ; none where they are the same."""
    if expected == came:
        return []
    is_json = json_of(expected)[0] and json_of(came)[0]
    return list((json_differences if is_json else text_differences)(expected, came, tolerance))


def matches(expected, came, tolerance=kTolerance):
    """Lines of a README block against lines that came: the line `...` stands for any number of lines."""
    pieces = [[]]
    for line in expected:
        if line == "...":
            pieces.append([])
        else:
            pieces[-1].append(line)

    borders = Borders()

    def stands_at(piece, at):
        tried = Borders()
        if at < 0 or at + len(piece) > len(came):
            return False
        if not all([same_line(a, b, tolerance, tried) for a, b in zip(piece, came[at:at + len(piece)])]):
            return False
        borders.numbers += tried.numbers
        borders.found += tried.found
        return True

    first, *middle = pieces
    if not middle:
        return len(first) == len(came) and stands_at(first, 0) and not list(borders.too_many())
    if not stands_at(first, 0):
        return False
    at, last = len(first), middle.pop()
    for piece in middle:
        while at <= len(came) and not stands_at(piece, at):
            at += 1
        at += len(piece)
    return at <= len(came) - len(last) and stands_at(last, len(came) - len(last)) and not list(borders.too_many())


def main(words):
    expected, came, *options = words
    tolerance = float(options[options.index("--tolerance") + 1]) if options else kTolerance
    # Bytes that are no UTF-8 are kept apart.
    texts = [pathlib.Path(path).read_bytes().decode("utf-8", "surrogateescape") for path in (expected, came)]
    found = differences(*texts, tolerance)
    for line in found[:kShown]:
        print(line.encode("utf-8", "backslashreplace").decode("utf-8"))
    if len(found) > kShown:
        print(f"and {len(found) - kShown} more lines")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
