"""Pixels of PNG files as chute writes them, without another program: one start of ffmpeg costs more than the picture."""
import struct
import zlib

CHANNELS = {2: 3, 6: 4}  # colour types: RGB, RGBA


def rgb(path):
    """Red, green, blue of all pixels of a file of 8 bits a channel, row after row; alpha is left out."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and color in CHANNELS and not interlaced, path
        elif kind == b"IDAT":
            packed += body
        at += 12 + size
    n = CHANNELS[color]
    row, rows = bytearray(n * width), []
    lines = zlib.decompress(packed)
    for y in range(height):
        start = y * (n * width + 1)
        row = unfiltered(lines[start], bytearray(lines[start + 1:start + 1 + n * width]), row, n)
        rows.append(row)
    if n == 3:
        return b"".join(bytes(one) for one in rows)
    out = bytearray(3 * width * height)
    everything = b"".join(bytes(one) for one in rows)
    for k in range(3):
        out[k::3] = everything[k::4]
    return bytes(out)


def unfiltered(kind, row, above, n):
    """A row as it was before PNG's filter `kind`; n bytes a pixel."""
    if kind == 1:
        for k in range(n, len(row)):
            row[k] = (row[k] + row[k - n]) & 255
    elif kind == 2:
        for k, up in enumerate(above):
            row[k] = (row[k] + up) & 255
    elif kind == 3:
        for k, up in enumerate(above):
            row[k] = (row[k] + ((row[k - n] if k >= n else 0) + up >> 1)) & 255
    elif kind == 4:
        for k, up in enumerate(above):
            left, corner = (row[k - n], above[k - n]) if k >= n else (0, 0)
            to_left, to_up, to_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            row[k] = (row[k] + (left if to_left <= to_up and to_left <= to_corner else up if to_up <= to_corner else corner)) & 255
    return row
