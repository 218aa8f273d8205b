"""Writes the logs of this folder: python3 make.py FOLDER. Simulated: a warm-up of a spindle, invented throughout."""
import datetime
import math
import random
import sys
from pathlib import Path

START = datetime.datetime(2026, 11, 22, 13, 5, 10)
LEVELS_RPM = ((0, 600), (6000, 2400), (12000, 3000), (3000, 1200), (15000, 3000), (0, 1800), (9000, 2400))
CONTROL_LATE_S = 62.0


def speed_rpm(time_s):
    for level, held_s in LEVELS_RPM:
        if time_s < held_s:
            return float(level)
        time_s -= held_s
    return 0.0


def warmed(time_constant_s, step_s, rows):
    """A low pass of the heat, speed to the power 1.5, one value a row."""
    value, values = 0.0, []
    for row in range(rows):
        heat = (speed_rpm(row * step_s) / 1e4) ** 1.5
        value += (heat - value) * step_s / time_constant_s
        values.append(value)
    return values


def german(value, digits):
    return f"{value:.{digits}f}".replace(".", ",")


def main(folder):
    noise = random.Random(20261122)
    step_s, rows = 10.0, 1440
    room = [21.0 + 0.4 * math.sin(row * step_s / 5000.0) for row in range(rows)]
    rises = {tau: warmed(tau, step_s, rows) for tau in (300.0, 900.0, 1500.0, 3600.0)}
    front = [r + 9.0 * h for r, h in zip(room, rises[300.0])]
    rear = [r + 6.0 * h for r, h in zip(room, rises[900.0])]
    drive = [0.5 + 0.5 * math.sin(row * step_s / 2600.0) for row in range(rows)]  # a cabinet beside the housing
    housing = [r + 5.0 * h + 1.2 * d for r, h, d in zip(room, rises[1500.0], drive)]
    coolant = [19.0 + 0.3 * math.sin(row * step_s / 140.0) for row in range(rows)]
    x = [0.6 * (r - room[0]) for r in room]
    y = [1.9 * (h - housing[0]) for h in housing]
    z = [2.4 * h * 5.0 for h in rises[3600.0]]

    with open(folder / "warmup.csv", "w", encoding="cp1252", newline="\r\n") as file:
        file.write("Messprotokoll Spindelverlagerung (simuliert)\nPrüfer;Müller\n\n")
        file.write("Zeit;Drehzahl [1/min];Spindellast [%];Lager vorn [°C];Lager hinten [°C];Spindelgehäuse [°C];"
                   "Kühlmittel [°C];Raum [°C];Taster X [µm];Taster Y [µm];Taster Z [µm]\n")
        for row in range(0, rows, 3):
            now = START + datetime.timedelta(seconds=row * step_s)
            load = speed_rpm(row * step_s) / 15000.0 * 32.0 + noise.gauss(0.0, 0.8)
            cells = [now.strftime("%d.%m.%Y %H:%M:%S"), german(speed_rpm(row * step_s), 0), german(max(0.0, load), 1)]
            cells += [german(t[row], 1) for t in (front, rear, housing, coolant, room)]
            if row == 300:
                cells[6] = "#NV"
            cells += [german(d[row] + noise.gauss(0.0, 0.1), 2) for d in (x, y, z)]
            file.write(";".join(cells) + "\n")

    with open(folder / "probes.csv", "w", encoding="utf-8") as file:
        file.write("Time (s),Speed (rpm),Probe X (um),Probe Y (um),Probe Z (um)\n")
        for row in range(rows):
            cells = [f"{row * step_s:.1f}", f"{speed_rpm(row * step_s):.0f}"]
            cells += [f"{d[row] + noise.gauss(0.0, 0.1):.2f}" for d in (x, y, z)]
            file.write(",".join(cells) + "\n")

    with open(folder / "control.csv", "w", encoding="utf-8") as file:
        file.write("Uhrzeit\tSpindellast\tLager vorn\tSpindelgehäuse\tRaum\n\t%\t°C\t°C\t°C\n")
        for second in range(0, int(rows * step_s) - 120, 15):
            true_s = second + CONTROL_LATE_S
            row = int(true_s / step_s)
            now = START + datetime.timedelta(seconds=second)
            load = speed_rpm(true_s) / 15000.0 * 32.0 + noise.gauss(0.0, 0.8)
            cells = [now.strftime("%H:%M:%S"), german(max(0.0, load), 1)]
            cells += [german(t[row], 1) for t in (front, housing, room)]
            file.write("\t".join(cells) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
