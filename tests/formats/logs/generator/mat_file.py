"""MAT files of version 5 as bytes: numbers in several classes, texts, structs, compressed or not, either byte order."""

import struct
import zlib

DOUBLE, SINGLE, INT8, UINT8, INT16, UINT16, INT32, UINT32 = (6, 7, 8, 9, 10, 11, 12, 13)      # classes of arrays
STORED = {DOUBLE: (9, "d"), SINGLE: (7, "f"), INT8: (1, "b"), UINT8: (2, "B"), INT16: (3, "h"), UINT16: (4, "H"), INT32: (5, "i"),
          UINT32: (6, "I")}
MATRIX, COMPRESSED = 14, 15


class Writer:
    def __init__(self, order="<"):
        self.order = order

    def element(self, kind, data):
        if len(data) <= 4 and kind != MATRIX:
            small = (len(data) << 16) | kind
            return struct.pack(self.order + "I", small) + data.ljust(4, b"\0")
        return struct.pack(self.order + "II", kind, len(data)) + data + b"\0" * (-len(data) % 8)

    def array(self, kind, name, dims, content):
        flags = self.element(6, struct.pack(self.order + "II", kind, 0))
        sizes = self.element(5, struct.pack(f"{self.order}{len(dims)}i", *dims))
        return self.element(MATRIX, flags + sizes + self.element(1, name.encode()) + content)

    def numbers(self, name, values, kind=DOUBLE, dims=None, stored=None):
        """A column vector; `stored` is a smaller type for whole numbers of an array of doubles, as MATLAB does."""
        code, letter = STORED[stored or kind]
        data = struct.pack(f"{self.order}{len(values)}{letter}", *(values if letter in "df" else map(int, values)))
        return self.array(kind, name, dims or (len(values), 1), self.element(code, data))

    def text(self, name, text):
        return self.array(4, name, (1, len(text)), self.element(4, struct.pack(f"{self.order}{len(text)}H", *map(ord, text))))

    def cell(self, name, elements):
        return self.array(1, name, (1, len(elements)), b"".join(elements))

    def structure(self, name, fields):
        """`fields` is a list of (name, array without a name)."""
        names = b"".join(field.encode().ljust(32, b"\0") for field, _ in fields)
        return self.array(2, name, (1, 1), self.element(5, struct.pack(self.order + "i", 32)) + self.element(1, names) +
                          b"".join(array for _, array in fields))

    def compressed(self, element):
        data = zlib.compress(element, 6)
        return struct.pack(self.order + "II", COMPRESSED, len(data)) + data

    def file(self, elements):
        text = b"MATLAB 5.0 MAT-file, Platform: GLNXA64, Created on: Sun Nov 22 13:05:10 2026".ljust(116)
        return text + b"\0" * 8 + struct.pack(self.order + "HH", 0x0100, 0x4D49) + b"".join(elements)
