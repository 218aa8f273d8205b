"""Times as files write them. Each style gives the heads and cells of its columns, with what they mean."""

from dataclasses import dataclass
from datetime import datetime, timedelta

from record import iso

EN = "Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec".split()
DE = "Jan Feb Mrz Apr Mai Jun Jul Aug Sep Okt Nov Dez".split()
FR = "janv. févr. mars avr. mai juin juil. août sept. oct. nov. déc.".split()
IT = "gen feb mar apr mag giu lug ago set ott nov dic".split()
ES = "ene feb mar abr may jun jul ago sep oct nov dic".split()


@dataclass
class Times:
    heads: list          # heads of the columns of time
    columns: list        # their cells
    time_s: list
    started: str | None
    extra: dict


def micro(us, digits=3, point="."):
    return point + f"{us:06d}"[:digits] if digits else ""


def named(months, form="{d:02d}-{m}-{y}"):
    return lambda s: form.format(d=s.day, m=months[s.month - 1], y=s.year) + f" {s:%H:%M:%S}"


def ampm(s):
    return f"{(s.hour + 11) % 12 + 1}:{s:%M:%S} {'AM' if s.hour < 12 else 'PM'}"


# Absolute stamps in one column
STAMPS = {
    "iso": lambda s: f"{s:%Y-%m-%dT%H:%M:%S}",
    "iso_blank": lambda s: f"{s:%Y-%m-%d %H:%M:%S}",
    "iso_ms": lambda s: f"{s:%Y-%m-%dT%H:%M:%S}" + micro(s.microsecond),
    "iso_blank_ms": lambda s: f"{s:%Y-%m-%d %H:%M:%S}" + micro(s.microsecond),
    "iso_us": lambda s: f"{s:%Y-%m-%d %H:%M:%S}" + micro(s.microsecond, 6),
    "iso_zone": lambda s: f"{s:%Y-%m-%dT%H:%M:%S}+01:00",
    "iso_z": lambda s: f"{s:%Y-%m-%dT%H:%M:%S}Z",
    "dots": lambda s: f"{s:%d.%m.%Y %H:%M:%S}",
    "dots_ms": lambda s: f"{s:%d.%m.%Y %H:%M:%S}" + micro(s.microsecond, 3, ","),
    "dots_short": lambda s: f"{s:%d.%m.%y %H:%M:%S}",
    "day_slash": lambda s: f"{s:%d/%m/%Y %H:%M:%S}",
    "month_slash": lambda s: f"{s:%m/%d/%Y %H:%M:%S}",
    "month_loose": lambda s: f"{s.month}/{s.day}/{s.year} {s.hour}:{s:%M:%S}",
    "month_ampm": lambda s: f"{s.month}/{s.day}/{s.year} {ampm(s)}",
    "year_slash": lambda s: f"{s:%Y/%m/%d %H:%M:%S}",
    "year_slash_loose": lambda s: f"{s.year}/{s.month}/{s.day} {s.hour}:{s:%M:%S}",
    "kanji": lambda s: f"{s.year}年{s.month}月{s.day}日 {s:%H:%M:%S}",
    "compact": lambda s: f"{s:%Y%m%d-%H%M%S}",
    "compact_t": lambda s: f"{s:%Y%m%dT%H%M%S}",
    "mon_en": named(EN), "mon_de": named(DE), "mon_de_dots": named(DE, "{d}. {m} {y}"), "mon_fr": named(FR),
    "mon_fr_blank": named(FR, "{d} {m} {y}"), "mon_it": named(IT), "mon_es": named(ES),
}

# Clocks without a date
CLOCKS = {
    "clock": lambda s: f"{s:%H:%M:%S}",
    "clock_ms": lambda s: f"{s:%H:%M:%S}" + micro(s.microsecond),
    "clock_ms_comma": lambda s: f"{s:%H:%M:%S}" + micro(s.microsecond, 3, ","),
    "clock_ampm": ampm,
}


def elapsed(us, form):
    s, ms = us // 1_000_000, us % 1_000_000 // 1000
    if form == "hms":
        return f"{s // 3600:02d}:{s // 60 % 60:02d}:{s % 60:02d}"
    if form == "hms_ms":
        return f"{s // 3600:02d}:{s // 60 % 60:02d}:{s % 60:02d}.{ms:03d}"
    return f"{s // 60:02d}:{s % 60:02d}.{ms // 100}"     # "ms": minutes, seconds and a tenth


EPOCH = datetime(1970, 1, 1)


def since_epoch_us(stamp):
    return (stamp - EPOCH) // timedelta(microseconds=1)


def serial(stamp, base=datetime(1899, 12, 30)):
    """Days from the zero of Excel; the base of 1904 is 1904-01-01."""
    return (stamp - base) / timedelta(days=1)


def absolute(record, style, head="Time", wall=None):
    """`wall` are the stamps that the clock on the wall showed, where that is not the record's even time."""
    wall = wall or record.stamps
    return Times([head], [[STAMPS[style](s) for s in wall]], record.time_s, iso(record.stamps[0]), {})


def clock(record, style, head="Time", wall=None):
    return Times([head], [[CLOCKS[style](s) for s in wall or record.stamps]], record.time_s, None, {})


def date_and_clock(record, date, style, heads=("Date", "Time"), wall=None):
    wall = wall or record.stamps
    return Times(list(heads), [[date(s) for s in wall], [CLOCKS[style](s) for s in wall]], record.time_s,
                 iso(record.stamps[0]), {})


def run(record, form, head="Elapsed", offset_us=0):
    """A run time as hh:mm:ss, kept as it is."""
    us = [u + offset_us for u in record.times_us]
    return Times([head], [[elapsed(u, form) for u in us]], [u / 1e6 for u in us], None, {})


def counted(record, per_s, digits, head, decimal="."):
    """Plain numbers from 0: `per_s` of them are a second. What the digits leave is the truth."""
    numbers = [round(us / 1e6 * per_s, digits) for us in record.times_us]
    texts = [f"{n:.{digits}f}".replace(".", decimal) for n in numbers]
    return Times([head], [texts], [n / per_s for n in numbers], None, {})


def epoch(record, power, head="timestamp", digits=0):
    """Seconds since 1970 times 10^power; the wall clock is that of UTC."""
    us = [since_epoch_us(s) for s in record.stamps]
    if power == 6:
        texts = [str(u) for u in us]
    elif power == 3:
        texts = [str(u // 1000) for u in us]
    else:
        texts = [f"{u // 1_000_000}" + micro(u % 1_000_000, digits) for u in us]
    return Times([head], [texts], record.time_s, iso(record.stamps[0]), {})


def excel_serial(record, head="Time", digits=10, decimal="."):
    texts = [f"{serial(s):.{digits}f}".replace(".", decimal) for s in record.stamps]
    return Times([head], [texts], record.time_s, iso(record.stamps[0]), {"time_tolerance_s": 1e-3})
