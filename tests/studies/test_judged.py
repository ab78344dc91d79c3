"""The judges' table is printed row by row, and its random vehicles are drawn as it says."""

import numpy as np

from benchmarks import judged
from benchmarks.machines import machines


def test_a_row_has_the_finding_the_figure_of_then_and_one_of_today(monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["judged", "8", "random starts", "upside"])
    judged.main()
    head, line, row = capsys.readouterr().out.splitlines()
    assert [head.count("|"), line.count("|"), row.count("|")] == [4, 4, 4]
    assert row.startswith(
        "| random starts | 2000 of 2000, excursion 1.23 / 2.06 m | 8 of 8 (67.6 to 100.0 %), excursion"
    )


def test_every_row_is_another():
    findings, _, measures = zip(*judged.ROWS, strict=True)
    assert len(set(findings)) == len(set(measures)) == len(judged.ROWS)


def test_random_vehicles_fill_the_ranges_they_are_drawn_from():
    found = list(machines(400, 3))
    for values, low, high in (
        ([v.mass for v in found], 0.03, 5.0), ([v.bob_mass / v.mass for v in found], 0.01, 0.5),
        ([v.rod_length for v in found], 0.1, 2.0), ([4 * v.rotor_limits[1] / v.weight for v in found], 1.3, 6.0),
        ([v.rotor_lag for v in found], 0.01, 0.08),
    ):  # fmt: skip
        assert low <= np.min(values) < low + 0.05 * (high - low)
        assert high - 0.05 * (high - low) < np.max(values) <= high
    assert found[:3] == list(machines(3, 3))
