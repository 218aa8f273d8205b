"""Writes a circle as another instrument or control would: circle_file.py KIND. Made, not measured: 4 um of cos 2t, 1 um
of noise that repeats, a run of each direction."""
import math
import sys

RADIUS_MM = 50.0
COUNT = 720


def deviation_mm(i):
    angle = 2 * math.pi * i / COUNT
    return 0.004 * math.cos(2 * angle) + 0.0005 * math.sin(37 * i) * math.sin(0.11 * i * i)


def rows():
    for turn in (range(COUNT), range(COUNT - 1, -1, -1)):
        for i in turn:
            yield 2 * math.pi * i / COUNT, RADIUS_MM + deviation_mm(i)


kind = sys.argv[1]
if kind == "grid":  # a grid encoder: tabs, decimal commas, the way in
    print("Grid encoder, circular test\nNominal radius:\t50,000 mm\nFeed:\t1500 mm/min\n\nX [mm]\tY [mm]")
    points = [(250 + 2.0 * i, -80.0) for i in range(10, 20)]
    points += [(250 + r * math.cos(t), -80 + r * math.sin(t)) for t, r in rows()]
    for x, y in points:
        print(f"{x:.5f}\t{y:.5f}".replace(".", ","))
elif kind == "cnc":  # a control's own test: commanded and actual position over time
    print("Time [ms];Z soll;X soll;Z ist;X ist")
    for i, (t, r) in enumerate(rows()):
        print(f"{4 * i};{50 * math.cos(t):.4f};{50 * math.sin(t):.4f};{r * math.cos(t):.5f};{r * math.sin(t):.5f}")
elif kind == "points":  # coordinates alone
    for t, r in rows():
        print(f"{r * math.cos(t):.5f} {r * math.sin(t):.5f}")
else:  # an angle and a radius
    if kind == "heading":
        print("angle,length")
    for t, r in list(rows())[:COUNT]:
        print(f"{math.degrees(t):.2f},{r:.5f}")
