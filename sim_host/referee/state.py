"""The referee's state between two ticks: everything it remembers, and nothing else."""

from dataclasses import dataclass, field
from typing import NamedTuple

from schemas.game import GameState, Phase, Point, Score
from schemas.side import Side
from sim_host.referee.evidence import NOTHING, Evidence

Spot = tuple[float, float]
"""A point on the ground: x and y in m, field frame."""


class Restart(NamedTuple):
    """A way to bring the ball back into play: which, for whom (nobody at a drop ball), and from where."""

    phase: Phase
    side: Side | None
    spot: Spot


@dataclass(frozen=True, slots=True)
class RefereeState:
    """The game as the referee remembers it; times in s, places in m in the field frame."""

    phase: Phase
    half_limit: float
    """Game clock at which this half ends."""
    kick_off: Side
    """Who kicks off this half."""
    side: Side | None = None
    """Who takes the restart that is signalled."""
    spot: Spot | None = None
    """Where the ball lies for the restart that is signalled."""
    running: bool = False
    """START was given."""
    half: int = 1
    clock: float = 0.0
    """Playing time of this half and those before it."""
    clock_runs: bool = False
    """From the first START of a half to its end, also through stoppages."""
    score: Score = field(default_factory=Score)
    cyan_attacks: int = 1
    """Sign of the x direction that cyan attacks."""
    pending: Restart | None = None
    """What will be signalled after STOP; nothing when people have to decide."""
    timer: float = 0.0
    """Time since STOP, the signal, START, or the beginning of the break."""
    still: float = 0.0
    """How long the ball in play has not moved."""
    ball: tuple[float, float, float] | None = None
    """Where the ball's centre was at the last tick."""
    evidence: Evidence = NOTHING
    """What was seen since START."""

    @property
    def last_touch(self) -> str | None:
        """The robot that last touched the ball since START."""
        touch = self.evidence.play.last
        return touch.robot if touch is not None else None

    @property
    def restart(self) -> Restart | None:
        """The restart that is signalled and not yet in play, or nothing."""
        return Restart(self.phase, self.side, self.spot) if self.spot is not None else None

    def attack(self, side: Side) -> int:
        """Sign of the x direction that a side attacks."""
        return side.attack(self.cyan_attacks)

    def game_state(self, tick: int, time: float, episode: int = 1) -> GameState:
        """The state as it is published, at that tick and simulated time in s, of that episode."""
        return GameState(
            tick=tick,
            time=time,
            phase=self.phase,
            side=self.side,
            running=self.running,
            half=self.half,
            clock=self.clock,
            score=self.score,
            cyan_attacks=self.cyan_attacks,
            spot=point(self.spot),
            episode=episode,
        )


def point(spot: Spot | None) -> Point | None:
    """A spot as it is published."""
    return None if spot is None else Point(x=spot[0], y=spot[1])
