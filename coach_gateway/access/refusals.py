"""What a service refuses: all of it is counted, and the first of each kind from an address is logged. Pure."""

from collections import Counter
from collections.abc import Callable

MOST_LOGGED = 100
"""Pairs of kind and address that are logged: a log is for people."""
_LONGEST = 120
"""Characters of a reason in the log."""


class Refusals:
    """Counts by kind."""

    def __init__(self, service: str, log: Callable[[str], None]) -> None:
        """`service` begins each line, `log` is called with lines for people."""
        self._service, self._log = service, log
        self._logged: set[tuple[str, str]] = set()
        self.counts: Counter[str] = Counter()
        """Refusals by kind."""

    def note(self, kind: str, address: str, reason: str = "") -> None:
        """Count a refusal of an address; `reason` explains the first one."""
        self.counts[kind] += 1
        if (kind, address) in self._logged or len(self._logged) >= MOST_LOGGED:
            return
        self._logged.add((kind, address))
        because = f" ({reason[:_LONGEST]})" if reason else ""
        self._log(f"{self._service}: {kind} from {address}{because}; further ones are counted")

    def log_summary(self) -> None:
        """Log all refusals with their numbers, if there are any."""
        if self.counts:
            counts = ", ".join(f"{count} × {kind}" for kind, count in sorted(self.counts.items()))
            self._log(f"{self._service}: refused {counts}")
