"""A player of a recording on a stepped clock, whose messages are kept."""

from dataclasses import dataclass, field

from recordings.reading.recording import RecordedMessage
from recordings.replay.player import Player
from schemas.topics import WORLD
from support.stepped_clock import SteppedClock


@dataclass
class PlayerRig:
    """A player, its clock, and its published messages."""

    player: Player
    clock: SteppedClock
    published: list[RecordedMessage] = field(default_factory=list)

    def run(self, seconds: float, step: float = 0.001) -> None:
        """Let wall time pass."""
        end = self.clock.now() + seconds
        while self.clock.now() < end - 1e-12 and not self.player.ended:
            self.player.pump()
            self.clock.sleep_until(min(end, self.clock.now() + step))
        self.player.pump()

    def finish(self) -> None:
        """Play to the end."""
        while not self.player.ended:
            if not self.player.pump():
                self.clock.sleep_until(self.clock.now() + max(1e-6, self.player.wait()))

    def ticks(self, since: int = 0) -> list[int]:
        """Ticks of the published worlds."""
        return [one.message().tick for one in self.published[since:] if one.topic is WORLD]
