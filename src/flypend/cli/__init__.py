"""The command line: `main`, which imports nothing heavy before it has taken over signals and streams."""

from __future__ import annotations

import os
import sys
from typing import NoReturn

from flypend import signals
from flypend.cli import streams

WRITE_ERROR = 2  # exit code
BROKEN_PIPE = 141  # as of a program that SIGPIPE ends


def main() -> NoReturn:
    """Run the command line. A signal, and output that cannot be printed, end it in one line."""
    signals.install()
    output = streams.take_over()
    signals.watch()
    # The matrices here are 4 × 4, and kernels have threads of their own: threads of BLAS only take time to start.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    code: object = 1
    try:
        from flypend.cli.app import main as call

        call()
    except SystemExit as ended:
        code = ended.code
    except BaseException:
        if not signals.word[0]:  # else it may come of what the signal has ended
            raise
    sys.stdout.flush()
    if signals.word[0]:
        signals.end(signals.word[0])
    if output.error is not None:
        code = BROKEN_PIPE if isinstance(output.error, BrokenPipeError) else WRITE_ERROR
        if code == WRITE_ERROR:
            sys.stderr.write(f"flypend: stdout: expected a file that can be written, got {output.error.strerror}\n")
    sys.exit(code)  # type: ignore[arg-type]
