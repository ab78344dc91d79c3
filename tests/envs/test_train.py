"""The example that trains a policy by a third party's PPO; needs Stable-Baselines3, which brings PyTorch."""

import runpy
from pathlib import Path

import pytest

import flypend

EXAMPLE = Path(flypend.__file__).parent / "examples" / "train.py"


@pytest.mark.slow
def test_ppo_learns_to_balance():
    assert runpy.run_path(str(EXAMPLE))["train"]()[1] >= 0.95
