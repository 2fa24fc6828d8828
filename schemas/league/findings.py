"""What in a log is not as the league's schema says: each kind counted, with the first place where it was found."""

from dataclasses import dataclass

MOST = 1000
"""Kinds that are told apart: a sender that spells each key anew must not fill the memory."""
_FURTHER = "further kinds of deviation"


@dataclass(slots=True)
class Finding:
    """One kind of deviation."""

    what: str
    lost: bool
    """Something could not be read because of it; otherwise it was coped with."""
    first: str
    """Where it was met first: file and record."""
    count: int = 0


class Findings:
    """All of them, in the order they were met in."""

    def __init__(self) -> None:
        self._found: dict[str, Finding] = {}
        self.place = ""
        """Where the reader is."""

    def note(self, what: str, *, lost: bool = False, count: int = 1) -> None:
        """Count a deviation at the place where the reader is."""
        if what not in self._found and len(self._found) >= MOST:
            what = _FURTHER
        finding = self._found.get(what)
        if finding is None:
            finding = self._found[what] = Finding(what, lost, self.place)
        finding.count += count

    @property
    def coped(self) -> list[Finding]:
        """What was read all the same."""
        return [finding for finding in self._found.values() if not finding.lost]

    @property
    def lost(self) -> list[Finding]:
        """What could not be read."""
        return [finding for finding in self._found.values() if finding.lost]
