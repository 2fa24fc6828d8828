"""The outcomes of a run, kept as text: a large run is resumed at once, and takes little memory."""

import zlib
from collections.abc import Iterable, Iterator, MutableMapping
from typing import Self

from touchline.matches.engine.outcome import Outcome, from_json, to_json

_FASTEST = 1
"""Level of compression: the text becomes a quarter of its size."""


class Outcomes(MutableMapping[str, Outcome]):
    """Identity → outcome. An outcome is decoded each time it is looked up."""

    def __init__(self, texts: Iterable[tuple[str, bytes]] = ()) -> None:
        """`texts` are identities, each with the outcome's JSON."""
        self._texts = {identity: zlib.compress(text, _FASTEST) for identity, text in texts}

    def __getitem__(self, identity: str) -> Outcome:
        return from_json(zlib.decompress(self._texts[identity]))

    def __setitem__(self, identity: str, outcome: Outcome) -> None:
        self._texts[identity] = zlib.compress(to_json(outcome), _FASTEST)

    def __delitem__(self, identity: str) -> None:
        del self._texts[identity]

    def __contains__(self, identity: object) -> bool:
        return identity in self._texts

    def __iter__(self) -> Iterator[str]:
        return iter(self._texts)

    def __len__(self) -> int:
        return len(self._texts)

    def copy(self) -> Self:
        """The same outcomes, in a mapping of their own."""
        copied = type(self)()
        copied._texts = dict(self._texts)
        return copied
