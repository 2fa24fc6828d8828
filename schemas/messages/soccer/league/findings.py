"""Deviations of a log from the league's schema: each kind counted, with its first occurrence."""

from dataclasses import dataclass

MOST = 1000
"""Most kinds that are distinguished, so that a sender with ever new spellings of keys does not fill the memory."""
_FURTHER = "further kinds of deviation"


@dataclass(slots=True)
class Finding:
    """One kind of deviation."""

    what: str
    lost: bool
    """Data could not be read because of it; otherwise it was read all the same."""
    first: str
    """File and record of its first occurrence."""
    count: int = 0


class Findings:
    """All deviations, in the order of their first occurrence."""

    def __init__(self) -> None:
        self._found: dict[str, Finding] = {}
        self.place = ""
        """File and record at which the reader is."""

    def note(self, what: str, *, lost: bool = False, count: int = 1) -> None:
        """Count a deviation at the reader's place."""
        if what not in self._found and len(self._found) >= MOST:
            what = _FURTHER
        finding = self._found.get(what)
        if finding is None:
            finding = self._found[what] = Finding(what, lost, self.place)
        finding.count += count

    @property
    def coped(self) -> list[Finding]:
        """Deviations in data that was read all the same."""
        return [finding for finding in self._found.values() if not finding.lost]

    @property
    def lost(self) -> list[Finding]:
        """Deviations that made data unreadable."""
        return [finding for finding in self._found.values() if finding.lost]
