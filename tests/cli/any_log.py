"""Logs as people publish them: any_log.py KIND [NUMBER]. The same bytes each time."""

import math
import random
import sys
import zipfile

draw = random.Random(7)
kind, number = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 and sys.argv[2].isdigit() else 1


def lagged(values, rows):
    """A first-order lag of so many rows."""
    out = [values[0]]
    for value in values[:-1]:
        out.append(out[-1] + (value - out[-1]) / rows)
    return out


def warm_up(rows, sensors, start=21.0, period=300):
    """Temperatures of sensors, each slower and cooler than the one before."""
    heat = [12.0 if row // period % 2 == 0 else 4.0 for row in range(rows)]
    return [[start + t for t in lagged([0.0] + [h * (1 - 0.1 * k) for h in heat[1:]], 40 + 25 * k)] for k in range(sensors)]


def noisy(values, sigma):
    return [value + draw.gauss(0.0, sigma) for value in values]


def drift(temperatures):
    return noisy([2.1 * value for value in lagged([t - temperatures[2][0] for t in temperatures[2]], 60)], 0.2)


def rows(*columns):
    for cells in zip(*columns):
        print(*cells, sep=",")


def two(values):
    return [f"{value:.2f}" for value in values]


def three(values):
    return [f"{value:.3f}" for value in values]


if kind == "university":
    temperatures = warm_up(900, 8)
    print("delta L", *[f"T{k}" for k in range(8)], sep=",")
    rows(three(drift(temperatures)), *[two(noisy(one, 0.03)) for one in temperatures])
elif kind == "printer":
    print("time,frame_t,chamber_t,mcu_pos_z,sample_index")
    chamber = lagged([22.0] + [45.0] * 149, 30)
    frame = lagged(chamber, 40)
    for minute in range(150):
        for k in range(8):
            z = round(1200 - 31 * (frame[minute] - 22.0) + draw.gauss(0.0, 1.5))
            print(f"{60 * minute + 0.4 * k:.1f},{frame[minute] + draw.gauss(0, 0.02):.2f},"
                  f"{chamber[minute] + draw.gauss(0, 0.05):.2f},{z},{8 * minute + k}")
elif kind == "headless":
    temperatures = warm_up(300, 4, 19.0 + number, 60 + 20 * number)
    rows(*[two(noisy(one, 0.05)) for one in temperatures], three(drift(temperatures)))
elif kind == "probes":
    print("time,x1,x2,y1,y2,z")
    for row in range(200):
        grown = 1.0 - math.exp(-row / 60.0)
        print(10 * row, *[f"{gain * grown + draw.gauss(0.0, 0.05):.3f}" for gain in (3.0, 2.0, -1.0, -0.6, 12.0)], sep=",")
elif kind in ("inputs", "outputs"):
    temperatures = warm_up(400, 3)
    if kind == "inputs":
        print("Ambient,Spindel front,Bett")
        rows(*[two(noisy(one, 0.03)) for one in reversed(temperatures)])
    else:
        print("Dia Disp")
        rows(three(drift(temperatures)))
elif kind == "garbage":
    temperatures = warm_up(1000, 3)
    values = drift(temperatures)
    bad = set(draw.sample(range(10, 990), number))
    print("time_s;z_um;T1_degC")
    for row in range(1000):
        print(f"{10 * row};#!x7;kaputt" if row in bad else f"{10 * row};{values[row]:.3f};{temperatures[0][row]:.2f}")
elif kind in ("machine", "hall"):  # of one day; the hall's clock is 6 h behind
    hall, bearing, events = [18.0], [18.0], random.Random(5)
    heats = spins = False
    for minute in range(1440):
        heats = heats ^ (events.random() < 0.03)
        spins = spins ^ (events.random() < 0.02)
        hall.append(hall[-1] + ((24.0 if heats else 17.0) - hall[-1]) / 20.0)
        bearing.append(bearing[-1] + (hall[-1] + (1.0 if spins else 0.0) - bearing[-1]) / 4.0)
    step, hour = (1, 6) if kind == "machine" else (5, 0)
    print("Time,Front bearing (C),Probe Z (um)" if kind == "machine" else "Date,Hall temp (F)")
    for minute in range(0, 1440, step):
        at = f"2026-03-{9 + (minute // 60 + hour) // 24:02d} {(minute // 60 + hour) % 24:02d}:{minute % 60:02d}:00"
        if kind == "machine":
            far = 300.0 if minute in (300, 700) else 0.0
            print(f"{at},{bearing[minute] + draw.gauss(0, 0.03):.2f},{1.5 * (bearing[minute] - 18) + far + draw.gauss(0, 0.2):.2f}")
        else:
            print(f"{at},{32 + 1.8 * (hall[minute] + draw.gauss(0, 0.03)):.1f}")
elif kind == "circle":
    print("angle,length")
    for degree in range(360):
        angle = math.radians(degree)
        length = 100.0 + 0.004 * number * math.cos(angle) - 0.002 * math.sin(angle) + draw.gauss(0.0, 0.0002)
        print(f"{degree},{length:.5f}")
elif kind == "toa5":
    print('"TOA5","Bridge","CR6","1001","CR6.Std.09","CPU:gap.CR6","1234","gap"')
    print('"TIMESTAMP","RECORD","T_bed_Avg","Gap_Avg"\n"TS","RN","Deg C","mm"\n"","","Avg","Avg"')
    for row, (bed, gap) in enumerate(zip(warm_up(40, 1)[0], warm_up(40, 1)[0])):
        shown = '"NAN"' if row == 3 else f"{bed:.3f}"
        print(f'"2026-02-01 {row // 4:02}:{15 * (row % 4):02}:00",{row + 311},{shown},{0.5 + 0.001 * gap:.5f}')
elif kind == "channels":
    for row, (front, rear) in enumerate(zip(*warm_up(30, 2))):
        print(f"MC:T-Front  2026-03-02 11:{row:02}:00.000000 {front:.3f}  " + ("HIGH MINOR" if front > 24.0 else ""))
        if row % 2 == 0:
            print(f"MC:Z-Probe  2026-03-02 11:{row:02}:20.000000 {2.0 * (rear - 21.0):.3f}  ")
elif kind in ("workbook", "points"):
    def sheet(lines):
        cells = "".join(f"<row r='{i}'>" + "".join(f"<c t='str'><v>{c}</v></c>" if isinstance(c, str) else f"<c><v>{c}</v></c>"
                                                  for c in line) + "</row>" for i, line in enumerate(lines, 1))
        return f"<worksheet><sheetData>{cells}</sheetData></worksheet>"

    book = {"Read me": [["A spindle, three days"], ["sensor", "place"], ["T1", "front"]], "empty": []}
    for day in range(3):
        temperatures = warm_up(120, 2, 19.5 + day, 30 + 10 * day)
        values = [2.1 * (t - temperatures[1][0]) + draw.gauss(0.0, 0.2) for t in temperatures[1]]
        book[f"day {day + 1}"] = [["Time (s)", "T front", "T rear", "dz (um)"]] + [
            [10 * k, round(a, 2), round(b, 2), round(v, 3)] for k, (a, b, v) in enumerate(zip(*temperatures, values))]
    if kind == "points":
        angles = draw.sample([math.radians(15.0 * k) for k in range(24)], 24)
        book = {"ring": [["Ring gauge"], ["No.", "x (mm)", "y (mm)"]] + [
            [k, round(12.0 + 25.002 * math.cos(a), 4), round(-3.0 + 25.002 * math.sin(a), 4)] for k, a in enumerate(angles, 1)]}
    with zipfile.ZipFile(sys.argv[2], "w") as archive:
        names = "".join(f"<sheet name='{name}' sheetId='{k}'/>" for k, name in enumerate(book, 1))
        archive.writestr("xl/workbook.xml", f"<workbook><sheets>{names}</sheets></workbook>")
        for k, lines in enumerate(book.values(), 1):
            archive.writestr(f"xl/worksheets/sheet{k}.xml", sheet(lines))
