"""Units as people and loggers write them: canonical name, and value in it = factor * written + offset."""

SPELLINGS = {
    ("degC", 1.0, 0.0): ("°C", "º C", "deg C", "degC", "C", "℃", "Â°C", "ºC", "Grad C", "gradi C", "Deg C", "Cel", "[°C]"),
    ("degC", 5 / 9, -160 / 9): ("°F", "degF", "deg F", "F"),
    ("degC", 1.0, -273.15): ("K",),
    ("um", 1.0, 0.0): ("µm", "μm", "um", "Âµm", "㎛", "micron"),
    ("um", 1000.0, 0.0): ("mm", "㎜"),
    ("um", 0.001, 0.0): ("nm",),
    ("um", 25400.0, 0.0): ("in", "inch"),
    ("rpm", 1.0, 0.0): ("rpm", "1/min", "min-1", "min^-1", "min⁻¹", "U/min", "tr/min", "giri/min", "r/min", "RPM",
                        "rev/min", "转/分", "回転/分", "/min"),
    ("percent", 1.0, 0.0): ("%", "percent", "Prozent"),
    ("A", 1.0, 0.0): ("A", "Amps", "A rms"),
    ("A", 0.001, 0.0): ("mA",),
    ("W", 1.0, 0.0): ("W",),
    ("W", 1000.0, 0.0): ("kW",),
    ("Nm", 1.0, 0.0): ("Nm", "N·m", "N*m", "N m"),
    ("bar", 1.0, 0.0): ("bar",),
    ("l_per_min", 1.0, 0.0): ("l/min", "L/min"),
    ("mm_per_min", 1.0, 0.0): ("mm/min",),
    ("mm_per_min", 1000.0, 0.0): ("m/min",),
    ("V", 1.0, 0.0): ("V", "Volts", "Volt"),
    ("V", 0.001, 0.0): ("mV",),
    ("s", 1.0, 0.0): ("s", "sec"),
}

BY_SPELLING = {text: meaning for meaning, texts in SPELLINGS.items() for text in texts}

# Unit of the simulation and the digits a logger shows, by the first letters of the key
BASE = (
    ("speed", "rpm", 0), ("load", "%", 1), ("power", "kW", 2), ("torque", "Nm", 2), ("current", "A", 2), ("T_", "°C", 2),
    ("X", "µm", 2), ("Y", "µm", 2), ("Z", "µm", 2), ("feed", "mm/min", 0), ("pressure", "bar", 2), ("flow", "l/min", 1),
    ("voltage", "V", 4), ("pos_", "mm", 4),
)


def base_unit(key):
    """Unit of the simulated signal `key` and the digits after the point that are usual for it."""
    return next((unit, digits) for start, unit, digits in BASE if key.startswith(start))


def digits_in(key, text):
    """Digits after the point where `key` is written in the unit `text`: as fine as in its usual one."""
    unit, digits = base_unit(key)
    ratio = BY_SPELLING[text][1] / BY_SPELLING[unit][1]
    while ratio > 3:
        ratio, digits = ratio / 10, digits + 1
    return digits


def written(value, key, text):
    """A simulated value of `key` in the unit `text`."""
    _, factor, offset = BY_SPELLING[base_unit(key)[0]]
    _, to_factor, to_offset = BY_SPELLING[text]
    return (value * factor + offset - to_offset) / to_factor
