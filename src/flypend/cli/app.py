"""The commands: parse arguments, make one call, print a table. Bad input prints one line and exits with code 2."""

from __future__ import annotations

import signal
import sys
import traceback

import click

from flypend import __version__, signals
from flypend.cli import export, flights, installation, machines, paper, planning, studies
from flypend.cli.terminal import say
from flypend.errors import InputError

# In the order in which they are listed.
COMMANDS = (
    paper.paper, flights.run, studies.compare, studies.ladder, flights.lab, paper.theorem, planning.plan,
    studies.learn, studies.sweep, studies.draw_map, studies.tune, machines.vehicle, machines.identify, machines.check,
    flights.replay, flights.movie, flights.figures, installation.laws, installation.vehicles, installation.examples,
    installation.cache, export.export_c, export.export_app,
)  # fmt: skip


class _Commands(click.Group):
    """Lists the commands in their order, each with its whole first sentence."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(self.commands)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([(name, some.get_short_help_str(1000)) for name, some in self.commands.items()])


@click.group(
    cls=_Commands,
    commands=COMMANDS,
    context_settings={"help_option_names": ["-h", "--help"], "show_default": True, "max_content_width": 100},
)
@click.version_option(__version__, message="%(prog)s %(version)s", prog_name="flypend")
@click.option("--debug", is_flag=True, help="Show the full traceback of an error: flypend --debug run 1.")
def app(debug: bool) -> None:
    """A spherical pendulum on a quadrotor: fly laws, compare them, study a vehicle, export C, reproduce the paper."""
    # main looks for --debug itself: it must work even if parsing fails


def main() -> None:
    """Call the command of the arguments and exit; bad input prints one line and exits with code 2."""
    sys.exit(_call())


def _call() -> int:
    """Call the command of the arguments, and return its exit code."""
    try:
        return app(prog_name="flypend", standalone_mode=False) or 0
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        return 2
    except (InputError, click.ClickException) as error:
        signals.poll()  # what the signal has ended is no bad input
        if "--debug" in sys.argv[1:]:
            traceback.print_exc()
        message = error.format_message() if isinstance(error, click.ClickException) else str(error)
        if isinstance(error, click.UsageError) and error.ctx is not None:
            message += f" See {error.ctx.command_path} --help."
        say(" ".join(f"flypend: {message}".split()))
        return 2
    except (KeyboardInterrupt, click.Abort):
        return 128 + signal.SIGINT
