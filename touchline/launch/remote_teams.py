"""The remote teams of a match: which of their robots are there, and which are awaited. Knows no bus."""

from collections.abc import Mapping

from schemas.config.match_config import MatchConfig
from schemas.messages.health import Health
from schemas.side import Side


class RemoteTeams:
    """Follows the robots that are started elsewhere, by the host's health."""

    def __init__(self, config: MatchConfig) -> None:
        self._robots: Mapping[Side, list[str]] = {side: config.robots(side) for side in config.remote_sides}
        self._wait = config.patience.remote
        self._present: set[str] = set()
        self._deadline: float | None = None
        self._has_begun = False
        self.absent: Side | None = None
        """The side of which no robot has joined in time; None otherwise."""

    def update(self, health: Health, now: float) -> list[str]:
        """Process the host's health at this wall time in s; returns one line for each robot that joined or left.

        The wait begins with the first call. A match that the referee has started in the meantime is played.
        """
        if not self._robots:
            return []
        if self._deadline is None:
            self._deadline = now + self._wait
        news = [line for side, names in self._robots.items() for line in self._changes(side, names, health)]
        is_late = now >= self._deadline
        self._has_begun = self._has_begun or (health.tick > 0 and not is_late)
        if is_late and not self._has_begun:
            self._has_begun = True
            self.absent = next((side for side, names in self._robots.items() if not self._present & set(names)), None)
        return news

    def waiting(self, health: Health) -> str:
        """Who is there and who is missing, while the match has not begun; empty otherwise."""
        if health.tick > 0:
            return ""
        parts = []
        for side, names in self._robots.items():
            missing = [name for name in names if name not in self._present]
            if missing:
                there = ", ".join(name for name in names if name in self._present) or "no robot"
                parts.append(f"waiting for {side}: {there} there; missing: {', '.join(missing)}")
        return "  ".join(parts)

    def absence(self, side: Side) -> str:
        """Why a match without this side is not played."""
        return (
            f"no robot of {side} joined within {self._wait:g} s; start it on the other machine first, "
            "or give a longer --wait"
        )

    def _changes(self, side: Side, names: list[str], health: Health) -> list[str]:
        news = []
        for name in names:
            alive = name in health.robots and health.robots[name].alive
            if alive == (name in self._present):
                continue
            (self._present.add if alive else self._present.discard)(name)
            count = len(self._present & set(names))
            news.append(f"{name} {'joined' if alive else 'left'}: {count} of {len(names)} robots of {side} are there")
        return news
