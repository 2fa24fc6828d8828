"""Errors that a user can fix: each names the fault, the value and the remedy."""

import difflib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager


class TouchlineError(Exception):
    """Invalid input or a broken environment; shown as one line, exit status 2."""


class NoBallError(TouchlineError):
    """The ball of a game without one was asked for."""

    def __init__(self) -> None:
        super().__init__("this game has no ball")


class MatchFailedError(Exception):
    """The input was valid and the match failed; shown as one line, exit status 1."""


@contextmanager
def os_errors(what: object, remedy: str) -> Iterator[None]:
    """Raise an OSError as a TouchlineError about `what`, or about the error's own file if that is None."""
    try:
        yield
    except OSError as error:
        raise TouchlineError(f"{what or error.filename or 'a file'}: {error.strerror or error}; {remedy}") from None


def did_you_mean(word: object, known: Iterable[str]) -> str:
    """`did you mean "x"?` with the nearest known word, or the list of all known words."""
    choices = list(known)
    close = difflib.get_close_matches(str(word), choices, n=1)
    return f'did you mean "{close[0]}"?' if close else "known: " + ", ".join(choices)
