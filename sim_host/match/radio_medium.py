"""What limits the messages of a team: its budget, and a channel that both sides share."""

from collections import deque

from schemas.config.sections import RadioChannel

_WINDOW_S = 1.0
"""The budget counts the messages that a team sent in this time."""
_ROUNDING = 1e-9
"""s; a message that was sent a second ago no longer counts, however floats round."""


class Budget:
    """The bits that one team has sent within the last second."""

    def __init__(self) -> None:
        self._sent: deque[tuple[float, int]] = deque()
        """(time in s, bits) of each message of the last second."""
        self.bits = 0
        """Bits of the last second before the newest message, which they include."""
        self.busiest = 0
        """Most bits of a second so far."""

    def refusal(self, at: float, bits: int, budget: float) -> str | None:
        """Why the team may not send these bits at this time, or None; `budget` in bit/s."""
        while self._sent and self._sent[0][0] <= at - _WINDOW_S + _ROUNDING:
            self.bits -= self._sent.popleft()[1]
        if self.bits + bits > budget * _WINDOW_S:
            return f"radio: the team's budget of {budget / 1e6:g} Mbit/s is used up"
        return None

    def spend(self, at: float, bits: int) -> None:
        """Count a message that is sent at this time."""
        self._sent.append((at, bits))
        self.bits += bits
        if self.bits > self.busiest:
            self.busiest = self.bits


class SharedChannel:
    """One channel for both sides: it carries one message at a time, and the others wait in the order of sending."""

    def __init__(self) -> None:
        self._free_at = 0.0
        """s; the end of the last message that was accepted."""

    def transmit(self, at: float, bits: int, air: RadioChannel) -> tuple[float, str | None]:
        """The end of a message that is sent at this time, in s; or why the channel refuses it."""
        begins = max(at, self._free_at)
        if begins - at > air.queue:
            return begins, (
                f"radio: both sides' messages keep the channel busy for {begins - at:.3f} s; the queue is "
                f"{air.queue:g} s long, send fewer or shorter messages"
            )
        self._free_at = begins + air.frame_time + bits / air.bit_rate
        return self._free_at, None
