"""Draw the diagrams of the documentation: `python -m benchmarks.diagrams [NAME …]` writes docs/img/NAME.svg, or all.

Each is one file for both themes: its colours follow the colour scheme of the page that shows it.
"""

import math
import sys
from collections.abc import Callable, Iterable, Sequence
from html import escape
from pathlib import Path

import numpy as np

import flypend as fp
from flypend import palette
from flypend.paper import experiment

FOLDER = Path(__file__).parents[1] / "docs" / "img"
WIDTH = 480  # a phone shows it three quarters as large, and letters of 14 stay legible
ROLES = {
    "ink": "ink",
    "muted": "muted",
    "line": "grid",
    "panel": "sky",
    "blue": "rotor1",
    "red": "rotor2",
    "green": "rotor3",
    "pink": "rotor4",
    "barred": "barred",
}


def theme(name: str) -> str:
    """Return the colours of a theme as properties of CSS."""
    return "".join(f"--{role}:{palette.PAGE[name][key]};" for role, key in ROLES.items())


STYLE = (
    f"svg{{{theme('light')}}}@media(prefers-color-scheme:dark){{svg{{{theme('dark')}}}}}"
    "text{font:14px system-ui,sans-serif;fill:var(--ink)}.small{font-size:12px}.muted{fill:var(--muted)}"
    ".strong{font-weight:600}.code{font:13px ui-monospace,monospace}.it{font-style:italic}"
    ".box{fill:var(--panel);stroke:var(--line)}.edge{fill:none;stroke:var(--ink);stroke-width:1.5}"
    ".grid{stroke:var(--line);stroke-width:.7}.dash{stroke-dasharray:5 4}.curve{fill:none;stroke-width:2.2}"
    ".blue{stroke:var(--blue)}.red{stroke:var(--red)}.green{stroke:var(--green)}.pink{stroke:var(--pink)}"
    ".in-blue{fill:var(--blue)}.in-red{fill:var(--red)}.in-green{fill:var(--green)}.in-pink{fill:var(--pink)}"
    ".band{fill:var(--panel)}.barred{fill:var(--barred)}"
)


class Drawing:
    """Shapes in pixels, y down, and what they look like as SVG."""

    def __init__(self, height: float) -> None:
        self.height = height
        self.parts: list[str] = []
        self.heads = ["ink"]  # colours of arrows

    def text(self, x: float, y: float, said: str, look: str = "", anchor: str = "middle") -> None:
        """Write `said` with its base line at (x, y)."""
        self.parts.append(f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" class="{look}">{escape(said)}</text>')

    def box(
        self,
        x: float,
        y: float,
        width: float,
        height: float,
        lines: Sequence[str],
        look: str = "box",
    ) -> None:
        """Draw a box with lines of text in its middle; the first is strong, one in backticks is code."""
        self.parts.append(f'<rect x="{x:g}" y="{y:g}" width="{width:g}" height="{height:g}" rx="6" class="{look}"/>')
        top = y + height / 2 - 9 * (len(lines) - 1) + 5
        for i, said in enumerate(lines):
            kind = "code" if said.startswith("`") else "strong" if i == 0 else "small"
            self.text(x + width / 2, top + 18 * i, said.strip("`"), kind)

    def path(self, points: Iterable[Sequence[float]], look: str = "edge", *, arrow: bool = False) -> None:
        """Draw a line through `points`."""
        d = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        colour = next((role for role in ROLES if role in look.split()), "ink")
        if arrow and colour not in self.heads:
            self.heads.append(colour)
        head = f' marker-end="url(#{"head" if colour == "ink" else colour})"' if arrow else ""
        self.parts.append(f'<path d="{d}" class="{look}"{head}/>')

    def arrow(self, *points: Sequence[float], look: str = "edge") -> None:
        """Draw a line with a head at its end."""
        self.path(points, look, arrow=True)

    def dot(self, x: float, y: float, look: str = "in-blue", radius: float = 4) -> None:
        """Draw a disc."""
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" class="{look}"/>')

    def band(self, x: float, y: float, width: float, height: float, look: str = "band") -> None:
        """Fill a rectangle without an edge."""
        self.parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" class="{look}"/>')

    def svg(self) -> str:
        """Return the file."""
        head = "".join(
            f'<marker id="{"head" if colour == "ink" else colour}" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" '
            f'markerHeight="8" orient="auto"><path d="M0 0L8 4L0 8z" fill="var(--{colour})"/></marker>'
            for colour in self.heads
        )
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height:g}" width="{WIDTH}">'
            f"<style>{STYLE}</style><defs>{head}</defs>{''.join(self.parts)}</svg>\n"
        )


def stack(draw: Drawing, rows: Sequence[Sequence[str]], x: float, y: float, width: float) -> list[float]:
    """Draw boxes below each other, joined by arrows; return the heights of their middles."""
    middles = []
    for i, lines in enumerate(rows):
        height = 18 * len(lines) + 16
        draw.box(x, y, width, height, lines)
        middles.append(y + height / 2)
        y += height
        if i < len(rows) - 1:
            draw.arrow((x + width / 2, y), (x + width / 2, y + 26))
        y += 26
    return middles


def free_body() -> Drawing:
    """Return the forces on vehicle and bob, and the order in which they move the machine."""
    draw = Drawing(300)
    pivot, y, z = np.array([105.0, 195.0]), np.array([0.42, -0.91]), np.array([-0.26, -0.97])
    bob, side = pivot + 120 * y, np.array([-z[1], z[0]])
    draw.path((pivot, bob))
    draw.path((pivot - 52 * side, pivot + 52 * side), "curve blue")
    for end in (-52, 52):
        rotor = pivot + end * side + 7 * z
        draw.path((rotor - 16 * side, rotor + 16 * side), "curve blue")
    draw.dot(*pivot, radius=5)
    draw.dot(*bob, "in-red", 8)
    for start, step, said, place in (
        (pivot, 95 * z, "f z", (-12, 4)),
        (pivot, np.array([0.0, 72.0]), "M g", (10, 4)),
        (bob, np.array([0.0, 58.0]), "m g", (8, 4)),
        (pivot + 8 * side, 46 * y, "T y", (12, 14)),
        (bob - 9 * side, -46 * y, "−T y", (-8, 4)),
    ):
        end = start + step
        draw.arrow(start, end)
        draw.text(end[0] + place[0], end[1] + place[1], said, "it", "end" if place[0] < 0 else "start")
    draw.text(bob[0], bob[1] - 16, "bob p = x + l y", "small")
    draw.text(pivot[0] - 14, pivot[1] + 24, "pivot x", "small", "end")
    rows = (
        ("Moment τ turns the vehicle", "R, ω; thrust axis z = R e₃"),
        ("Thrust across the rod turns it", "y, H"),
        ("All forces move the whole", "centre of mass c"),
    )
    stack(draw, rows, 226, 46, 250)
    return draw


def law_cascade() -> Drawing:
    """Return the steps of the inverted law, from the position of the bob to the rotors."""
    rows = (
        ("Where should the bob go?", "acceleration A, rod direction d = A/|A|", "`demand`"),
        (
            "Which force turns and carries the rod?",
            "force F on the vehicle; throws while the rod is low",
            "`steering_force`",
        ),
        (
            "Where should the vehicle point?",
            "thrust f, thrust axis along F, ahead in time",
            "`inverted_control`",
        ),
        ("Which moment takes it there?", "moment in the body frame", "`axis_moment`"),
        ("Which forces can the rotors give?", "limits, lag and delay", "flight computer"),
    )
    draw = Drawing(478)
    middles = stack(draw, rows, 20, 8, 330)
    for i, said in enumerate(("p, v", "y, ẏ", "y, ẏ, z", "R, ω", "")):
        if said:
            draw.arrow((408, middles[i]), (352, middles[i]))
            draw.text(414, middles[i] + 5, said, "it", "start")
    draw.text(440, 30, "state", "small muted")
    return draw


def theorem_cascade() -> Drawing:
    """Return the cascade of Theorem B."""
    rows = (
        ("Position loop", "asks the bob for A, never zero", "V gains  U + ½|v|²"),
        (
            "Lemma S: turn the rod to d = A/|A|",
            "asks for the force F, never zero",
            "V gains  k Ψ(y·d) + ½ρ|ζ|²",
        ),
        (
            "Lemma S: turn the axis to F/|F|",
            "asks for the moment",
            "V gains  k Ψ(z·z_d) + ½ρ|ζ|²",
        ),
        ("Vehicle", "thrust f > 0 and moment, as commanded"),
    )
    draw = Drawing(362)
    middles = stack(draw, rows, 20, 8, 330)
    for a, b, said in ((1, 0, "rod not yet at d"), (2, 1, "axis not yet at F")):
        x = 392
        draw.arrow(
            (350, middles[a] - 12),
            (x, middles[a] - 12),
            (x, middles[b] + 12),
            (353, middles[b] + 12),
            look="edge dash",
        )
        draw.text(
            x + 8,
            (middles[a] + middles[b]) / 2 - 4,
            said.rsplit(" ", 3)[0],
            "small muted",
            "start",
        )
        draw.text(
            x + 8,
            (middles[a] + middles[b]) / 2 + 12,
            " ".join(said.rsplit(" ", 3)[1:]),
            "small muted",
            "start",
        )
    return draw


def sensor_timing() -> Drawing:
    """Return when readings of motion capture are taken and when they arrive: 500 Hz against 200 Hz late by 10 ms."""
    draw = Drawing(236)
    left, step = 104, 17.4  # pixels, per millisecond
    at = lambda t: left + step * t  # noqa: E731
    rows = {
        "control tick": 34,
        "gyroscope": 66,
        "pose taken": 98,
        "pose arrives": 176,
        "its age": 212,
    }
    for said, y in rows.items():
        draw.text(92, y + 5, said, "small", "end")
        if said != "its age":
            draw.path(((at(0), y), (at(20.6), y)), "grid")
    for t in range(0, 21, 2):
        draw.path(((at(t), rows["control tick"] - 6), (at(t), rows["control tick"] + 6)))
        draw.dot(at(t), rows["gyroscope"], "in-green", 3.5)
        if t % 4 == 0:
            draw.text(at(t), 16, f"{t} ms" if t == 0 else str(t), "small muted")
    for i, taken in enumerate((0, 5, 10, 15, 20)):
        draw.dot(at(taken), rows["pose taken"])
        draw.text(at(taken) + 8, rows["pose taken"] - 6, "abcde"[i], "small it", "start")
        arrives = 2 * int(np.ceil((taken + 10) / 2))
        if arrives <= 20:
            draw.arrow((at(taken), rows["pose taken"] + 6), (at(arrives), rows["pose arrives"] - 7))
            draw.dot(at(arrives), rows["pose arrives"])
            draw.text(at(arrives), rows["its age"] + 5, f"{arrives - taken} ms", "small")
    return draw


def compiler_pipeline() -> Drawing:
    """Return the way of an equation to machine code."""
    rows = (
        ("Equations in Python", "CasADi symbols: model, laws, flight computer"),
        ("Programs", "scalar operations: lowered, folded, shared", "`compile/program.py`"),
        (
            "Routine",
            "the flight computer: programs that call others",
            "`compile/routine.py`",
        ),
        ("LLVM functions on vectors", "one flight in each lane", "`compile/llvm/emit.py`"),
        ("Kernel", "machine code, in the cache"),
    )
    draw = Drawing(456)
    middles = stack(draw, rows, 8, 8, 308)
    draw.box(358, middles[2] - 26, 116, 52, ("C99", "for hardware"))
    draw.arrow((316, middles[2]), (356, middles[2]))
    draw.box(358, middles[3] - 26, 116, 52, ("Loops in C++", "as bitcode"))
    draw.arrow((358, middles[3]), (319, middles[3]))
    draw.box(358, middles[4] - 26, 116, 52, ("WebAssembly", "for pages"))
    draw.arrow((316, middles[3] + 22), (337, middles[3] + 22), (337, middles[4]), (356, middles[4]))
    return draw


def plan_race() -> Drawing:
    """Return how guesses become a plan."""
    rows = (
        ("Guesses", "the rod is pumped up in several ways"),
        ("Linearise", "all stages, about the guess"),
        ("Riccati recursion", "limits as a barrier; gives commands and feedback"),
        ("Simulate", "the nonlinear equations, with the feedback"),
        ("Plan", "the best that keeps every constraint and hovers"),
    )
    draw = Drawing(388)
    middles = stack(draw, rows, 8, 8, 330)
    draw.arrow((338, middles[3]), (356, middles[3]), (356, middles[1]), (341, middles[1]))
    draw.text(411, middles[2] - 8, "again, until", "small")
    draw.text(411, middles[2] + 8, "it converges", "small")
    draw.arrow((338, middles[4]), (468, middles[4]), (468, middles[0]), (341, middles[0]))
    draw.text(400, middles[0] - 8, "none: more time", "small")
    return draw


def planning_phases() -> Drawing:
    """Return who flies when, while plans are made in flight."""
    draw = Drawing(196)
    for x, name, flies in (
        (6, "waiting", "the law flies"),
        (178, "planned", "the plan flies"),
        (350, "hovering", "the law flies"),
    ):
        draw.box(x, 30, 124, 52, (name, flies))
    draw.arrow((130, 56), (176, 56))
    draw.text(153, 20, "plan ready", "small")
    draw.arrow((302, 56), (348, 56))
    draw.text(325, 20, "in hover", "small")
    draw.arrow((240, 82), (240, 120), (88, 120), (88, 85))
    draw.text(164, 114, "lost", "small")
    draw.arrow((412, 82), (412, 158), (48, 158), (48, 85))
    draw.text(230, 176, "rod about to fall: plan again", "small")
    return draw


def plot(
    draw: Drawing, place: Sequence[float], x: Sequence[float], y: Sequence[float]
) -> Callable[..., list[tuple[float, float]]]:
    """Draw the frame of a plot; return the function from data, in the ranges `x` and `y`, to pixels."""
    left, top, width, height = place
    draw.path(((left, top), (left, top + height), (left + width, top + height)))

    def pixels(a: Iterable[float], b: Iterable[float]) -> list[tuple[float, float]]:
        across = left + width * (np.asarray(a) - x[0]) / (x[1] - x[0])
        up = top + height * (1 - (np.clip(np.asarray(b), *y) - y[0]) / (y[1] - y[0]))
        return list(zip(across, up, strict=True))

    return pixels


def lyapunov() -> Drawing:
    """Return V along flights of three laws, and the potentials of a direction."""
    draw = Drawing(560)
    draw.text(8, 18, "Lyapunov function V / V(0) along a flight", "strong", "start")
    place = (52, 34, 410, 220)
    at = plot(draw, place, (0, 10), (-8, 1))
    for decade in (0, -2, -4, -6, -8):
        draw.path(at((0, 10), (decade, decade)), "grid")
        draw.text(
            46,
            at((0,), (decade,))[0][1] + 4,
            f"1e{decade}" if decade else "1",
            "small muted",
            "end",
        )
    row, machine, hanging = experiment("1"), fp.vehicle("hehn2011"), fp.State(y=(0, 0, -1))
    flights = (
        ("corrected: rises first", "red", (row.vehicle, row.law("corrected"), row.start), (2.1, 0.62)),
        ("repaired (A)", "blue", (row.vehicle, fp.laws.repaired(), row.start), (5.3, -1.0)),
        ("almost global (B)", "green", (machine, fp.laws.almost_global(), hanging), (0.5, -6.2)),
    )
    for said, colour, flight, (t, decade) in flights:
        run = fp.simulate(*flight, 10, plant="ideal")
        V = run.signals["V"]
        shown = np.linspace(0, run.t[-1], 240)
        values = np.interp(shown, run.t, np.log10(np.maximum(V / V[0], 1e-30)))
        shown, values = shown[values > -8], values[values > -8]
        draw.path(at(shown, values), f"curve {colour}")
        x, y = at((t,), (decade,))[0]
        draw.text(x, y, said, f"small in-{colour} strong", "start")
    for t in range(0, 11, 2):
        draw.text(at((t,), (-8,))[0][0], 272, f"{t} s" if t == 10 else str(t), "small muted")

    draw.text(8, 316, "The price of pointing the wrong way", "strong", "start")
    at = plot(draw, (52, 334, 410, 190), (0, 180), (0, 4))
    angles = np.linspace(0, 179.9, 300)
    c, share = np.cos(np.radians(angles)), 0.25
    barrier = (1 - share) * (1 - c) - 2 * share * np.log((1 + c) / 2)
    draw.path(at((180, 180), (0, 4)), "grid dash")
    draw.path(at(angles, 1 - c), "curve red dash")
    draw.path(at(angles[barrier < 4], barrier[barrier < 4]), "curve blue")
    draw.text(*at((122,), (2.95,))[0], "with barrier", "small in-blue strong", "end")
    draw.text(*at((178,), (0.95,))[0], "the paper’s: flat, finite", "small in-red strong", "end")
    for degrees in (0, 45, 90, 135, 180):
        draw.text(at((degrees,), (0,))[0][0], 542, f"{degrees}°", "small muted")
    draw.text(60, 350, "Ψ", "it small", "start")
    draw.text(257, 557, "angle between direction and target", "small muted")
    return draw


def _swing_up(duration: float) -> tuple[fp.Vehicle, fp.Trajectory]:
    """Return the vehicle and its flight, which `python -m benchmarks.pages swing-up` draws as stop-motion."""
    vehicle = fp.vehicle("hehn2011").replace(mount="hub")
    return vehicle, fp.simulate(vehicle, fp.laws.inverted(), fp.State(y=(0, 0, -1)), duration)


def certified_set() -> Drawing:
    """Return how far the certified set of hehn2011 reaches, to scale."""
    vehicle = fp.vehicle("hehn2011")
    far = fp.laws.almost_global().bind(vehicle).certified_set().extent
    draw, scale = Drawing(400), 420.0  # pixels per metre
    pivot = np.array([150.0, 372.0])
    bob = pivot - (0, scale * vehicle.l)

    def fan(degrees: float, length: float, look: str) -> None:
        """Draw the directions within `degrees` of upright, from the pivot."""
        for sign in (-1, 1):
            angle = sign * math.radians(degrees)
            draw.path((pivot, pivot + length * np.array([math.sin(angle), -math.cos(angle)])), look)

    turn = np.linspace(0, 2 * np.pi, 73)
    draw.path(bob + scale * np.column_stack([far["bob"] * np.cos(turn), far["height"] * np.sin(turn)]), "curve red")
    fan(far["rod"], scale * vehicle.l, "edge red")
    fan(far["axis"], 120, "edge blue")
    reach = scale * np.linalg.norm(vehicle.rotor_positions[0][:2])
    (left, top), (middle, high) = pivot, bob
    draw.path(((left - reach, top), (left + reach, top)), "curve blue")
    for end in (left - reach, left + reach):
        draw.path(((end - 20, top - 6), (end + 20, top - 6)), "curve blue")
    draw.dot(*pivot, radius=5)
    draw.dot(*bob, "in-red", 6)
    draw.path((bob, (middle + scale * far["bob"], high)), "edge dash")
    draw.text(bob[0] + scale * far["bob"] + 6, bob[1] + 5, f"{100 * far['bob']:.0f} cm", "small", "start")
    draw.path((bob, (middle, high - scale * far["height"])), "edge dash")
    draw.text(bob[0], bob[1] - scale * far["height"] - 8, f"{100 * far['height']:.0f} cm", "small")
    draw.text(pivot[0] + 12, pivot[1] - 160, f"rod ±{far['rod']:.1f}°", "small in-red strong", "start")
    draw.text(pivot[0] + 12, pivot[1] - 80, f"axis ±{far['axis']:.1f}°", "small in-blue strong", "start")
    draw.text(262, 60, "One error, the others zero", "strong", "start")
    rows = (
        f"speed of the bob {far['speed']:.2g} m/s", f"rate of the rod {math.degrees(far['rod_rate']):.1f} °/s",
        f"rate of the axis {math.degrees(far['axis_rate']):.0f} °/s",
        f"yaw rate {math.degrees(far['yaw_rate']):.1f} °/s",
    )  # fmt: skip
    for i, row in enumerate(rows):
        draw.text(284, 88 + 22 * i, row, "small", "start")
    draw.path(((300, 340), (300 + 0.1 * scale, 340)), "curve")
    draw.path(((300, 340), (300 + 0.1 * scale, 340)), "edge")
    draw.text(300 + 0.05 * scale, 360, "10 cm", "small muted")
    return draw


def throw_phases() -> Drawing:
    """Return the phases of a swing-up over time: height of the bob, of the rod, of the thrust axis."""
    end = 2.6
    vehicle, run = _swing_up(end)
    y, z, bob = (
        run.y[:, 2],
        run.states.z[:, 2],
        run.x[:, 2] + vehicle.rod_length * run.y[:, 2],
    )
    turned = run.t[np.argmax(z < 0)], run.t[len(z) - 1 - np.argmax(z[::-1] < 0)]
    caught = run.t[len(y) - 1 - np.argmax(y[::-1] < np.cos(np.radians(15)))]
    # The dive is while the thrust points downwards; the catch ends when the rod stays within 15°.
    edges = (0.0, turned[0], turned[1], caught, end)
    names = ("climb, let go", "dive", "catch", "fly home")
    draw = Drawing(400)
    draw.text(8, 18, "A swing-up from hanging", "strong", "start")
    panels = (
        ("rod: y₃", y, (-1, 1), "red", ("hanging", "", "upright")),
        ("thrust axis: z₃", z, (-1, 1), "green", ("pushes down", "", "pushes up")),
        ("bob: height, m", bob, (-0.8, 1.4), "blue", None),
    )
    for i, (said, values, (low, high), colour, ends) in enumerate(panels):
        top = 54 + 110 * i
        for k in range(4):
            x0, x1 = (92 + 376 * edge / end for edge in edges[k : k + 2])
            if k % 2 == 0:
                draw.band(x0, top, x1 - x0, 86)
            if i == 0:
                draw.text((x0 + x1) / 2, 44, names[k], "small strong")
        at = plot(draw, (92, top, 376, 86), (0, end), (low, high))
        draw.path(at((0, end), (0, 0)), "grid")
        draw.path(at(run.t, values), f"curve {colour}")
        draw.text(100, top - 3 if i else top + 42, said, f"small in-{colour} strong", "start")
        if ends:
            draw.text(86, top + 8, ends[2], "small muted", "end")
            draw.text(86, top + 86, ends[0], "small muted", "end")
        else:
            draw.text(86, at((0,), (1,))[0][1] + 4, "1", "small muted", "end")
            draw.text(86, at((0,), (0,))[0][1] + 4, "0", "small muted", "end")
    for t in range(3):
        draw.text(at((t,), (0,))[0][0], 378, f"{t} s" if t == 2 else str(t), "small muted")
    return draw


# Of each phase: when, s; its name; what the two parts of the thrust do then.
THROW_FORCES = (
    (0.1, "1 Climb", "along: the bob", "is thrown up"),
    (0.74, "2 Let go", "across: pivot right,", "bob left"),
    (0.9, "3 Dive", "across: the rod", "swings up"),
    (1.18, "4 Catch", "along: stops the fall", "across: stops the swing"),
    (1.9, "5 Fly home", "along: the rod leans,", "the bob flies home"),
)


def throw_forces() -> Drawing:
    """Return the thrust in each phase of a swing-up, split into its parts along and across the rod."""
    vehicle, run = _swing_up(2.0)
    draw, cell, length, weight = Drawing(436), np.array([160, 218]), 74, 36  # pixels
    aside = run.x[np.argmax(np.linalg.norm(run.x[:, :2], axis=1))] * (1, 1, 0)  # the flight is in one vertical plane
    seen = np.array([aside / np.linalg.norm(aside), [0, 0, -1]])
    for place, (t, name, *said) in enumerate(THROW_FORCES):
        corner = cell * np.array([place % 3, place // 3])
        i = int(np.argmin(np.abs(run.t - t)))
        y, z = seen @ run.y[i], seen @ run.states.z[i]
        F = weight * run.thrust[i] / vehicle.weight * z
        along, side = (F @ y) * y, np.array([-z[1], z[0]])
        # Rod and thrust together are centred in the cell.
        shape = np.array([0 * y, length * y, F])
        pivot = corner + np.array([80, 101]) - (shape.min(axis=0) + shape.max(axis=0)) / 2
        bob = pivot + length * y
        draw.path((pivot, bob))
        draw.path((pivot - 24 * side, pivot + 24 * side), "edge")
        for end in (-24, 24):
            rotor = pivot + end * side + 4 * z
            draw.path((rotor - 10 * side, rotor + 10 * side), "edge")
        draw.path((pivot + along, pivot + F, pivot + F - along), "edge grid dash")
        draw.dot(*bob, "in-red", 7)
        draw.arrow(pivot, pivot + F)
        for part, look, back in ((along, "edge blue", 1), (F - along, "edge pink", -1)):
            size = np.linalg.norm(part)
            if size > 9:  # a shorter arrow is all head
                draw.arrow(pivot, pivot + part, look=look)
                way = back * part / size
                draw.arrow(bob + 8 * way, bob + (14 + size / 2) * way, look=look)
        draw.text(corner[0] + 80, corner[1] + 18, name, "strong")
        for line, words in enumerate(said):
            draw.text(corner[0] + 80, corner[1] + 192 + 16 * line, words, "small")
    for line, (look, words) in enumerate(
        (
            ("edge", "thrust"),
            ("edge blue", "along the rod:"),
            ("", "carries the bob"),
            ("edge pink", "across the rod:"),
            ("", "turns it, the bob"),
            ("", "goes the other way"),
        )
    ):
        top = 290 + 19 * line
        if look:
            draw.arrow((326, top - 4), (346, top - 4), look=look)
        draw.text(352, top, words, "small", "start")
    return draw


DIAGRAMS = {
    "free-body": free_body,
    "law-cascade": law_cascade,
    "theorem-cascade": theorem_cascade,
    "sensor-timing": sensor_timing,
    "compiler-pipeline": compiler_pipeline,
    "plan-race": plan_race,
    "planning-phases": planning_phases,
    "lyapunov": lyapunov,
    "certified-set": certified_set,
    "throw-phases": throw_phases,
    "throw-forces": throw_forces,
}

if __name__ == "__main__":
    for name in sys.argv[1:] or DIAGRAMS:
        (FOLDER / f"{name}.svg").write_text(DIAGRAMS[name]().svg(), encoding="utf-8")
