"""The command line: `main`, which imports nothing heavy before it has taken over signals and streams."""

from __future__ import annotations

import io
import os
import sys
from typing import Any, NoReturn, TextIO

from flypend import signals

WRITE_ERROR = 2  # exit code
BROKEN_PIPE = 141  # as of a program that SIGPIPE ends


def main() -> NoReturn:
    """Run the command line. A signal, and output that cannot be printed, end it in one line."""
    signals.install()
    output = take_over()
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


class Stream(io.FileIO):
    """Writes to a file descriptor; after an `error` it takes whatever comes, so that nothing fails at the end."""

    error: OSError | None = None

    def write(self, data: Any) -> Any:
        """Write `data`; drop it after an error."""
        if self.error is None:
            try:
                return super().write(data)
            except OSError as error:
                self.error = error
        return len(data)


def take_over() -> Stream:
    """Make stdout and stderr streams that may be closed or full, and return that of stdout.

    Where the terminal's encoding lacks ✓ or ẍ, they print something else. Descriptors that are closed are opened, so
    that no file takes their number: stdin reads nothing, stderr drops what it is given, stdout fails.
    """
    for number, mode in enumerate((os.O_RDONLY, os.O_RDONLY, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, mode)
    if sys.stdin is None:
        sys.stdin = open(0, closefd=False)  # noqa: SIM115 (a descriptor, for good)
    output = Stream(1, "w", closefd=False)
    sys.stdout, sys.stderr = _text(output, sys.stdout), _text(Stream(2, "w", closefd=False), sys.stderr)
    return output


def _text(stream: Stream, like: TextIO | None) -> io.TextIOWrapper:
    """Return a text stream on top of `stream` that encodes and buffers as the one it replaces."""
    encoding = getattr(like, "encoding", None)
    lines = stream.isatty() or stream.fileno() == 2
    unbuffered = getattr(like, "write_through", False)
    return io.TextIOWrapper(
        io.BufferedWriter(stream), encoding, "replace", line_buffering=lines, write_through=unbuffered
    )
