"""Images of maps as SDL_image 1.2 passes them to map_server: the bytes of each pixel.

A BMP or PBM of 1 bit has the index of the colour, 0 or 1, instead of a shade.
"""

from __future__ import annotations

import re
import struct
from io import BytesIO
from typing import Any, Tuple

import numpy as np

LARGEST_MAP = 4096 * 4096  # cells
SMALLEST = 34  # bytes of a PNG or BMP
Pixels = Tuple[Any, bool]  # (rows, columns, channels) of uint8; whether the last one is alpha
NUMBER = rb"(?:\s|#[^\r\n]*[\r\n])*(\d{1,9})"
BITS = re.compile(rb"P[14]" + 2 * NUMBER + rb".", re.DOTALL)
SHADES = re.compile(rb"P[2356]" + 3 * NUMBER + rb".", re.DOTALL)
ONE_INDEX = re.compile(rb"\xff*\0?\xff*")  # a palette with at most one transparent colour


def read_pixels(data: bytes) -> Pixels:
    """Return the pixels of a PGM, PNG or BMP. Raises ValueError, or any error of Pillow."""
    if re.match(rb"P[1-6]", data):
        return _pnm(data), False
    if not data.startswith((b"\x89PNG\r", b"BM")):
        raise ValueError("no PGM, PNG or BMP")
    if len(data) < SMALLEST:
        raise ValueError("cut short")
    return _bmp(data) if data.startswith(b"BM") else _png(data)


def _check_size(columns: int, rows: int) -> None:
    if not 0 < columns * rows <= LARGEST_MAP:
        raise ValueError(f"more than {LARGEST_MAP} cells, or none")


def _pnm(data: bytes) -> Any:
    """Return the pixels of a PBM, PGM or PPM; the second byte says which."""
    has_bits, is_text = data[1:2] in b"14", data[1:2] in b"123"
    head = (BITS if has_bits else SHADES).match(data)
    if not head:
        raise ValueError("its header is malformed")
    columns, rows, *most = map(int, head.groups())
    _check_size(columns, rows)
    if most and most[0] > 255:
        raise ValueError(
            f"{most[0]} shades: map_server reads 255, so such a map does not load on the robot "
            "either; convert it: convert OLD.pgm -depth 8 NEW.pgm (ImageMagick)"
        )
    channels, body = 3 if data[1:2] in b"36" else 1, data[head.end() - is_text :]
    if has_bits:
        return _bits(body, rows, columns, is_text)
    count = rows * columns * channels
    values = _numbers(body, count) if is_text else np.frombuffer(body, np.uint8)[:count]
    if values.size < count:
        raise ValueError("cut short")
    if most[0] != 255:
        values = values.astype(np.uint32) * 255 // max(most[0], 1)
    return values.astype(np.uint8).reshape(rows, columns, channels)


def _bits(body: bytes, rows: int, columns: int, is_text: bool) -> Any:
    """Return 0 or 1 for each pixel of a PBM."""
    values = np.frombuffer(body, np.uint8)
    if is_text:
        values = values[(values == ord("0")) | (values == ord("1"))] & 1
    else:
        values = np.unpackbits(values)
    width = columns if is_text else -(-columns // 8) * 8
    if values.size < rows * width:
        raise ValueError("cut short")
    return values[: rows * width].reshape(rows, width, 1)[:, :columns]


def _numbers(body: bytes, count: int) -> Any:
    """Return numbers written as text, each followed by a blank or the end of a line."""
    text = re.sub(rb"#[^\r\n]*", b"", body)
    if not re.fullmatch(rb"\s*\d[\d\s]*", text):
        raise ValueError("its shades must be numbers from 0 to 255")
    values = np.fromstring(text, np.int64, sep=" ")
    if values.size == count and text[-1:].isdigit():
        raise ValueError("map_server needs an end of line after the last number")
    return values[:count].astype(np.uint8)


def _bmp(data: bytes) -> Pixels:
    """Return the pixels of a BMP: indices of colours, or bytes in the order B, G, R."""
    start, size = struct.unpack_from("<II", data, 10)
    columns, rows, _, bits = struct.unpack_from("<HHHH" if size == 12 else "<iiHH", data, 18)
    compression = struct.unpack_from("<I", data, 30)[0] if size > 12 else 0
    _check_size(columns, abs(rows))
    if compression in {1, 2} and bits in {4, 8}:
        return _picture(data, "P")
    if bits not in {1, 4, 8, 16, 24, 32} or compression not in {0, 3}:
        raise ValueError(f"a BMP of {bits} bits, kind {compression}: save it with 24 bits, plain")
    width, length = -(-columns * bits // 8), -(-columns * bits // 32) * 4
    lines = np.frombuffer(data + bytes(length - width), np.uint8, abs(rows) * length, start)
    values = lines.reshape(-1, length)[:: 1 if rows < 0 else -1, :width]
    if bits == 1:
        values = np.unpackbits(values, axis=1)
    elif bits == 4:
        values = np.stack((values >> 4, values & 15), axis=-1).reshape(len(values), -1)
    channels = max(1, bits // 8)
    pixels = values[:, : columns * channels].reshape(-1, columns, channels)
    mask = struct.unpack_from("<I", data, 66)[0] if compression == 3 and len(data) > 70 else 1
    return pixels, bits == 32 and mask != 0


def _png(data: bytes) -> Pixels:
    """Return the pixels of a PNG: indices of colours, shades, shades with alpha, RGB or RGBA."""
    depth, kind, transparent = data[24], data[25], _transparency(data)
    if kind == 3:  # a palette: the index of the colour counts
        return _picture(data, "P" if ONE_INDEX.fullmatch(transparent) else "RGBA")
    if kind:
        return _picture(data, "RGB" if kind == 2 else "RGBA")
    values, _ = _picture(data, "I" if depth == 16 else "L")
    shades = (values >> 8 if depth == 16 else values).astype(np.uint8)
    if not shades.any() and values.any():
        raise ValueError("map_server reads the higher 8 of its 16 bits, which are all 0")
    if transparent:
        most = (1 << depth) - 1
        level = (int.from_bytes(transparent[:2], "big") & most) * max(1, 255 // most)
        alpha = np.where(values == level, 0, 255).astype(np.uint8)
        return np.concatenate(
            (shades, alpha), axis=2
        ), False  # SDL_image reports no alpha mask here
    return shades, False


def _transparency(png: bytes) -> bytes:
    """Return the data of the chunk tRNS of a PNG; empty if there is none before the pixels."""
    place = 8
    while png[place + 4 : place + 8] not in {b"", b"IDAT"}:
        length = int.from_bytes(png[place : place + 4], "big")
        if png[place + 4 : place + 8] == b"tRNS":
            return png[place + 8 : place + 8 + length]
        place += 12 + length
    return b""


def _picture(data: bytes, mode: str) -> Pixels:
    """Return an image as Pillow reads it, in one of Pillow's modes."""
    from PIL import Image  # noqa: PLC0415  slow, and needed for these formats alone

    Image.MAX_IMAGE_PIXELS = None  # _check_size() limits it
    picture = Image.open(BytesIO(data))
    _check_size(picture.width, picture.height)
    if mode == "P" and picture.mode == "1":  # two colours, black and white
        picture = picture.convert("L").point(lambda shade: shade & 1)
    elif picture.mode != mode and mode not in {"I", "P"}:
        picture = picture.convert(mode)
    pixels = np.asarray(picture)
    return pixels.reshape(*pixels.shape[:2], -1), mode == "RGBA"
