"""The space of plain sights, for policies that read what a brain reads."""

from typing import Any, NoReturn

from gymnasium.spaces import Space

from schemas.errors import TouchlineError
from schemas.messages.sight import Sight


class SightSpace(Space[Sight]):
    """All `schemas.messages.sight.Sight`; it has no bounds, and cannot be sampled."""

    def contains(self, x: Any) -> bool:
        """Whether this is a sight."""
        return isinstance(x, Sight)

    def sample(self, _mask: Any | None = None, _probability: Any | None = None) -> NoReturn:
        """There are no random sights.

        Raises:
            TouchlineError: always.
        """
        raise TouchlineError('sights are not sampled; make the environment with observation="vector"')

    def __eq__(self, other: object) -> bool:
        """All spaces of sights are equal."""
        return isinstance(other, SightSpace)
