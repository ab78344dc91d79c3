"""Draw the clips of the documentation: `python -m benchmarks.clips [NAME …]` writes docs/img/NAME.svg, or all of them.

Six flights that fail, one for each cause, and one for each environment. A clip is a drawing that moves, seen from the
side, for both themes. NAME-still.svg has the same flight in five pictures, for those who want nothing to move.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from html import escape

import numpy as np
from numpy.typing import NDArray

import flypend as fp
from benchmarks.diagrams import FOLDER, WIDTH, Drawing
from flypend.flight.trajectory import Trajectory
from flypend.laws.references import circle
from flypend.paper import experiment

Array = NDArray[np.float64]
RATE, HOLD = 15, 18  # pictures a second, and how many of them rest at the end
HEIGHT, BAR = 300, 282  # of the picture, and where its time line is
CORNERS = 10  # of the outline of a disc
STILLS = 5
AZIMUTH, ELEVATION = np.radians(25.0), np.radians(14.0)
ACROSS = np.array([np.cos(AZIMUTH), np.sin(AZIMUTH), 0.0])
UP = np.array([-np.sin(AZIMUTH) * -np.sin(ELEVATION), np.cos(AZIMUTH) * -np.sin(ELEVATION), np.cos(ELEVATION)])
MORE = (
    ".rotor{fill:var(--panel);fill-opacity:.7;stroke:var(--ink);stroke-width:1.2}.arm{stroke:var(--ink);stroke-width:3}"
    ".rod{stroke:var(--red);stroke-width:3}.bob{fill:var(--red)}.trail{fill:none;stroke:var(--blue);stroke-width:1.2}"
)


@dataclass(frozen=True)
class Clip:
    """A flight and how it is shown: its title, `speed` over real time, `scale` in pixels per metre.

    With `follow` the picture goes with the vehicle, and a grid of 1 m shows how fast; else it shows `centre` (3,), m.
    """

    title: str
    fly: Callable[[], Trajectory]
    end: str
    speed: float = 1.0
    scale: float = 90.0
    follow: bool = False
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    colour: str = "red"  # of what is said of the end


def frames(run: Trajectory, speed: float) -> tuple[Array, Array, Array, Array]:
    """Return times, pivots (n, 3), attitudes (n, 3, 3) and rods (n, 3) of the pictures of `run`, gravity down."""
    times = np.arange(0.0, run.t[-1] + 1e-9, speed / RATE)
    times = np.append(times, run.t[-1])
    nearest = np.searchsorted(run.t, times).clip(0, len(run.t) - 1)
    states = run.states[nearest]
    if run.e3 == "down":
        states = states.flipped()
    return times, states.x, states.R, states.y


def outlines(vehicle: fp.Vehicle, x: Array, R: Array, y: Array) -> tuple[list[Array], list[Array], Array]:
    """Return arms (n, 2, 3) and discs (n, CORNERS, 3) of the rotors, and bobs (n, 3), in the world, m."""
    turn = np.linspace(0, 2 * np.pi, CORNERS, endpoint=False)
    radius = vehicle.body.disc_radius if vehicle.body else 0.06
    ring = radius * np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    arms, discs = [], []
    for at in np.asarray(vehicle.rotor_positions):
        arms.append(x[:, None] + np.einsum("nij,kj->nki", R, np.stack([0 * at, at])))
        discs.append(x[:, None] + np.einsum("nij,kj->nki", R, at + ring))
    return arms, discs, x + vehicle.rod_length * y


def moving(tag: str, look: str, values: dict[str, list[str]], seconds: float) -> str:
    """Return an element whose attributes run through `values` in `seconds`, again and again."""
    first = "".join(f' {name}="{shown[0]}"' for name, shown in values.items())
    runs = "".join(
        f'<animate attributeName="{name}" dur="{seconds:.2f}s" repeatCount="indefinite" values="{";".join(shown)}"/>'
        for name, shown in values.items()
    )
    return f'<{tag} class="{look}"{first}>{runs}</{tag}>'


def draw(clip: Clip) -> tuple[str, str]:
    """Return the files of `clip`: the moving one, and the still one."""
    run = clip.fly()
    times, x, R, y = frames(run, clip.speed)
    seconds, rest = (len(times) + HOLD) / RATE, [-1] * HOLD
    pictures = [*range(len(times)), *rest]
    eye = x if clip.follow else np.broadcast_to(np.asarray(clip.centre, dtype=float), x.shape)

    def flat(points: Array, seen_from: Array) -> Array:
        away = points - seen_from[:, None]
        return np.stack([WIDTH / 2 + clip.scale * away @ ACROSS, HEIGHT / 2 - 8 - clip.scale * away @ UP], axis=-1)

    def words(points: Array) -> list[str]:
        return [" ".join(f"{a:.0f},{b:.0f}" for a, b in row) for row in points]

    arms, discs, bobs = outlines(run.vehicle, x, R, y)
    shapes = [("polyline", "arm", flat(arm, eye)) for arm in arms]
    shapes += [("polygon", "rotor", flat(disc, eye)) for disc in discs]
    shapes.append(("polyline", "rod", flat(np.stack([x, bobs], axis=1), eye)))
    ends = flat(bobs[:, None], eye)[:, 0]

    ground = ""
    if not clip.follow:
        spot = flat(np.zeros((1, 1, 3)), eye[:1])[0, 0]
        ground = f'<circle cx="{spot[0]:.0f}" cy="{spot[1]:.0f}" r="7" class="edge"/>'
        ground += f'<polyline class="trail" points="{words(flat(bobs[None], eye[:1]))[0]}"/>'
    live = grid(clip, x, pictures, seconds) if clip.follow else ground
    for tag, look, points in shapes:
        row = words(points)
        live += moving(tag, look, {"points": [row[i] for i in pictures]}, seconds)
    across, down = ([f"{ends[i, axis]:.0f}" for i in pictures] for axis in (0, 1))
    live += moving("circle", "bob", {"cx": across, "cy": down, "r": ["6"]}, seconds)
    line = [f"{464 * times[i] / times[-1]:.0f}" for i in pictures]
    live += moving("rect", "in-blue", {"width": line, "x": ["8"], "y": [f"{BAR}"], "height": ["4"]}, seconds)
    return finished(clip, times[-1], live), finished(clip, times[-1], ground + stills(clip, shapes, ends))


def grid(clip: Clip, x: Array, pictures: list[int], seconds: float) -> str:
    """Return lines a metre apart that pass by as the vehicle moves."""
    moved = clip.scale * np.stack([-(x - x[0]) @ ACROSS, (x - x[0]) @ UP], axis=1)
    low, high = (-moved).min(axis=0), (-moved).max(axis=0) + np.array([WIDTH, HEIGHT])
    lines = [
        f"M{a:.0f} {low[1]:.0f}V{high[1]:.0f}"
        for a in np.arange(low[0] // clip.scale, high[0] / clip.scale) * clip.scale
    ]
    lines += [
        f"M{low[0]:.0f} {b:.0f}H{high[0]:.0f}"
        for b in np.arange(low[1] // clip.scale, high[1] / clip.scale) * clip.scale
    ]
    values = ";".join(f"{moved[i, 0]:.0f} {moved[i, 1]:.0f}" for i in pictures)
    return (
        f'<g><path d="{"".join(lines)}" class="grid"/><animateTransform attributeName="transform" '
        f'type="translate" dur="{seconds:.2f}s" repeatCount="indefinite" values="{values}"/></g>'
    )


def stills(clip: Clip, shapes: list[tuple[str, str, Array]], ends: Array) -> str:
    """Return some pictures of the flight over each other, or side by side if the clip follows."""
    out = []
    for j, i in enumerate(np.linspace(0, len(ends) - 1, STILLS).astype(int)):
        shift = np.array([(j - STILLS // 2) * 90, 0]) if clip.follow else np.zeros(2)
        size = 0.5 if clip.follow else 1.0
        place = f"translate({WIDTH / 2 * (1 - size) + shift[0]:.0f} {HEIGHT / 2 * (1 - size):.0f}) scale({size})"
        drawn = "".join(
            f'<{tag} class="{look}" points="{" ".join(f"{a:.0f},{b:.0f}" for a, b in points[i])}"/>'
            for tag, look, points in shapes
        )
        drawn += f'<circle class="bob" cx="{ends[i, 0]:.0f}" cy="{ends[i, 1]:.0f}" r="6"/>'
        out.append(f'<g transform="{place}" opacity="{0.25 + 0.75 * j / (STILLS - 1):.2f}">{drawn}</g>')
    return "".join(out)


def finished(clip: Clip, end: float, body: str) -> str:
    """Return the file: the picture between its title and its time line."""
    sheet = Drawing(HEIGHT)
    sheet.parts.append(f"<style>{MORE}</style>{body}")
    sheet.text(8, 20, clip.title, "strong", "start")
    pace = "" if clip.speed == 1 else f", at {clip.speed:g} of its speed"
    sheet.text(8, 274, clip.end, f"small in-{clip.colour} strong", "start")
    sheet.text(472, 274, f"{end:.2g} s{pace}", "small muted", "end")
    sheet.path(((8, BAR + 2), (472, BAR + 2)), "grid")
    return sheet.svg().replace("<svg ", f'<svg role="img" aria-label="{escape(clip.title)}: {escape(clip.end)}" ', 1)


def machine(**changes: object) -> fp.Vehicle:
    """Return hehn2011 with `changes`."""
    return fp.vehicle("hehn2011").replace(**changes)


def leaning(degrees: float) -> fp.State:
    """Return a start at rest with the rod `degrees` from upright."""
    angle = np.radians(degrees)
    return fp.State(y=(np.sin(angle), 0.0, np.cos(angle)))


def singular() -> Trajectory:
    """Return the paper's third experiment under the law as printed."""
    row = experiment("3")
    return fp.simulate(row.vehicle, row.law("printed"), row.start, row.duration, plant=row.plant)


def diverging() -> Trajectory:
    """Return a flight that runs away: the paper's law, corrected."""
    start = fp.random_starts(2000, 2024).flipped()[1990]
    return fp.simulate(
        fp.vehicle("nayak2018"), fp.laws.corrected(), start, 3, plant="ideal", times=np.arange(0, 3, 0.005)
    )


def colliding() -> Trajectory:
    """Return a flight whose rod touches an arm of a hub."""
    return fp.simulate(
        machine(mount="hub"), fp.laws.inverted(), fp.random_starts(60, 3)[7], 4, times=np.arange(0, 4, 0.002)
    )


def balancing(degrees: float) -> Callable[[], Trajectory]:
    """Return a flight of 4 s under the inverted law, from a lean."""
    return lambda: fp.simulate(machine(), fp.laws.inverted(), leaning(degrees), 4)


def circling() -> Trajectory:
    """Return a flight whose joint rubs: the rod stands, the vehicle under it circles."""
    rubbing = fp.Plant(pivot_friction=0.01)
    return fp.simulate(machine(**fp.uniform_rod(0.05, 1.13)), fp.laws.inverted(), leaning(16), 6, plant=rubbing)


CLIPS = {
    "cause-rod": Clip(
        "rod: LQR, from level", lambda: fp.simulate(machine(), fp.laws.lqr(), leaning(90), 3),
        "the rod passes upright, and tumbles on",
        follow=True,
    ),
    "cause-axis": Clip(
        "axis: dry friction in the joint", circling, "the rod stands, the vehicle keeps rocking",
        scale=130.0, centre=(0.1, 0.0, 0.2),
    ),
    "cause-position": Clip(
        "position: LQR, from a lean of 30°", lambda: fp.simulate(machine(), fp.laws.lqr(), leaning(30), 4),
        "the rod stands, metres from its place (ring)", scale=65.0, centre=(1.3, 0.0, 0.2),
    ),
    "cause-diverged": Clip(
        "diverged: the paper’s law, corrected", diverging, "the rod turns faster and faster", follow=True, speed=0.5,
    ),
    "cause-singular": Clip(
        "singular: the paper’s law, as printed", singular, "a term of the law divides by zero", follow=True, speed=0.4,
    ),
    "cause-collided": Clip(
        "collided: a hub", colliding, "the rod touches an arm", follow=True, speed=0.08, scale=150.0,
    ),
    "env-balance": Clip(
        "flypend/Balance-v0", balancing(11), "up, and at its place",
        scale=130.0, colour="green", centre=(0.1, 0.0, 0.2),
    ),
    "env-swing-up": Clip(
        "flypend/SwingUp-v0", balancing(180), "from hanging to upright",
        scale=80.0, colour="green", centre=(0.0, 0.0, 0.3),
    ),
    "env-track": Clip(
        "flypend/Track-v0",
        lambda: fp.simulate(machine(), fp.laws.inverted(circle(radius=0.5, rate=1.5)), leaning(0), 8.4),
        "along a circle of 0.5 m", scale=130.0, colour="green", centre=(0.0, 0.0, 0.25),
    ),
    "env-catch-in-cup": Clip(
        "flypend/CatchInCup-v0",
        lambda: fp.simulate(machine(mount="cup"), fp.laws.inverted(), leaning(25), 4), "caught before it topples",
        scale=110.0, colour="green", centre=(0.2, 0.0, 0.2),
    ),
}  # fmt: skip


if __name__ == "__main__":
    for name in sys.argv[1:] or CLIPS:
        for ending, file in zip(("", "-still"), draw(CLIPS[name]), strict=True):
            (FOLDER / f"{name}{ending}.svg").write_text(file, encoding="utf-8")
