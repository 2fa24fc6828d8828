"""The charge of every robot's kicker: after a kick it cools down, then charges, and only then kicks again.

All there is to know is the tick of each robot's last kick. At a checkpoint every kicker is charged, in the running
match as in one that is simulated again from there, so that poses and velocities tell the whole future; a kick-off comes
long after the last kick anyway.
"""

from collections.abc import Sequence

from schemas.config.sections import Kicker


class Kickers:
    """The kickers of all robots, in the order of the roster."""

    def __init__(self, kickers: Sequence[Kicker], tick: float) -> None:
        """`tick`: one control tick in s."""
        self._kickers = kickers
        self._tick = tick
        self._kicked_at: list[int | None] = [None] * len(kickers)
        self._all_ready = (True,) * len(kickers)

    def charge(self) -> None:
        """Every kicker is charged."""
        self._kicked_at = [None] * len(self._kickers)

    def kicked(self, index: int, tick: int) -> None:
        """A robot has kicked in this tick."""
        self._kicked_at[index] = tick

    def why_not(self, index: int, tick: int) -> str | None:
        """Why this robot's kicker cannot kick in this tick; nothing when it can."""
        kicked_at, kicker = self._kicked_at[index], self._kickers[index]
        if kicked_at is None:
            return None
        since = (tick - kicked_at) * self._tick
        to_go = kicker.cooldown + kicker.charge_time - since
        if to_go <= 1e-9:
            return None
        doing = "charging" if since >= kicker.cooldown - 1e-9 else "cooling down"
        return f"kick: {doing}, {to_go:.2g} s to go"

    def ready(self, tick: int) -> tuple[bool, ...]:
        """Per robot: its kicker can kick in this tick."""
        if self._kicked_at.count(None) == len(self._kicked_at):
            return self._all_ready
        return tuple([at is None or self.why_not(index, tick) is None for index, at in enumerate(self._kicked_at)])
