"""The firmware of a Crazyflie, where there is one."""

import os
import subprocess
from pathlib import Path

import pytest

SHARED = Path(__file__).parents[2].parent / "shared" / "firmware" / "unpack.sh"
NAMED = os.environ.get("FLYPEND_FIRMWARE")  # a folder crazyflie-firmware with submodules


@pytest.fixture(scope="session")
def firmware_source(tmp_path_factory):
    """Its folder, unpacked once."""
    if NAMED:
        return Path(NAMED)
    if not SHARED.exists():
        pytest.skip("no Crazyflie firmware: name its folder in FLYPEND_FIRMWARE")
    place = tmp_path_factory.mktemp("source")
    subprocess.run(["bash", str(SHARED), str(place)], check=True, capture_output=True)
    return place / "crazyflie-firmware"
