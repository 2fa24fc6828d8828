"""The errors a person can mend: each says what is wrong, the value, and what to do."""

import difflib
from collections.abc import Iterable


class TouchlineError(Exception):
    """Wrong input or a broken environment; shown as one line, exit status 2."""


class MatchFailedError(Exception):
    """The input was right and the thing asked for failed; shown as one line, exit status 1."""


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """`; did you mean "x"?` for the nearest known word, else the list of all of them."""
    choices = list(known)
    close = difflib.get_close_matches(word, choices, n=1)
    return f'did you mean "{close[0]}"?' if close else "known: " + ", ".join(choices)
