"""The command group that prints every expected failure as one line on stderr and sets the exit status."""

import errno
import sys
from typing import Any

import typer
from typer.core import TyperGroup

from runtime.process.process_log import Level, log_line
from runtime.process.settings_file import WRONG
from schemas.errors import MatchFailedError, TouchlineError

PREFIX = "touchline: "
FAILED = 1
"""The requested operation failed."""


class CommandGroup(TyperGroup):
    """A group that prints errors as sentences; unexpected exceptions keep their traceback."""

    def main(self, *args: Any, **settings: Any) -> Any:
        """Run the command line and exit with its status."""
        settings["standalone_mode"] = False
        try:
            status = super().main(*args, **settings)
        except typer.TyperException as error:
            sentence = error.format_message()  # empty if the help was printed
            sys.exit(_say(_placed(sentence, error), WRONG) if sentence else WRONG)
        except TouchlineError as error:
            sys.exit(_say(str(error), WRONG))
        except MatchFailedError as error:
            sys.exit(_say(str(error), FAILED))
        except OSError as error:
            if error.errno != errno.ENOSPC:
                raise
            sys.exit(_say(f"{error.filename or 'standard output'}: {error.strerror}; make room there", FAILED))
        except typer.Abort:
            sys.exit(FAILED)
        sys.exit(status if isinstance(status, int) else 0)


def _placed(sentence: str, error: typer.TyperException) -> str:
    """The error in one line, with a pointer to the help."""
    context = getattr(error, "ctx", None)
    command = context.command_path if context is not None else "touchline"
    return f"{' '.join(sentence.replace('Value error, ', '').split())} (see {command} --help)"


def _say(sentence: str, status: int) -> int:
    log_line(sentence, Level.ERROR, prefix=PREFIX)
    return status
