"""Numbers in text: those of a line that is printed, and the quantities that a page says."""

from __future__ import annotations

import re
from bisect import bisect
from collections.abc import Iterator
from dataclasses import dataclass

NUMBER = re.compile(r"(?<![\w.,/^·])\d+(?:,\d{3})*(?:\.\d+)?(?:e[+-]?\d+)?(?![\d.,]*\d|[⁰¹²³⁴-⁹])")
# What follows a number that is a quantity, and what the SI value is multiplied with for it.
UNITS = {
    "%": 100, "percent": 100, "cm": 100, "mm": 1e3, "ms": 1e3, "µs": 1e6, "μs": 1e6, "ns": 1e9, "min": 1 / 60,
    "°": 57.29577951308232, "degrees": 57.29577951308232, "mrad": 1e3, "mN": 1e3, "kHz": 1e-3, "m": 1, "metres": 1,
    "s": 1, "seconds": 1, "minutes": 1, "hours": 1, "N": 1, "rad": 1, "Hz": 1, "g": 1, "kg": 1, "bytes": 1, "kB": 1,
    "MB": 1, "GB": 1, "KiB": 1, "MiB": 1, "×": 1, "x": 1, "times": 1, "/s": 1, "of": 1, "out": 1, "flights": 1,
    "runs": 1, "starts": 1, "vehicles": 1, "seeds": 1, "plans": 1, "steps": 1, "tasks": 1, "million": 1,
}  # fmt: skip
_ANY = "|".join(sorted(UNITS, key=len, reverse=True))
UNIT = re.compile(
    rf"(?:(?: to | and |, | / |–)[\d.,]+){{0,2}}\$?[\s-]?({_ANY})(?![a-z])"
)  # also behind the end of a range
# No measurement: code, formulas of more than a number, links, dates, numbers of papers; what precedes a page.
CODE = re.compile(r"^```.*?^```|^ {4,}\S[^\n]*|`[^`]*`", re.MULTILINE | re.DOTALL)
OTHER = re.compile(
    r"\A---\n.*?^---|\$\$.*?\$\$|\$(?![\d.,]+\$)[^$]+\$|\]\([^)]*\)|<[^>]*>|\d{4}-\d\d-\d\d|\d{4}\.\d{5}",
    re.MULTILINE | re.DOTALL,
)
NOTEBOOK = "## What was tried"  # what nobody can print any more


def numbers_in(text: str) -> list[float]:
    """Return the numbers of a text."""
    return [value_of(number[0]) for number in NUMBER.finditer(text)]


def value_of(text: str) -> float:
    """Return a number as it is written: whole ones as int, with or without commas between thousands."""
    plain = text.replace(",", "")
    return int(plain) if plain.isdigit() else float(plain)


@dataclass(frozen=True)
class Said:
    """A number of a page: what stands there, and where; the line around it; what an SI value is multiplied with."""

    text: str
    begin: int
    line: str
    scale: float
    section: str

    def agrees(self, value: float) -> bool:
        """Whether this is `value`, to the digits that are said and but for its sign; counts are said in full."""
        said, digits = value_of(self.text), len(self.text.partition("e")[0].partition(".")[2])
        unit = 10.0**-digits
        if isinstance(said, int) and not isinstance(value, int) and said >= 100:
            unit = 10 ** (len(str(said)) - len(str(said).rstrip("0")))
        if "e" in self.text:
            unit *= 10.0 ** int(self.text.partition("e")[2])
        return any(abs(said - abs(scale * value)) <= 0.5 * unit * (1 + 1e-9) for scale in {1, self.scale})

    def as_written(self, value: float) -> str:
        """Return `value` with as many decimals, in the same unit."""
        scale = min((1, self.scale), key=lambda scale: abs(value_of(self.text) - scale * value))
        digits, e, _ = self.text.partition("e")
        decimals = len(digits.partition(".")[2])
        if e:
            return re.sub(r"e\+?(-?)0*", r"e\1", f"{scale * value:.{decimals}e}")
        return f"{scale * value:{',' if ',' in digits else ''}.{decimals}f}"


def plain(page: str) -> str:
    """Return the text of a page with blanks for what is no prose and no table."""
    for pattern in (CODE, OTHER):
        page = pattern.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), page)
    return page


def said(page: str) -> Iterator[Said]:
    """Yield the quantities of a page: numbers with a unit, with decimals or thousands, of a total, or in a table."""
    text, heads = plain(page), [0, *(head.start() for head in re.finditer(r"^#", page, re.MULTILINE)), len(page)]
    for number in NUMBER.finditer(text):
        begin, end = text.rfind("\n", 0, number.start()) + 1, text.find("\n", number.end())
        line, before, unit = text[begin:end], text[begin : number.start()], UNIT.match(text, number.end())
        place = bisect(heads, number.start(), hi=len(heads) - 1)
        section = page[heads[place - 1] : heads[place]]
        quantity = unit or line.startswith("|") or re.search(r"[.,e]|\d{5}", number[0]) or before.endswith(" of ")
        if quantity and not section.startswith(NOTEBOOK):
            yield Said(number[0], number.start(), line, UNITS[unit[1]] if unit else 1, section)
