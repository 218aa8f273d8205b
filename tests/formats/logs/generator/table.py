"""Numbers and rows as text."""

DASH_MINUS = "-"


def number(value, digits, decimal=".", thousands=""):
    """A number with `digits` after the point; `thousands` between groups of three."""
    text = f"{value:,.{digits}f}"
    if set(text) <= set("-0.,") and text.startswith("-"):
        text = text[1:]
    return text.replace(",", "\0").replace(".", decimal).replace("\0", thousands)


def exponent(value, digits=5, decimal=".", letter="E"):
    return f"{value:.{digits}e}".replace(".", decimal).replace("e", letter)


def cells(signal, decimal=".", thousands="", missing="", sign=""):
    """The column as text; `missing` is a text, or a function of the row."""
    out = []
    for row, n in enumerate(signal.numbers):
        if n is None:
            out.append(missing(row) if callable(missing) else missing)
        else:
            text = number(n, signal.digits, decimal, thousands)
            out.append(text if text.startswith("-") else sign + text)
    return out


def rows(columns):
    return [list(row) for row in zip(*columns)]


def quoted(text, separator):
    """As a spreadsheet quotes: only where it must."""
    if separator in text or '"' in text or "\n" in text:
        return '"' + text.replace('"', '""') + '"'
    return text


def lines(table, separator=",", end="\r\n", quote=True):
    return "".join(separator.join(quoted(c, separator) if quote else c for c in row) + end for row in table)


STYLES = {
    "brackets": "{} [{}]", "round": "{} ({})", "slash": "{} / {}", "comma": "{}, {}", "underscore": "{}_{}", "in": "{} in {}",
    "tight": "{}[{}]", "none": "{}",
}


def header(signal, style="brackets"):
    return STYLES[style].format(signal.source, signal.text) if signal.text else signal.source
