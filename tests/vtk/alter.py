"""Flips the last bit of the pressure of the last fluid particle in a VTP file.

    python alter.py FILE

Works on the text of the file alone, without VTK.
"""

import base64
import re
import sys

# Little-endian: the byte count, then the floats.
COUNT_BYTES = FLOAT_BYTES = 8
FLUID = 7  # particles of fluid in the first frame of the test, before its walls


def main(path):
    with open(path, encoding="ascii") as file:
        text = file.read()
    offset = int(re.search(r'Name="pressure".*offset="(\d+)"', text)[1])
    begin = text.index("_", text.index("<AppendedData")) + 1 + offset
    # Four characters of base64 are three bytes.
    byte = COUNT_BYTES + FLOAT_BYTES * (FLUID - 1)
    group = begin + byte // 3 * 4
    raw = bytearray(base64.b64decode(text[group : group + 4]))
    raw[byte % 3] ^= 1
    text = text[:group] + base64.b64encode(raw).decode("ascii") + text[group + 4 :]
    with open(path, "w", encoding="ascii") as file:
        file.write(text)


main(*sys.argv[1:])
