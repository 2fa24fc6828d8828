"""The charge of the kickers: after a kick, a kicker cools down, then charges, and can kick again.

The tick of each robot's last kick is the whole state. At a checkpoint every kicker is charged, in the match and in its
resimulation, so that poses and velocities determine the future. At a kick-off, the usual checkpoint, the last kick is
long past.
"""

from collections.abc import Sequence

from schemas.config.sections import Kicker


class Kickers:
    """The kickers of all robots, in the order of the roster."""

    def __init__(self, kickers: Sequence[Kicker], tick: float) -> None:
        """`tick` is the control tick in s."""
        self._kickers = kickers
        self._tick = tick
        self._kicked_at: list[int | None] = [None] * len(kickers)
        self._all_ready = (True,) * len(kickers)

    def charge(self) -> None:
        """Charge all kickers."""
        self._kicked_at = [None] * len(self._kickers)

    def kicked(self, index: int, tick: int) -> None:
        """Note that a robot has kicked in this tick."""
        self._kicked_at[index] = tick

    def why_not(self, index: int, tick: int) -> str | None:
        """Why this robot's kicker cannot kick in this tick, or None."""
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
