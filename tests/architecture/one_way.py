"""Includes go one way: libballbar, its laboratory, formats, apps, and within each the rooms in the order in which CMake lists them.
The laboratory is for `simulate` alone, and `simulate` for no other room. The modules of the page import no circle.

    python3 one_way.py SOURCE_FOLDER
"""
import graphlib
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
wrong = []

rooms = []  # ("libballbar", "numerics"), lowest first
parts = ("libballbar", "libballbar/lab", "formats", "apps")
for part in parts:
    for folder in re.findall(r"^ *room\([\w-]+ (\S+)", (source / part / "CMakeLists.txt").read_text(), re.M):
        room = (part, re.sub(r"^src(/|$)|^\.$", "", folder))
        if room not in rooms:
            rooms.append(room)


def room_of(part, folder):
    """The room of a file, nested ones first; None of one in no room."""
    while (part, folder) not in rooms and folder:
        folder = folder.rpartition("/")[0]
    return rooms.index((part, folder)) if (part, folder) in rooms else None


# Who may include what is not for all rooms that come after it.
only = {"ballbar/lab/": ("libballbar/lab", "apps/simulate"), "simulate/": ("apps/simulate", "apps/results")}
simulate = rooms.index(("apps", "simulate"))


def included(part, file, own):
    """(part, folder) of what an include in quotes names."""
    public = re.match(r"ballbar/(formats/|lab/)?(?:internal/)?(?:(.*)/)?[^/]*$", file)
    if public:
        return {"formats/": "formats", "lab/": "libballbar/lab", None: "libballbar"}[public[1]], public[2] or ""
    if part == "libballbar/lab" and room_of(part, file.rpartition("/")[0]) is None:
        part = "libballbar"  # on whose own headers the laboratory is built
    if own == simulate and room_of(part, file.rpartition("/")[0]) is None:
        part = "formats"  # on whose own headers the files of virtual machines are built
    return part, file.rpartition("/")[0]


for part in parts:
    for path in sorted(source.glob(f"{part}/**/*.[ch]pp")):
        if part == "libballbar" and path.is_relative_to(source / "libballbar/lab"):
            continue
        inside = re.sub(r"^(src|include/ballbar(/formats|/lab)?(/internal)?)/?", "", path.parent.relative_to(source / part).as_posix())
        own = room_of(part, "" if inside == "." else inside)
        if own is None:
            wrong.append(f"{path.relative_to(source)}: its folder is no room of {part}/CMakeLists.txt")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            include = re.match(r'#include "(.+)"', line)
            other = room_of(*included(part, include[1], own)) if include else own
            if include and include[1].startswith("ballbar/internal/") and path.is_relative_to(source / "libballbar/include") \
                    and "internal" not in path.parts:
                wrong.append(f"{path.relative_to(source)}:{number}: a public header may not include {include[1]}")
            for begin, users in only.items():
                if include and include[1].startswith(begin) and not f"{'/'.join(rooms[own])}/".startswith(tuple(f"{user}/" for user in users)):
                    wrong.append(f"{path.relative_to(source)}:{number}: {'/'.join(rooms[own]).strip('/')} may not include "
                                 f"{include[1]}: it is for {' and '.join(users)} alone")
            if other is None or other > own:
                wrong.append(f"{path.relative_to(source)}:{number}: {'/'.join(rooms[own]).strip('/')} may not include "
                             f"{include[1]}: expected a file of its own room or of one listed before it")

page = source / "apps/page/src"
imports = {}
for path in page.rglob("*.ts"):
    names = re.findall(r'(?:from|import) "(\.[^"]*)"', path.read_text(encoding="utf-8"))
    imports[path.resolve()] = {(path.parent / f"{name}.ts").resolve() for name in names if not name.endswith((".css", ".html"))}
try:
    graphlib.TopologicalSorter(imports).prepare()
except graphlib.CycleError as error:
    circle = " -> ".join(path.relative_to(page.resolve()).as_posix() for path in reversed(error.args[1]))
    wrong.append(f"apps/page/src: expected no circle of imports, found {circle}")

print("\n".join(wrong + [f"{len(rooms)} rooms, {len(imports)} modules of the page, {len(wrong)} against the order"]))
sys.exit(1 if wrong or not rooms or not imports else 0)
