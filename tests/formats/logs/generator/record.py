"""A record is what a logger saw; a Log is the file it wrote of it, with the truth beside."""

import json
import random
from dataclasses import dataclass, field
from datetime import datetime, timedelta

import names
import physics
import units


@dataclass
class Signal:
    """One column: numbers as written in the unit `text`, missing ones None."""
    source: str
    text: str          # unit as written, "" for none
    numbers: list
    digits: int
    role: str | None = None
    optional: bool = False   # a reader may leave it out (a channel without a reading, a second time)

    @property
    def unit(self):
        return units.BY_SPELLING[self.text][0] if self.text else ""

    def truth(self):
        factor, offset = units.BY_SPELLING[self.text][1:] if self.text else (1.0, 0.0)
        values = [None if n is None else n * factor + offset for n in self.numbers]
        out = {"source": self.source, "unit": self.unit, "values": values, "role": self.role}
        return out | {"optional": True} if self.optional else out

    def blank(self, rows):
        """Makes the readings of these rows missing; the file shows there whatever the logger shows."""
        for row in rows:
            self.numbers[row] = None


class Record:
    """Rows, interval and start of one recording; everything random comes from its name."""

    def __init__(self, name, rows, interval_us, start=None, times_us=None):
        self.name, self.rng = name, random.Random(name)
        self.rows, self.interval_us = rows, interval_us
        self.start = start or datetime(2026, 11, 22, 13, 5, 10)
        self.times_us = times_us or [i * interval_us for i in range(rows)]
        self.simulated = physics.simulate(self.rng, [us / 1e6 for us in self.times_us])

    @property
    def time_s(self):
        return [us / 1e6 for us in self.times_us]

    @property
    def stamps(self):
        return [self.start + timedelta(microseconds=us) for us in self.times_us]

    def signal(self, key, language="en", unit=None, digits=None, name=None, role=True):
        """The signal `key` by a name of that language. `unit` "" writes none: nothing then tells the unit."""
        text = units.base_unit(key)[0] if not unit else unit
        digits = units.digits_in(key, text) if digits is None else digits
        numbers = [round(units.written(v, key, text), digits) + 0.0 for v in self.simulated[key]]
        source = names.name_of(self.rng, key, language) if name is None else name
        return Signal(source, "" if unit == "" else text, numbers, digits, names.ROLES.get(key) if role is True else role)

    def signals(self, keys, language="en", **same):
        taken = [self.signal(key, language, **same) for key in keys]
        percent = any(s.unit == "percent" for s in taken)
        for s in taken:      # the load is the percentage where there is one, else the power
            if s.unit == "W" and percent:
                s.role = None
        return taken


@dataclass
class Log:
    file: str
    family: str
    content: bytes
    time_s: list
    columns: list
    started: str | None = None
    expect: str = "read"
    why: str = ""
    options: list | None = None
    skipped: list = field(default_factory=list)
    extra: dict = field(default_factory=dict)   # time_tolerance_s, time_s_also, started_also, may_refuse

    def write(self, folder):
        (folder / self.file).write_bytes(self.content)
        truth = {"file": self.file, "family": self.family, "expect": self.expect, "why": self.why, "options": self.options,
                 "time_s": self.time_s, "started": self.started, "columns": [c.truth() for c in self.columns],
                 "skipped": self.skipped} | self.extra
        (folder / (self.file + ".truth.json")).write_text(json.dumps(truth, ensure_ascii=False), encoding="utf-8")


def iso(stamp):
    """`started` of a truth: to the second where it is one, else with its fraction."""
    return stamp.isoformat()
