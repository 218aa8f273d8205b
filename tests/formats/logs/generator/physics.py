"""A spindle that warms up: speed in steps, load, temperatures that lag the speed, probes that follow the temperatures."""

import math

PROBES = ("X1", "X2", "Y1", "Y2", "Z")

# tau in s, rise in K at the highest speed
TEMPERATURES = {
    "T_bearing_front": (600.0, 14.0), "T_bearing_rear": (800.0, 11.0), "T_motor": (420.0, 21.0),
    "T_housing": (1500.0, 8.0), "T_head": (2600.0, 5.0), "T_column": (5200.0, 2.1), "T_bed": (7000.0, 1.1),
    "T_oil": (900.0, 6.5), "T_nut": (700.0, 4.2),
}


def speed_rpm(rng, t):
    """Steps with a ramp that takes a fortieth of the record, 1.5 s at the most."""
    total = (t[-1] - t[0]) or 1.0
    ramp = min(1.5, total / 40)
    levels = [0.0] + [float(rng.choice((1500, 3000, 4500, 6000, 8000, 12000, 15000, 18000))) for _ in range(3)] + [0.0]
    edges = [0.05, 0.3 + 0.1 * rng.random(), 0.55 + 0.1 * rng.random(), 0.85]
    speed, out, before = 0.0, [], t[0]
    for now in t:
        level = levels[sum(1 for edge in edges if (now - t[0]) / total >= edge)]
        speed += (level - speed) * (1 - math.exp(-(now - before) / ramp))
        before = now
        out.append(max(0.0, speed + (rng.gauss(0, 0.0006) * speed if level else 0.0)))
    return out


def simulate(rng, t):
    """All signals of one record in rpm, %, kW, Nm, A, degC, um, mm/min, bar, l/min, V, mm, by key."""
    speed = speed_rpm(rng, t)
    top = 18000.0
    cut = [1.0 if math.sin(0.7 + 23 * (now - t[0]) / ((t[-1] - t[0]) or 1)) > 0.4 else 0.0 for now in t]
    out = {"speed": speed}
    out["load"] = [max(0.0, 2 + 21 * s / top + (17 * c if s > 100 else 0) + rng.gauss(0, 0.6)) for s, c in zip(speed, cut)]
    out["power"] = [0.18 + 0.22 * load * (0.2 + s / top) for load, s in zip(out["load"], speed)]
    out["torque"] = [1000 * p / max(52.0, 2 * math.pi * s / 60) for p, s in zip(out["power"], speed)]
    out["current"] = [0.4 + 0.62 * q + rng.gauss(0, 0.03) for q in out["torque"]]
    room0 = 20.4 + rng.random()
    room = [room0 + 0.9 * math.sin((now - t[0]) / 5400) + rng.gauss(0, 0.02) for now in t]
    out["T_room"] = room
    out["T_coolant"] = [room0 - 0.4 + 0.5 * math.sin((now - t[0]) / 95) + rng.gauss(0, 0.02) for now in t]
    for key, (tau, rise) in TEMPERATURES.items():
        value, before, column = room0 + 0.3 * rng.random(), t[0], []
        for now, s, r in zip(t, speed, room):
            value += (r + rise * (s / top) ** 1.5 - value) * (1 - math.exp(-(now - before) / tau))
            before = now
            column.append(value + rng.gauss(0, 0.02))
        out[key] = column
    gains = {"X1": (1.3, 0.8), "X2": (0.9, 0.5), "Y1": (-3.1, 2.2), "Y2": (-2.2, 1.9), "Z": (4.1, -1.3)}
    for key, (front, column) in gains.items():
        f, c = out["T_housing"], out["T_column"]
        out[key] = [front * (f[i] - f[0]) + column * (c[i] - c[0]) + rng.gauss(0, 0.1) for i in range(len(t))]
    out["feed"] = [max(0.0, 3000 * c + rng.gauss(0, 4)) if s > 100 else 0.0 for s, c in zip(speed, cut)]
    out["pressure"] = [5.8 + 0.2 * math.sin(i / 17) + rng.gauss(0, 0.01) for i in range(len(t))]
    out["flow"] = [12.4 + 0.5 * math.cos(i / 29) + rng.gauss(0, 0.04) for i in range(len(t))]
    out["voltage"] = [2.5 + 0.004 * (q - out["T_housing"][0]) for q in out["T_housing"]]
    for axis, phase in (("pos_X", 0.3), ("pos_Y", 1.1), ("pos_Z", 2.0)):
        out[axis] = [200 + 120 * math.sin(phase + 9 * (now - t[0]) / ((t[-1] - t[0]) or 1)) for now in t]
    return out
