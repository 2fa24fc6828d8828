"""A selection of keys: key expressions of the bus, some to include and some to exclude."""

import re
from dataclasses import dataclass
from functools import cache

from schemas.errors import TouchlineError


@dataclass(frozen=True, slots=True)
class KeySelection:
    """Keys of a match that match `include`, or all keys if it is empty, and that do not match `exclude`.

    `*` stands for one chunk, `**` for any number of chunks, `$*` for any part of a chunk: `robot/*/command`,
    `team/**`, `robot/cyan$*/sight`.

    Raises:
        TouchlineError: an expression is not a key expression.
    """

    include: tuple[str, ...] = ()
    exclude: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for expression in (*self.include, *self.exclude):
            _pattern(expression)

    def __bool__(self) -> bool:
        """Whether any key can be left out."""
        return bool(self.include or self.exclude)

    def includes(self, key: str) -> bool:
        """Whether a key is selected."""
        if any(matches(expression, key) for expression in self.exclude):
            return False
        return not self.include or any(matches(expression, key) for expression in self.include)

    def key_of(self, topic: str) -> str | None:
        """The key of a topic of any MCAP file: its name without a leading `/`; None if it is not selected."""
        key = topic.removeprefix("/")
        return key if self.includes(key) else None


EVERYTHING = KeySelection()
"""Selects all keys."""


def matches(expression: str, key: str) -> bool:
    """Whether a key expression matches a key.

    Raises:
        TouchlineError: `expression` is not a key expression.
    """
    return _pattern(expression).fullmatch("/" + key) is not None


@cache
def _pattern(expression: str) -> re.Pattern[str]:
    """The keys that a key expression matches, with a `/` before each chunk."""
    pattern = ""
    for chunk in expression.split("/"):
        if chunk == "**":
            pattern += r"(?:/[^/]+)*"
            continue
        if not chunk or (chunk != "*" and re.search(r"[*$#?\s]", chunk.replace("$*", ""))):
            raise TouchlineError(
                f'"{expression}" is not a key expression; * is one chunk, ** any number of chunks, $* a part of one: '
                "robot/*/command, team/**"
            )
        pattern += "/" + (r"[^/]+" if chunk == "*" else r"[^/]*".join(map(re.escape, chunk.split("$*"))))
    return re.compile(pattern)
