"""Colours of all figures, movies and pages, distinguishable under every type of colour vision."""

from __future__ import annotations

from typing import Any

# The Okabe-Ito palette. Lines also differ in style and width, so that figures survive greyscale printing.
INK, GREY = "#1a1a1a", "#8c8c8c"
BLUE, RED, GREEN, ORANGE, SKY, PINK = "#0072b2", "#d55e00", "#009e73", "#e69f00", "#56b4e9", "#cc79a7"
SERIES = (BLUE, RED, GREEN, PINK, ORANGE, SKY, "#000000")  # one per law or run in a comparison
REAR = "#d9d9d9"  # rear rotors; front rotors are orange
# Colours for words, 4.5 to 1 on white, which those of lines are not: red, green, and between them amber.
ALARM, GOOD, WAIT = "#b3261e", "#007a58", "#8a5a00"
STATES = {"done": GOOD, "recovering": WAIT, "failed": ALARM}  # of a flight, in words and pages
# One colour per cause of failure, in every picture.
CAUSES = {
    "rod": BLUE, "axis": ORANGE, "position": GREEN, "diverged": RED, "singular": PINK, "collided": SKY,
}  # fmt: skip

_LIGHT = {
    "paper": "#ffffff", "panel": "#ffffff", "sky": "#f3f5f7", "ink": INK, "muted": "#5f6368", "line": "#e1e4e8",
    "grid": "#8a94a0", "body": "#3a3f45", "front": ORANGE, "rear": "#9aa1a9", "rod": RED, "thrust": GREEN,
    "trail": BLUE, "reference": "#a0568a", "ghost": "#4b6a88",
    "rotor1": BLUE, "rotor2": RED, "rotor3": GREEN, "rotor4": PINK, **STATES,
    "barred": "#f6e3d8",
}  # fmt: skip
_DARK = {
    "paper": "#14171b", "panel": "#1d2126", "sky": "#1a1e23", "ink": "#eceff2", "muted": "#a3abb5", "line": "#2f353c",
    "grid": "#66707c", "body": "#aab2bb", "front": ORANGE, "rear": "#7c858f", "rod": "#f0803c", "thrust": "#1fc296",
    "trail": SKY, "reference": "#dc93bb", "ghost": "#8fb0d0",
    "rotor1": SKY, "rotor2": "#f0803c", "rotor3": "#1fc296", "rotor4": "#dc93bb", "failed": "#ff8a80",
    "done": "#3ad6ac", "recovering": "#f2c14e", "barred": "#3a2a22",
}  # fmt: skip
PAGE: dict[str, Any] = {"light": _LIGHT, "dark": _DARK}  # colours by role, for browser pages
