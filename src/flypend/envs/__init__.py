"""Environments for learning: `import flypend.envs` registers flypend/Balance-v0 and others with gymnasium.

The physics is that of every other flight: state, rotors and vehicle advance by `plants.equations.rotor_step`.

**Observations** (float32, SI units): position and velocity of the pivot relative to the goal, world frame (3 + 3); R by
columns (9), or its first two (6); angular velocity in the body frame (3); rod direction and its rate, world frame
(3 + 3); rotor forces from −1 to 1 within their limits (n); the last action (m); and for "track" where the goal will be
in 0.1, 0.2 and 0.4 s, relative to where it is (9). A task may show more: `Task.shown`. With `attitude="body"` all
vectors are in the body frame, and the vertical (3) stands for R.

With `sensors`, observations are the estimates of the flight computer; see `Environment`.

**Actions** are m numbers in [−1, 1]: see `Environment`.

**Ends.** A world terminates when its task says so, when the rod touches the vehicle or leaves its cup, and when its
state is not finite or out of bounds. Extreme actions may cause that, but only in their own world. A world is truncated
after the task's duration.
"""

from __future__ import annotations

from typing import Any

from flypend.errors import require

require("gymnasium", extra="rl", for_="flypend.envs")

import gymnasium  # noqa: E402

from flypend.envs.differentiable import DifferentiableWorlds  # noqa: E402
from flypend.envs.make import TASKS, environment  # noqa: E402
from flypend.envs.problem import Environment  # noqa: E402
from flypend.envs.randomise import Randomisation  # noqa: E402
from flypend.envs.single import World  # noqa: E402
from flypend.envs.state import SavedState  # noqa: E402
from flypend.envs.task import Moment, Task, balance, catch_in_cup, swing_up, track  # noqa: E402
from flypend.envs.vector import VectorWorlds  # noqa: E402

__all__ = [
    "DifferentiableWorlds", "Environment", "Moment", "Randomisation", "SavedState", "Task", "VectorWorlds", "World",
    "balance", "catch_in_cup", "environment", "swing_up", "track",
]  # fmt: skip

_IDS: dict[str, dict[str, Any]] = {made().name: {"task": task} for task, made in TASKS.items()}
_IDS["SwingUpShaped"] = {"task": "swing_up", "shaped": True}
for _id, _arguments in _IDS.items():
    gymnasium.register(
        id=f"flypend/{_id}-v0",
        entry_point="flypend.envs.single:World",
        vector_entry_point="flypend.envs.vector:VectorWorlds",
        kwargs=_arguments,
    )
