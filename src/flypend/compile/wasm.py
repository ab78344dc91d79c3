"""WebAssembly modules from kernels: `module` turns what LLVM emits into what a browser takes.

LLVM's object file for wasm32 is a module that imports its memory and its stack pointer, and in which all indices and
addresses hold, as long as nothing is linked to it. All that it lacks is a list of exports. So no linker is needed: the
list is put in, and what only a linker reads is left out. Functions of the C library become imports, which the page
takes from its `Math`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

HEAD = b"\0asm\1\0\0\0"
CUSTOM, EXPORT = 0, 7
# Sections follow each other in this order: the count of data segments, number 12, stands before the code.
_ORDER = {number: place for place, number in enumerate((1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 10, 11))}
# The names of functions are in the custom section "linking", in its part 8, the table of symbols.
_SYMBOLS = 8
_FUNCTION, _DATA, _SECTION = 0, 1, 3
_UNDEFINED, _NAMED = 0x10, 0x40


def module(code: bytes, exports: Sequence[str]) -> bytes:
    """Return the WebAssembly module of the object file `code`, with its functions `exports` exported.

    Raises ValueError if the object lacks a function.
    """
    sections = _sections(code)
    places = dict(found for number, content in sections if number == CUSTOM for found in _functions(content))
    for name in exports:
        if name not in places:
            raise ValueError(f"one of the functions {', '.join(places)} is needed, not {name!r}")
    listed = b"".join(_text(name) + bytes([_FUNCTION]) + _encode_unsigned(places[name]) for name in exports)
    kept = [section for section in sections if section[0] != CUSTOM]
    kept.append((EXPORT, _encode_unsigned(len(exports)) + listed))
    kept.sort(key=lambda section: _ORDER[section[0]])
    return HEAD + b"".join(bytes([number]) + _encode_unsigned(len(content)) + content for number, content in kept)


def _sections(code: bytes) -> list[tuple[int, bytes]]:
    """The sections of a module: their numbers in the standard, and their contents."""
    if not code.startswith(HEAD):
        raise ValueError("an object file of WebAssembly is needed")
    reader, found = _Reader(code, len(HEAD)), []
    while reader.left():
        number = reader.byte()
        found.append((number, reader.take(reader.take_unsigned())))
    return found


def _functions(content: bytes) -> Iterator[tuple[str, int]]:
    """Names and places of the functions that a custom section defines, if it is the table of symbols."""
    reader = _Reader(content)
    if reader.text() != "linking":
        return
    reader.take_unsigned()  # version
    while reader.left():
        part, inside = reader.byte(), _Reader(reader.take(reader.take_unsigned()))
        if part != _SYMBOLS:
            continue
        for _ in range(inside.take_unsigned()):
            kind, flags = inside.byte(), inside.take_unsigned()
            if kind == _DATA:
                inside.text()
                if not flags & _UNDEFINED:
                    for _ in range(3):  # segment, offset and size
                        inside.take_unsigned()
                continue
            place = inside.take_unsigned()
            if kind == _SECTION or (flags & _UNDEFINED and not flags & _NAMED):
                continue
            name = inside.text()
            if kind == _FUNCTION and not flags & _UNDEFINED:
                yield name, place


class _Reader:
    """Takes bytes apart, from left to right."""

    def __init__(self, content: bytes, place: int = 0) -> None:
        self.content, self.place = content, place

    def left(self) -> bool:
        return self.place < len(self.content)

    def take(self, length: int) -> bytes:
        self.place += length
        if self.place > len(self.content):
            raise ValueError("a whole object file is needed, not one that is cut")
        return self.content[self.place - length : self.place]

    def byte(self) -> int:
        return self.take(1)[0]

    def take_unsigned(self) -> int:
        """An integer in seven bits a byte, the lowest first (LEB128)."""
        number = shift = 0
        while True:
            byte = self.byte()
            number |= (byte & 0x7F) << shift
            if byte < 0x80:
                return number
            shift += 7

    def text(self) -> str:
        return self.take(self.take_unsigned()).decode()


def _encode_unsigned(number: int) -> bytes:
    written = bytearray()
    while True:
        number, low = number >> 7, number & 0x7F
        written.append(low | (0x80 if number else 0))
        if not number:
            return bytes(written)


def _text(name: str) -> bytes:
    return _encode_unsigned(len(name.encode())) + name.encode()
