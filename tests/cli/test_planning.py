"""The command plan: what it prints and writes, from a run file and without one."""

from dataclasses import fields, replace

import numpy as np
import pytest

import flypend as fp
from flypend.cli import app as cli
from flypend.cli.planning import Kept


def test_a_swing_up_is_planned_and_flown(tmp_path, capsys):
    out, page = tmp_path / "plan.nc", tmp_path / "plan.html"
    picture = tmp_path / "plan.svg"
    files = ["-o", str(out), "--html", str(page), "--c", str(tmp_path / "table"), "--figure", str(picture)]
    cli.app(["plan", *files, "--ceiling", "0.7", "--fly", "rotors"], standalone_mode=False)
    told = capsys.readouterr().out
    assert "hehn2011: converged: 3.00 s" in told
    assert "Flown on rotors: stands" in told
    assert "flypend_plan_command" in (tmp_path / "table" / "flypend_plan.h").read_text()
    run = fp.load(out)
    assert run.law == "plan"
    assert run.x[:, 2].max() < 0.7
    assert picture.read_text().startswith("<?xml")
    assert page.read_text().startswith("<!doctype html")


def test_the_rod_is_let_down_and_tabled(tmp_path, capsys):
    table, start = tmp_path / "plan.csv", tmp_path / "start.toml"
    start.write_text('vehicle = "hehn2011"\nduration = 5.0\nlaw.name = "inverted"\n[start]\ny = [0, 0, 1]\n')
    out = ["-o", str(tmp_path / "plan.nc")]
    cli.app(["plan", str(start), *out, "--end", "hanging", "--csv", str(table)], standalone_mode=False)
    assert "hehn2011: converged: 3.00 s" in capsys.readouterr().out
    header, *rows = table.read_text().splitlines()
    last = dict(zip(header.split(","), map(float, rows[-1].split(",")), strict=True))
    assert last["y_3 [1]"] < -0.999
    with pytest.raises(fp.InputError, match=r"--end: expected one of inverted, hanging"):
        cli.app(["plan", *out, "--end", "hangin"], standalone_mode=False)


def test_a_cube_is_about_the_target_or_the_end_of_a_path(tmp_path):
    asked = Kept(**{field.name: None for field in fields(Kept)} | {"cube": 0.6, "window": (), "waypoints": ()})
    box = asked.constraints(fp.State(x=(1.0, 0.0, -2.0), y=(0, 0, 1)), None, {}).box
    np.testing.assert_allclose(box, [(0.7, -0.3, -2.3), (1.3, 0.3, -1.7)])
    path = replace(asked, path=f"{tmp_path / 'way.py'}:line")
    (tmp_path / "way.py").write_text("import casadi as ca\ndef line(t):\n    return ca.vertcat(t, 0, 2.0)\n")
    np.testing.assert_allclose(path.constraints(None, 3.0, {}).box, [(2.7, -0.3, 1.7), (3.3, 0.3, 2.3)])


def test_a_run_file_gives_vehicle_and_start(tmp_path, capsys):
    out = tmp_path / "plan.nc"
    with pytest.raises(SystemExit) as ended:
        cli.app(["plan", "4", "--duration", "0.2", "-o", str(out)], standalone_mode=False)
    assert ended.value.code == 1
    assert "nayak2018: failed (inverted hover is not reached)" in capsys.readouterr().out


def test_a_window_and_a_waypoint_are_flown_through(tmp_path, capsys):
    start = tmp_path / "start.toml"
    start.write_text(
        'vehicle = "hehn2011"\nduration = 5.0\nlaw.name = "inverted"\n[start]\nx = [-1.5, 0, 0]\ny = [0, 0, 1]\n'
    )
    out = tmp_path / "plan.nc"
    through = ["--window", "-0.5", "0.25", "0.3", "0.5", "1.0", "--waypoint", "0.5", "0", "0.2", "--lean", "90"]
    asked = ["plan", str(start), "--target", "1.5", "0", "0", "--objective", "effort", "-o", str(out)]
    cli.app([*asked, *through], standalone_mode=False)
    assert "converged" in capsys.readouterr().out
    run, window = fp.load(out), fp.Window((-0.5, 0.25, 0.3), 0.5, 1.0)
    assert window.room(run.states, fp.vehicle("hehn2011")).min() > 0
    assert np.linalg.norm(run.x - (0.5, 0, 0.2), axis=1).min() < 0.03
    assert run.y[:, 2].min() > 0
    np.testing.assert_allclose(run.x[-1], (1.5, 0, 0), atol=0.01)


def test_what_is_ones_own_is_kept_and_costs(tmp_path, capsys):
    """Denser than the plan's samples, and against the plan without it."""
    out, function = tmp_path / "plan.nc", tmp_path / "own.py"
    function.write_text("def sideways(m):\n    return 5 * m.x[0]\n")
    asked = ["plan", "-o", str(out), "--duration", "2"]
    cli.app(asked, standalone_mode=False)
    free = fp.load_plan(out)
    cli.app([*asked, "--keep", "x[2] < 0.04, x[2] > -0.04"], standalone_mode=False)
    assert np.max(np.abs(fp.load_plan(out).x[:, 2])) < 0.041 < np.max(np.abs(free.x[:, 2]))
    cli.app([*asked, "--cost", f"{function}:sideways", "--objective", "cost"], standalone_mode=False)
    assert np.max(np.abs(fp.load_plan(out).x[:, 0])) < 0.5 * np.max(np.abs(free.x[:, 0]))
    assert "converged" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "line"),
    [
        (["--keep", "x[2] <"], "--keep: expected an expression such as"),
        (["--cost", "z"], "--cost: expected one of x, x_dot"),
        (["--keep", "no.py:low"], "--keep: expected a file that is there"),
        (["--keep", "x[2] > 1"], "keep: expected values above 0 at the start"),
        (["--objective", "cost"], "cost: expected the cost that is the objective"),
        (["--clearance", "-1"], "clearance: expected a finite number >= 0 m"),
        (["--end", "no.toml"], "no.toml: expected a readable TOML file"),
        (["--end", "hanging", "--front", "front.png"], "--front: expected nothing beside --end hanging"),
        (["--path", "way.py:line", "--front", "front.png"], "--front: expected nothing beside --path"),
        (["--end", "hanging", "--fly", "rotors"], "--fly: expected nothing beside --end hanging"),
        (["--end", "hanging", "--c", "table"], "--c: expected nothing beside --end hanging"),
    ],
)
def test_wrong_options_end_in_a_line(options, line, call):
    code, _, told = call("plan", *options)
    assert code == 2
    assert line in told
    assert told.count("\n") == 1


def test_the_law_of_a_run_file_says_what_is_planned_and_options_come_first(tmp_path):
    out, start, end = (tmp_path / name for name in ("plan.nc", "start.toml", "end.toml"))
    start.write_text(
        'vehicle = "hehn2011"\nduration = 5.0\n[start]\nx = [-0.5, 0, 0]\ny = [0, 0, 1]\n'
        '[law]\nname = "plan"\ntarget = [0.5, 0, 0]\nobjective = "effort"\nkeep = "x[1] < 0.3"\nspeed = 0.6\n'
    )
    cli.app(["plan", str(start), "-o", str(out), "--speed", "0.5"], standalone_mode=False)
    plan = fp.load_plan(out)
    assert plan.target.tolist() == [0.5, 0, 0]
    assert plan.objective["effort"] == 1
    assert 0.4 < np.max(np.linalg.norm(plan.x_dot, axis=1)) < 0.501
    end.write_text('vehicle = "hehn2011"\nduration = 5.0\nlaw.name = "inverted"\n[start]\ny = [0, 0, 1]\n')
    end.write_text(end.read_text() + "x = [0, 0.2, 0]\nx_dot = [0.2, 0, 0]\n")
    cli.app(["plan", str(start), "-o", str(out), "--end", str(end)], standalone_mode=False)
    plan = fp.load_plan(out)
    np.testing.assert_allclose(plan.x[-1], (0, 0.2, 0), atol=0.01)
    np.testing.assert_allclose(plan.x_dot[-1], (0.2, 0, 0), atol=0.04)
    with pytest.raises(fp.InputError, match="--target: expected nothing beside --end"):
        cli.app(
            ["plan", str(start), "-o", str(out), "--end", str(end), "--target", "0", "0", "1"], standalone_mode=False
        )


def test_a_bad_ending_is_refused_before_any_work(tmp_path):
    with pytest.raises(fp.InputError, match="nc"):
        cli.app(["plan", "-o", str(tmp_path / "plan.html")], standalone_mode=False)


def test_what_plans_at_its_first_measurement_is_not_exported(tmp_path):
    with pytest.raises(fp.InputError, match=r"plan, which is not \(it plans each flight and follows a table\)"):
        cli.app(["export-c", "--law", "plan", "--out", str(tmp_path / "c")], standalone_mode=False)
