"""The words of an SVG file, a line each, in their order; numbers alone are left out.

    python3 svg_text.py FILE.svg

Fails where the file is no XML, or holds anything but shapes and text.
"""
import re
import sys
import xml.etree.ElementTree as tree

DRAWN = {"svg", "g", "title", "desc", "text", "rect", "path", "polyline", "polygon", "circle", "line", "defs",
         "clipPath", "style"}

for element in tree.parse(sys.argv[1]).iter():
    name = element.tag.removeprefix("{http://www.w3.org/2000/svg}")
    if name not in DRAWN or any("href" in key or key.startswith("on") for key in element.attrib):
        sys.exit(f"{sys.argv[1]}: found <{name} {element.attrib}>")
    if name == "text" and not re.fullmatch(r"[-−+]?[\d.,]+", element.text or ""):
        print(element.text)
