"""Refusals of one service: all are counted, and each kind is logged once for each client network. Pure."""

from collections import Counter, OrderedDict
from collections.abc import Callable, Mapping

from coach_gateway.access.rate_limit import TokenBucket

MOST_NAMED = 1024
"""Pairs of kind and network that are remembered as logged."""
_LINES_PER_S, _LINES_AT_ONCE = 1.0, 20.0
"""Lines of the log per s of wall time, and at once."""
THIS_MACHINE = "this machine"
_LONGEST = 120
"""Characters of a reason in the log."""


class Refusals:
    """Counts by kind; the log gets one line for each kind and network, and never many lines at once."""

    def __init__(self, service: str, log: Callable[[str], None], texts: Mapping[str, str] | None = None) -> None:
        """`service` begins each line, `log` is called with lines for people, `texts` describe kinds."""
        self._service, self._log, self._texts = service, log, texts or {}
        self._lines: TokenBucket | None = None
        self._named: OrderedDict[tuple[str, str], None] = OrderedDict()
        self.counts: Counter[str] = Counter()
        """Refusals by kind."""

    def note(self, kind: str, network: str | None, now: float, reason: str = "") -> None:
        """Count a refusal of a network, None for this machine; `reason` explains the first one."""
        self.counts[kind] += 1
        key = (kind, network or THIS_MACHINE)
        self._lines = self._lines or TokenBucket(_LINES_PER_S, _LINES_AT_ONCE, now)
        if key in self._named or not self._lines.allow(now):
            return
        self._named[key] = None
        if len(self._named) > MOST_NAMED:
            self._named.popitem(last=False)
        because = f" ({reason[:_LONGEST]})" if reason else ""
        self._log(f"{self._service}: {self._texts.get(kind, kind)} from {key[1]}{because}; further ones are counted")

    def summary(self) -> str:
        """All refusals with their numbers, as text; empty where there are none."""
        return ", ".join(f"{count} × {self._texts.get(kind, kind)}" for kind, count in sorted(self.counts.items()))
