"""A file of delimited text: what stands above, heads, a row of units, rows, what stands below."""

from record import Log
import table


def repeat(texts, rows):
    return texts if isinstance(texts, list) else [texts] * rows


def delimited(file, family, times, signals, *, separator=",", decimal=".", thousands="", style="brackets", units_row=False,
              time_unit="", above="", below="", end="\r\n", encoding="utf-8", mark=b"", missing="", sign="", lead=(), behind=(),
              heads=True, trail="", quote=True, show=None, edit=None, **log):
    """`lead` and `behind` are columns that are no measurements: (head, text or list of texts); they are in `skipped`.

    `show` replaces the text of a column: {index of the signal: list of texts}. `edit` changes the table of texts, its
    rows of heads included, in place."""
    rows = len(times.columns[0]) if times.columns else len(signals[0].numbers)
    body = [repeat(texts, rows) for _, texts in lead] + times.columns
    for index, s in enumerate(signals):
        body.append((show or {}).get(index) or table.cells(s, decimal, thousands, missing, sign))
    body += [repeat(texts, rows) for _, texts in behind]
    head = [h for h, _ in lead] + times.heads + [table.header(s, "none" if units_row else style) for s in signals]
    head += [h for h, _ in behind]
    top = [head] if heads else []
    if units_row:
        time_units = [time_unit] + [""] * (len(times.heads) - 1) if times.heads else []
        top.append([""] * len(lead) + time_units + [s.text for s in signals] + [""] * len(behind))
    rows_of_text = top + table.rows(body)
    if edit:
        edit(rows_of_text)
    if trail:
        rows_of_text = [row[:-1] + [row[-1] + trail] for row in rows_of_text]
    text = above.replace("\n", end) + table.lines(rows_of_text, separator, end, quote and not trail) + below.replace("\n", end)
    content = mark + text.encode(encoding)
    log.setdefault("started", times.started)
    extra = times.extra | log.pop("extra", {})
    skipped = [h for h, _ in lead] + [h for h, _ in behind]
    return Log(file, family, content, times.time_s, signals, skipped=skipped, extra=extra, **log)


def no_times(rows, every_s):
    """For files without a time: rows at the interval that an option, or a line above the rows, states."""
    from clock import Times
    return Times([], [], [i * every_s for i in range(rows)], None, {})
