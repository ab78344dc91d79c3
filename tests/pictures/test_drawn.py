"""The tracked pictures of README and docs are those that `make pictures` draws with today's code."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from benchmarks import hero, pages
from tests.few import slow

TRACKED = Path(__file__).parents[2] / "docs" / "img"
FAR = 40  # of 255: more than few colours or a lossy format change
SHARE = 0.01  # of the pixels, for edges: another law, machine, camera or label changes more


def differing(one, other):
    """The share of pixels of two pictures that differ by more than `FAR`."""
    assert one.size == other.size
    a, b = (np.asarray(picture.convert("RGB"), dtype=int) for picture in (one, other))
    return np.mean(np.abs(a - b).max(axis=-1) > FAR)


@pytest.mark.parametrize(
    "name",
    [
        "vehicles",
        "machine",
        "swing-up",
        "plan-out-and-back",
        *(slow(name) for name in ("plan-under-the-bar", "replay", "lab", "live")),
    ],
)
def test_a_picture_is_of_todays_code(name, tmp_path, monkeypatch):
    monkeypatch.setattr(pages, "PICTURES", tmp_path)
    pages.DRAWINGS[name]()
    drawn = sorted(tmp_path.glob("*.png"))
    assert drawn
    found = {path.name: differing(Image.open(path), Image.open(TRACKED / path.name)) for path in drawn}
    assert max(found.values()) < SHARE, found


@pytest.mark.slow
def test_the_animation_is_of_todays_code(chromium, tmp_path):
    """Three pictures of it, before and in the flip and after a poke; it lasts ten seconds, to one."""
    tracked, times = Image.open(TRACKED / "hero.webp"), hero.times()
    assert tracked.n_frames == len(times)
    assert len(times) / hero.RATE == pytest.approx(10, abs=1)
    assert tracked.width * 9 == tracked.height * 16
    page = hero.flown(chromium, tmp_path)
    page.wait_for_timeout(500)
    for wanted in (0.4, 0.95, 5.0):
        i = int(np.searchsorted(times, wanted))
        tracked.seek(i)
        assert differing(hero.picture(page, times[i]), tracked) < SHARE
    page.context.close()


def test_another_picture_is_noticed():
    machine, other = (Image.open(TRACKED / f"vehicle-{name}.png") for name in ("hehn2011", "x500"))
    assert differing(machine, other.resize(machine.size)) > SHARE
