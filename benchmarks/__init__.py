"""Side by side: flypend's kernels and what else could fly the same closed loop. `make bench` runs it."""

from __future__ import annotations

import subprocess
from pathlib import Path


def run(*words: object, folder: Path | None = None) -> str:
    """What a command prints. Raises RuntimeError with what it said if it fails."""
    command, quiet = list(map(str, words)), subprocess.DEVNULL
    done = subprocess.run(command, cwd=folder, stdin=quiet, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout
