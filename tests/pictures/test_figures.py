"""Figures: the drawing has the geometry of the machine, gravity points down, and what is written can be read."""

import dataclasses
import itertools
import re
import subprocess
import sys
from pathlib import Path

import matplotlib.colors
import matplotlib.text
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.patches import Circle

import flypend as fp
from flypend import geometry, palette
from flypend.laws.references import circle
from flypend.model import gravity_vector
from flypend.pages import sketch
from flypend.palette import RED
from flypend.paper import experiment
from flypend.pictures import drawing, figures
from flypend.pictures.frames import stage
from flypend.pictures.style import STYLES, new_figure, style_named, title
from tests.few import each_once, few

ARRAYS = ("t", "x", "x_dot", "R", "omega", "y", "y_dot", "thrust", "moment", "rotor_forces", "x_ref")


def fly(name, law="corrected", duration=6.5, **options):
    case = experiment(name)
    return fp.simulate(case.vehicle, case.law(law, **options), case.start, duration, plant="ideal")


@pytest.fixture(scope="module")
def run():
    return fly("4")


@pytest.fixture(scope="module")
def singular():
    return fly("2", "printed")


def at_the_start(run):
    """A run that ended with its first sample."""
    first = {name: getattr(run, name)[:1] for name in ARRAYS}
    signals = {name: values[:1] for name, values in run.signals.items()}
    outcome = fp.Outcome("singular", 0.0, "0/0")
    return dataclasses.replace(run, **first, signals=signals, outcome=outcome, interpolant=None)


# The drawing ----------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def states():
    return fp.State.random(np.random.default_rng(1), 40)


@pytest.mark.parametrize("name", ["nayak2018", "hehn2011"])
def test_the_drawing_is_the_machine(states, name):
    vehicle = fp.vehicle(name)
    thrust = np.linspace(-2, 2, 40) * vehicle.weight
    forces = np.linspace(-1, 1, 160).reshape(40, 4) * vehicle.weight
    shape = sketch.sketch(states, vehicle, thrust, forces)
    seen = geometry.apply(np.swapaxes(states.R, -1, -2)[:, None, None], shape.discs - states.x[:, None, None])
    np.testing.assert_allclose(seen[..., 2], 0, atol=1e-12)  # the rotors turn in the plane of the body
    np.testing.assert_allclose(seen[..., :-1, :].mean(axis=2), np.tile(vehicle.rotor_positions, (40, 1, 1)), atol=1e-12)
    radii = geometry.norm(shape.discs - shape.arms[..., 1, None, :])
    np.testing.assert_allclose(radii, sketch.disc_radius(vehicle))
    gaps = geometry.norm(vehicle.rotor_positions[:, None] - vehicle.rotor_positions)
    assert 2 * sketch.disc_radius(vehicle) < gaps[gaps > 0].min()  # and do not touch
    np.testing.assert_allclose(shape.rod[:, 1] - shape.rod[:, 0], vehicle.rod_length * states.y, atol=1e-12)
    arrow = shape.thrust[:, 1] - shape.thrust[:, 0]
    share = np.clip(0.7 * thrust / vehicle.weight, -1.1, 1.1)
    np.testing.assert_allclose(arrow, (share * vehicle.rod_length)[:, None] * states.z, atol=1e-12)
    np.testing.assert_allclose(shape.rotor_thrusts[..., 0, :], shape.arms[..., 1, :])
    arrows = shape.rotor_thrusts[..., 1, :] - shape.rotor_thrusts[..., 0, :]
    share = 0.32 / 0.7 * np.clip(0.7 * 4 * forces / vehicle.weight, -1.1, 1.1)
    np.testing.assert_allclose(arrows, (share * vehicle.rod_length)[..., None] * states.z[:, None], atol=1e-12)
    everything = [shape.bob[:, None], shape.discs.reshape(40, -1, 3), shape.thrust, shape.rotor_thrusts[..., 1, :]]
    assert geometry.norm(np.concatenate(everything, axis=1) - states.x[:, None]).max() <= sketch.reach(vehicle) + 1e-12


def test_the_front_is_where_the_body_axis_points():
    assert sketch.sketch(fp.State(y=(0, 0, 1)), fp.vehicle("nayak2018")).front.tolist() == [True, False, False, False]
    vehicle = fp.vehicle("nayak2018")
    turned = np.array([[1, -1, 0], [1, 1, 0], [-1, 1, 0], [-1, -1, 0]]) * 0.2
    crossed = vehicle.replace(rotor_positions=turned)
    assert sketch.sketch(fp.State(y=(0, 0, 1)), crossed).front.tolist() == [True, True, False, False]


@pytest.mark.parametrize("frame", ["as flown, e₃ down", "turned, e₃ up"])
def test_gravity_points_down_the_screen(run, frame):
    shown = run if frame.endswith("down") else run.flipped()
    assert shown.e3 == ("down" if frame.endswith("down") else "up")
    gravity = gravity_vector(shown.vehicle, shown.e3)
    below = geometry.dot(shown.y, gravity) / shown.vehicle.gravity * shown.vehicle.rod_length  # bob under pivot, m
    assert below.min() < -0.49
    assert below.max() > 0.49
    shape = sketch.sketch(drawing.states_at(shown, shown.t), shown.vehicle)
    level = drawing.camera_for(shown, "side", elevation=0.0)
    np.testing.assert_allclose(drawing.project(level, shape.bob - shape.pivot)[:, 1], -below, atol=1e-9)
    camera = drawing.camera_for(shown, "side")
    down = drawing.project(camera, [0.0, 0.0, -1.0])
    assert down[0] == pytest.approx(0, abs=1e-12)
    assert down[1] < -0.9


@pytest.mark.parametrize("view", drawing.VIEWS)
def test_both_frames_give_the_same_picture(run, view):
    pictures = []
    for shown in (run, run.flipped()):
        camera = drawing.camera_for(shown, view, distance=4.0)
        shape = drawing.sketch_at(shown, run.t, drawing.states_at(shown, run.t))
        parts = (shape.discs, shape.arms, shape.rod, shape.thrust, shape.rotor_thrusts)
        pictures.append([drawing.project(camera, part.reshape(len(run.t), -1, 3)) for part in parts])
    for one, other in zip(*pictures, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-9)


def test_the_thrust_does_not_hide_the_rod():
    """In hover they lie along one line. The colour along the rod is the rod's, in movie and stop motion."""
    vehicle, rod = fp.vehicle("hehn2011"), np.array(to_rgb(RED))
    still = fp.simulate(vehicle, fp.laws.lqr(), fp.State(y=(0, 0, 1.0)), 0.2, plant="ideal")
    frame = np.array(stage(still, np.linspace(0, 0.2, 3), "side", 1.0, (640, 640))(1, False))[:480, :, :3] / 255
    figure = Figure(figsize=(4, 4), dpi=150)
    ax = figure.add_axes((0, 0, 1, 1), xlim=(-0.75, 0.75), ylim=(-0.75, 0.75))
    drawing.draw(ax, still, drawing.camera_for(still, "side", distance=4.0), (0.0, 0.0), 0.1, since=0.0)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    picture = np.array(canvas.buffer_rgba())[..., :3] / 255
    for pixels in (frame, picture):
        red = np.all(np.abs(pixels - rod) < 0.02, axis=-1)
        rows = np.flatnonzero(red.any(axis=1))  # from bob to pivot, which the vehicle may cover
        assert len(rows) > 0.95 * (rows[-1] - rows[0])
        assert rows[-1] - rows[0] > 0.2 * len(pixels)


@pytest.mark.parametrize("view", drawing.VIEWS)
def test_cameras_do_not_mirror(run, view):
    camera = drawing.camera_for(run, view)
    axes = np.stack([camera.right, camera.up, -np.asarray(camera.direction)])
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(axes) == pytest.approx(1)


def test_the_axis_camera_sits_on_minus_e3_of_the_paper_and_looks_along_gravity(run):
    camera = drawing.camera_for(run, "axis", distance=4.0)
    to_paper = np.diag([1.0, -1.0, -1.0])
    eye = to_paper @ (-4.0 * np.asarray(camera.direction))
    np.testing.assert_allclose(eye, [0, 0, -4.0])
    assert run.e3 == "down"
    np.testing.assert_allclose(to_paper @ camera.direction, gravity_vector(run.vehicle, "down") / run.vehicle.gravity)
    # y → e₃ shrinks to the middle; a rod towards the camera is drawn larger.
    hanging, inverted, across = (0, 0, -0.5), (0, 0, 0.5), (0.5, 0, 0)
    np.testing.assert_allclose(drawing.project(camera, [hanging, inverted]), 0, atol=1e-12)
    assert drawing.magnification(camera, hanging) == pytest.approx(4 / 4.5)
    assert drawing.magnification(camera, inverted) == pytest.approx(4 / 3.5)
    np.testing.assert_allclose(drawing.project(camera, across), [0.5, 0])


def test_the_side_camera_looks_across_the_motion_and_travel_goes_to_the_right(run):
    camera = drawing.camera_for(run, "side")
    states = run.flipped().states
    assert np.std(states.y @ camera.right) > 5 * np.std(states.y[:, :2] @ np.asarray(camera.direction)[:2])
    assert (states.x[-1] - states.x[0]) @ camera.right > 0
    still = dataclasses.replace(run, y=np.tile([0.0, 0, 1], (len(run.t), 1)), y_dot=np.zeros((len(run.t), 3)))
    travel = (states.x[-1] - states.x[0])[:2]  # a rod that stays vertical leaves the travel of the vehicle
    assert sketch.main_direction(still.states.in_frame(still.e3))[:2] @ travel > 0.99 * np.linalg.norm(travel)


def test_states_between_the_samples_of_a_loaded_run(run):
    kept = dataclasses.replace(run, interpolant=None)
    np.testing.assert_allclose(
        drawing.states_at(kept, run.t).packed(), drawing.states_at(run, run.t).packed(), atol=1e-9
    )
    between = (run.t[1:] + run.t[:-1]) / 2
    exact, guess = drawing.states_at(run, between), drawing.states_at(kept, between)
    # Linear between samples h apart: h²/8 times the acceleration, here |ÿ| < 40 /s² (h = 0.01 s).
    assert geometry.norm(exact.y - guess.y).max() < 0.01**2 / 8 * 40
    np.testing.assert_allclose(drawing.states_at(kept, [-1.0, 99.0]).x, drawing.states_at(kept, run.t[[0, -1]]).x)


def test_nothing_is_made_up_between_samples_too_far_apart(run):
    ends = {name: getattr(run, name)[[0, 1]].copy() for name in ARRAYS}
    ends |= {
        "y": np.array([[0.0, 0, 1], [np.sqrt(0.75), 0, -0.5]]),
        "y_dot": np.zeros((2, 3)),
        "t": np.array([0.0, 1.0]),
    }
    jump = dataclasses.replace(run.flipped(), **ends, signals={})
    np.testing.assert_allclose(drawing.states_at(jump, [0.4, 0.6]).y, ends["y"])


def test_the_thrust_that_carries_points_up_in_both_frames(run):
    late = run.t[-50:]
    for shown in (run, run.flipped()):
        states = drawing.states_at(shown, late)
        shape = drawing.sketch_at(shown, late, states)
        for arrows in (shape.thrust, shape.rotor_thrusts):
            assert (arrows[..., 1, 2] - arrows[..., 0, 2]).min() > 0
        assert (states.z[:, 2] > 0.99).all()


def test_arrows_are_those_of_the_forces_of_the_run(run):
    up = run.flipped()
    some = slice(None, None, 20)
    states = drawing.states_at(up, up.t[some])
    shape = drawing.sketch_at(up, up.t[some], states)
    at_pivot = dataclasses.replace(states, x=0 * states.x)
    expected = sketch.sketch(at_pivot, up.vehicle, up.thrust[some], up.rotor_forces[some])
    np.testing.assert_allclose(shape.thrust, expected.thrust, atol=1e-12)
    np.testing.assert_allclose(shape.rotor_thrusts, expected.rotor_thrusts, atol=1e-12)
    assert np.ptp(up.rotor_forces) > 1  # N; they differ between rotors and in time


# The figures ----------------------------------------------------------------------------------------------------


def curves(ax):
    return {line.get_label(): line.get_ydata() for line in ax.get_lines() if not line.get_label().startswith("_")}


def words(figure):
    return [text.get_text() for text in figure.findobj(matplotlib.text.Text) if text.get_text()]


@pytest.mark.parametrize("turn", [False, True])
def test_the_paper_figure_shows_y3_and_z3_in_the_frame_of_the_run(run, turn):
    shown = run.flipped() if turn else run
    upper, lower = figures.paper_figure(shown).axes
    np.testing.assert_array_equal(upper.get_lines()[-1].get_ydata(), shown.y[:, 2])
    np.testing.assert_array_equal(lower.get_lines()[-1].get_ydata(), shown.z[:, 2])
    assert upper.get_lines()[-1].get_ydata()[-1] == pytest.approx(-1 if turn else 1, abs=0.01)
    poses = {text.get_text(): text.get_position()[1] for ax in (upper, lower) for text in ax.texts}
    assert poses["hanging"] == (-1 if turn else 1)  # it ends hanging in either frame, and upright
    assert poses["upright"] == 1
    assert "(s)" in lower.get_xlabel()


def test_a_run_that_did_not_complete_is_marked(singular):
    end = singular.outcome.time
    for figure in (figures.paper_figure(singular), figures.full_figure(singular)):
        figure.canvas.draw()
        (text,) = (text for text in figure.axes[0].texts if text.get_text() == f"singular\nat {end:.3f} s")
        assert text.get_window_extent().x1 < figure.axes[0].bbox.x1
        for ax in figure.axes:
            assert any(np.array_equal(line.get_xdata(), [end, end]) for line in ax.get_lines())
            assert ax.get_xlim()[1] > end
    assert not any("singular" in text for text in words(figures.paper_figure(fly("2", duration=0.3))))


def test_the_full_figure_shows_everything_with_units(run):
    y, z, x, away, f, rotors, tau, v = figures.full_figure(run).axes
    for ax, name, values in ((y, "y", run.y), (z, "z", run.z), (x, "x", run.x), (tau, r"\tau", run.moment)):
        for i in range(3):
            np.testing.assert_array_equal(curves(ax)[f"${name}_{i + 1}$"], values[:, i])
    np.testing.assert_array_equal(curves(f)["$f$"], run.thrust)
    np.testing.assert_allclose(curves(f)["hover"], -run.vehicle.weight)
    total, one, two = (curves(v)[name] for name in ("$V = V_1 + V_2$", "$V_1$", "$V_2$"))
    np.testing.assert_allclose(total, one + two, rtol=1e-9)
    (distance,) = (line for line in away.get_lines() if not line.get_label().startswith("_"))
    np.testing.assert_allclose(distance.get_ydata(), geometry.norm(run.x - run.x_ref))
    units = [ax.get_ylabel().split("(")[1] for ax in (y, z, x, away, f, rotors, tau, v)]
    assert units == ["–)", "–)", "m)", "m)", "N)", "N)", "N m)", "1/s²)"]


def panel(figure, words):
    (found,) = (ax for ax in figure.axes if words in ax.get_ylabel())
    return found


@pytest.mark.parametrize("style", list(STYLES))
def test_rotor_forces_are_shown_with_the_limits_of_the_rotors(run, style):
    """The ideal plant gives what no rotor can: the curves enter what is shaded."""
    least, most = run.vehicle.rotor_limits
    assert run.rotor_forces.min() < least
    ax = panel(figures.full_figure(run, style=style), "rotor forces")
    shown = curves(ax)
    for k, force in enumerate(run.rotor_forces.T):
        np.testing.assert_array_equal(shown[f"$f_{k + 1}$"], force)
    levels = {line.get_ydata()[0] for line in ax.get_lines() if len(set(line.get_ydata())) == 1}
    assert {least, most} <= levels
    below = [patch for patch in ax.patches if patch.get_extents().y1 <= ax.transData.transform((0, least))[1] + 1]
    assert below
    assert ax.get_ylim()[0] < least


def test_the_reference_is_drawn_beside_the_position():
    around = fp.laws.inverted(reference=circle(0.5, 0.3))
    flown = fp.simulate(fp.vehicle("hehn2011"), around, fp.State(x=(0.3, 0, 0), y=(0, 0, 1)), 1.0)
    ax = panel(figures.full_figure(flown), "position")
    drawn = [line.get_ydata() for line in ax.get_lines() if "reference" in line.get_label()]
    np.testing.assert_array_equal(np.transpose(drawn), flown.x_ref)


def test_widths_are_those_of_ieee_columns(run):
    """88.9 mm and 182 mm."""
    assert 25.4 * figures.paper_figure(run).get_size_inches()[0] == pytest.approx(88.9)
    for figure in (figures.full_figure(run), figures.stop_motion(run)):
        assert 25.4 * figure.get_size_inches()[0] == pytest.approx(181.9, abs=0.1)


FONT = "STIXGeneral"  # comes with matplotlib


@pytest.mark.parametrize("figure", [figures.paper_figure, figures.full_figure, figures.stop_motion])
def test_a_font_is_that_of_all_text_and_titles_can_be_left_out(run, figure):
    usual, plain = figure(run), figure(run, style=style_named("paper", font=FONT, titled=False))
    for drawn in (usual, plain):
        drawn.canvas.draw()
    families = {text.get_fontfamily()[0] for text in plain.findobj(matplotlib.text.Text) if text.get_text()}
    assert families == {FONT}
    assert any("corrected law" in word for word in words(usual))
    assert not any("corrected law" in word for word in words(plain))


@pytest.mark.parametrize("suffix", [".pdf", ".svg"])
def test_fonts_are_in_the_file(run, tmp_path, suffix):
    """As TrueType in a PDF, which publishers demand; as outlines in an SVG, which then needs none."""
    path = tmp_path / f"a{suffix}"
    figures.save_figure(figures.paper_figure(run, style=style_named("paper", font=FONT)), path)
    content = path.read_bytes()
    if suffix == ".pdf":
        assert content.count(b"/FontFile2") >= 1
        assert b"/Type3" not in content
        assert FONT.encode() in content
    else:
        assert b"<text" not in content
        assert b"font-family" not in content


def test_a_font_that_is_not_there_is_refused():
    with pytest.raises(
        fp.InputError, match=r"--font: expected a font family that is installed, got 'STIXGenerl'.*STIXG"
    ):
        style_named("paper", font="STIXGenerl")


def test_a_law_without_lyapunov_functions_shows_the_rate_of_the_rod(run):
    last = figures.full_figure(dataclasses.replace(run, signals={})).axes[-1]
    np.testing.assert_array_equal(curves(last)[r"$\dot{y}_3$"], run.y_dot[:, 2])


def test_a_whirling_rod_is_drawn_finer_than_its_samples():
    whirl = fly("2", "printed", duration=5.0, beta="off")
    line = figures.paper_figure(whirl).axes[0].get_lines()[-1]
    t, y3 = line.get_data()
    rates = np.interp(t, whirl.t, geometry.norm(whirl.y_dot))
    assert np.max(rates[1:] * np.diff(t)) < 0.3  # rad between points; between samples it is more than 1
    assert np.max(geometry.norm(whirl.y_dot)[1:] * np.diff(whirl.t)) > 1
    assert np.abs(np.diff(y3)).max() < 0.3


def stamps(figure):
    return [text for text in words(figure) if text.endswith(" s")]


@pytest.mark.parametrize("count", [1, 2, 7, 12, 30])
@pytest.mark.parametrize("view", drawing.VIEWS)
def test_stop_motion_has_as_many_pictures_as_asked_for(run, count, view):
    figure = figures.stop_motion(run, count, view=view)
    times = [float(stamp.removesuffix(" s")) for stamp in stamps(figure)]
    assert len(times) == count
    assert sorted(set(times)) == times
    assert times[-1] == 6.5
    assert count == 1 or times[0] == 0
    bobs = [patch for patch in figure.axes[1].patches if isinstance(patch, Circle) and patch.get_facecolor()[2] == 0]
    assert len(bobs) == count


def test_pictures_are_denser_where_the_rod_moves(run):
    times = figures.snapshot_times(run, 12)
    assert np.sum(times < 2) >= 7  # nearly all motion of the rod is in the first third of the 6.5 s
    y = drawing.states_at(run, times).y
    assert np.degrees(np.arccos(np.clip(geometry.dot(y[1:], y[:-1]), -1, 1))).max() < 60


def test_stop_motion_is_the_same_in_both_frames_with_the_bob_under_the_pivot_at_the_end(run):
    centres = []
    for shown in (run, run.flipped()):
        pictures = figures.stop_motion(dataclasses.replace(shown, interpolant=None), 4).axes[1]
        centres.append([patch.center for patch in pictures.patches if isinstance(patch, Circle)])
        rod = pictures.get_lines()[-4 - 1].get_xydata()  # the key is four lines
        assert rod[1, 1] < rod[0, 1] - 0.4
        assert rod[1, 0] == pytest.approx(rod[0, 0], abs=0.05)
    np.testing.assert_allclose(*centres, atol=1e-9)


def test_rods_on_a_long_path_are_enlarged_to_be_seen():
    start = fp.State(x=(100, 0, 0), y=(0, 0, 1))
    flown = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), start, 20.0)
    ax = figures.stop_motion(flown, 6).axes[0]
    path = np.concatenate([line.get_xydata() for line in ax.get_lines()[:2]])
    rods = np.array(ax.collections[0].get_segments())
    length = np.max(np.linalg.norm(rods[:, 1] - rods[:, 0], axis=-1))
    assert 0.025 < length / np.ptp(path, axis=0).max() < 0.07  # factors are up to 2.5 apart


def test_stop_motion_of_a_run_that_ended_early(singular):
    assert "singular" in words(figures.stop_motion(singular))
    assert len(stamps(figures.stop_motion(at_the_start(singular)))) == 1


@pytest.mark.parametrize("view", drawing.VIEWS)
def test_the_symbol_of_gravity(run, view):
    ax = new_figure(3, 3).subplots()
    drawing.gravity_symbol(ax, view, (0.0, 0.0), 1.0, fontsize=8)
    assert [text.get_text() for text in ax.texts if text.get_text()] == ["g"]
    arrows = [text for text in ax.texts if not text.get_text()]
    if view == "side":
        assert arrows[0].xy[1] < arrows[0].xyann[1]  # from above to below
    else:
        assert not arrows
        assert len(ax.patches) == 1
        assert len(ax.get_lines()) == 2


def overlaps(figure, monkeypatch):
    """Pairs of drawn texts that overlap, and texts that leave the figure."""
    drawn = {}
    draw = matplotlib.text.Text.draw

    def record(self, renderer, *rest, **more):
        if self.get_text().strip() and self.get_visible():
            drawn[id(self)] = (self.get_text(), matplotlib.text.Text.get_window_extent(self, renderer))  # no arrow
        return draw(self, renderer, *rest, **more)

    with monkeypatch.context() as patch:
        patch.setattr(matplotlib.text.Text, "draw", record)
        figure.canvas.draw()
    assert len(drawn) > 10
    width, height = figure.bbox.size
    out = [name for name, box in drawn.values() if box.x0 < 0 or box.y0 < 0 or box.x1 > width or box.y1 > height]
    pairs = itertools.combinations(drawn.values(), 2)
    # Boxes hold the space for ascenders and descenders: a pixel and a half of it may be shared.
    out += [(a, b) for (a, one), (b, two) in pairs if one.padded(-1.5).overlaps(two.padded(-1.5))]
    return out


DRAWN = {
    "paper": figures.paper_figure,
    "full": figures.full_figure,
    "stop motion": figures.stop_motion,
    "from above, 5": lambda run: figures.stop_motion(run, 5, view="axis"),
    "3": lambda run: figures.stop_motion(run, 3),
    "24": lambda run: figures.stop_motion(run, 24),
}


CROWDED = (
    ("paper", "5"), ("full", "at the start"), ("full", "2"), ("stop motion", "5"), ("from above, 5", "printed"),
    ("3", "at the start"), ("24", "4"), ("24", "printed"),
)  # fmt: skip


@pytest.mark.parametrize(("kind", "which"), few(CROWDED, DRAWN, ("2", "4", "5", "printed", "at the start")))
def test_no_text_is_cut_off_or_overlaps(kind, which, singular, monkeypatch):
    shown = {"printed": singular, "at the start": at_the_start(singular)}.get(which) or fly(which)
    assert overlaps(DRAWN[kind](shown), monkeypatch) == []


def test_overlaps_are_found(run, monkeypatch):
    figure = figures.paper_figure(run)
    figure.axes[0].text(0.1, -1.12, "over the tick labels", ha="right")
    assert overlaps(figure, monkeypatch)


# Files ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("suffix", "head"), [(".png", b"\x89PNG"), (".pdf", b"%PDF"), (".svg", b"<?xml"), (".PNG", b"\x89PNG")]
)
def test_figures_are_written_in_the_format_of_the_suffix(run, tmp_path, suffix, head):
    path = tmp_path / f"a{suffix}"
    for _ in range(2):  # and over what is there
        figures.save_figure(figures.paper_figure(run), path)
    assert path.read_bytes().startswith(head)
    assert list(tmp_path.iterdir()) == [path]


def test_equal_figures_are_equal_files(run, tmp_path):
    for name in ("a.pdf", "b.pdf", "a.svg", "b.svg"):
        figures.save_figure(figures.paper_figure(run), tmp_path / name)
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_a_figure_that_cannot_be_written_leaves_nothing(run, tmp_path, monkeypatch):
    figure = figures.paper_figure(run)
    (tmp_path / "folder.png").mkdir()
    old = tmp_path / "old.png"
    old.write_bytes(b"old")
    for name in ("a.bmp", "a", "none/a.png", "folder.png", f"{'a' * 300}.png"):
        with pytest.raises(fp.InputError):
            figures.save_figure(figure, tmp_path / name)

    def full_disk(path, **_):
        path.write_bytes(b"half of it")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(figure, "savefig", full_disk)
    with pytest.raises(fp.InputError, match="No space left"):
        figures.save_figure(figure, old)
    assert old.read_bytes() == b"old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder.png", "old.png"]


@pytest.mark.parametrize("count", [0, -3, float("nan"), "many"])
def test_a_bad_count_is_refused(run, count):
    with pytest.raises(fp.InputError, match="count"):
        figures.stop_motion(run, count)


def test_an_unknown_view_is_refused(run):
    with pytest.raises(fp.InputError, match="did you mean 'side'"):
        figures.stop_motion(run, view="sides")


def test_no_window_and_no_pyplot_state():
    code = "import sys, flypend.pictures.animate; assert not {'matplotlib.pyplot', 'tkinter'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)


# One set ------------------------------------------------------------------------------------------------------------

SET = [figures.paper_figure, figures.full_figure, figures.stop_motion]


@pytest.mark.parametrize(("figure", "style"), each_once(SET, STYLES))
def test_a_style_sets_the_format_and_nothing_is_cut_off(run, figure, style):
    drawn, form = figure(run, style=style), STYLES[style]
    width, height = drawn.get_size_inches()
    assert width == pytest.approx(form.half[0] if figure is figures.paper_figure else form.full[0])
    if style == "slides" and figure is not figures.paper_figure:
        assert width / height == pytest.approx(16 / 9, rel=1e-3)
    drawn.canvas.draw()
    used = drawn.get_tightbbox()
    assert min(used.x0, used.y0) > -0.02
    assert used.x1 < width + 0.02
    assert used.y1 < height + 0.02


@pytest.mark.parametrize("figure", SET)
def test_letters_are_as_large_in_print_as_captions_are(run, figure):
    sizes = [text.get_fontsize() for text in figure(run).findobj(matplotlib.text.Text) if text.get_text()]
    assert min(sizes) >= 6
    assert max(sizes) <= 9


@pytest.mark.parametrize("figure", SET)
def test_an_unknown_style_is_refused(run, figure):
    with pytest.raises(fp.InputError, match="--style: expected one of paper, slides, got 'poster'"):
        figure(run, style="poster")


def test_every_colour_comes_from_the_one_palette():
    """A hue anywhere else in the package would be a second palette; greys are free."""
    found = {}
    for path in Path(figures.__file__).parent.rglob("*.py"):
        for colour in re.findall(r"#([0-9a-fA-F]{6})\b", path.read_text(encoding="utf-8")):
            if path.name != "palette.py" and len({colour[:2], colour[2:4], colour[4:]}) > 1:
                found.setdefault(path.name, []).append(colour)
    assert not found


def luminance(colour):
    """Relative luminance as WCAG defines it."""
    c = np.array(matplotlib.colors.to_rgb(colour))
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4) @ [0.2126, 0.7152, 0.0722]


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("ground", ["paper", "sky"])
def test_lines_and_words_of_a_page_stand_out_from_its_background(theme, ground):
    colours = palette.PAGE[theme]
    assert colours.keys() == palette.PAGE["light"].keys()

    def contrast(role):
        low, high = sorted((luminance(colours[role]), luminance(colours[ground])))
        return (high + 0.05) / (low + 0.05)

    assert contrast("ink") > 7  # the levels of WCAG: enhanced, and for small letters
    assert min(contrast(role) for role in ("muted", *palette.STATES)) > 4.5
    # Graphics; green and pink of Okabe and Ito are a little paler on white than the 3 of WCAG.
    assert min(contrast(role) for role in ("rod", "trail", "thrust", "reference", "ghost", "rotor1", "rotor2")) > 3
    assert min(contrast(role) for role in ("rotor3", "rotor4")) > 2.5


def test_the_title_names_only_options_that_are_not_the_usual_ones():
    vehicle, start = fp.vehicle("hehn2011"), fp.State(y=(0, 0, 1))
    full, light = (fp.simulate(vehicle, fp.laws.inverted(form=form), start, 0.1) for form in ("full", "light"))
    assert (title(full), title(light)) == ("inverted law", "inverted law, form light")


def test_a_vehicle_that_tumbles_for_a_moment_is_drawn_by_enough_points():
    """At a turn of 0.2 rad from point to point, although the samples are few and the rod is at rest."""
    run = fp.simulate(fp.vehicle("hehn2011"), fp.laws.inverted(), fp.State(y=(0, 0, 1)), 0.4, plant="ideal")
    omega = np.zeros_like(run.omega)
    omega[3, 0] = 100.0
    turning = dataclasses.replace(run, omega=omega, y_dot=np.zeros_like(run.y_dot))
    t, found = figures.unit_vectors(turning)
    assert len(t) == 100 * 0.4 / 0.2 + 1 == len(found["z"])
