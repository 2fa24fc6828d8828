"""The referee's state between two ticks: everything it remembers, and nothing else."""

from typing import NamedTuple

from schemas.game import GameStage, GameState, Phase, Point, Score
from schemas.side import Side
from sim_host.referee.evidence import NO_EVIDENCE, Evidence
from sim_host.referee.game.decision import Proposal
from sim_host.referee.game.participation import Participation
from sim_host.referee.game.restart import Restart, Spot
from sim_host.referee.game.set_piece import SetPiece
from sim_host.referee.game.shoot_out import ShootOut
from sim_host.referee.game.timing import Timing


class RefereeState(NamedTuple):
    """The game as the referee remembers it; times in s, places in m in the field frame."""

    phase: Phase
    timing: Timing
    kick_off: Side
    """Who kicks off this half."""
    side: Side | None = None
    """Who takes the restart that is signalled."""
    spot: Spot | None = None
    """Where the ball lies for the restart that is signalled."""
    running: bool = False
    """START was given."""
    half: int = 1
    """Counts on through extra time."""
    stage: GameStage = GameStage.REGULAR
    score: Score = Score()
    cyan_attacks: int = 1
    """Sign of the x direction that cyan attacks."""
    pending: Restart | None = None
    """What will be signalled after STOP; nothing when people have to decide."""
    set_piece: SetPiece | None = None
    """The restart that was started last, until nothing of it binds anybody."""
    participation: Participation = Participation()
    shoot_out: ShootOut | None = None
    proposal: Proposal | None = None
    """Mixed officiating: what is decided unless people overrule it."""
    before: "RefereeState | None" = None
    """The state before the last decision, for `undo`."""
    still: float = 0.0
    """How long the ball in play has not moved."""
    ball: tuple[float, float, float] | None = None
    """Where the ball's centre was at the last tick."""
    evidence: Evidence = NO_EVIDENCE
    """What was seen since START."""

    @property
    def last_touch(self) -> str | None:
        """The robot that last touched the ball since START."""
        touch = self.evidence.play.last
        return touch.robot if touch is not None else None

    @property
    def clock(self) -> float:
        """Playing time of this half and those before it."""
        return self.timing.clock

    @property
    def restart(self) -> Restart | None:
        """The restart that is signalled and not yet in play, or nothing."""
        return Restart(self.phase, self.side, self.spot) if self.spot is not None else None

    def attack(self, side: Side) -> int:
        """Sign of the x direction that a side attacks."""
        return side.attack(self.cyan_attacks)

    def game_state(self, tick: int, time: float, episode: int = 1) -> GameState:
        """The state as it is published, at that tick and simulated time in s, of that episode."""
        participation = self.participation
        return GameState(
            tick=tick,
            time=time,
            phase=self.phase,
            side=self.side,
            running=self.running,
            half=self.half,
            stage=self.stage,
            clock=self.clock,
            effective=self.timing.effective,
            score=self.score,
            shoot_out=None if self.shoot_out is None else self.shoot_out.goals,
            cyan_attacks=self.cyan_attacks,
            spot=point(self.spot),
            left=self.timing.left,
            robots=participation.disciplinary_records(sorted({*participation.cards, *participation.absences})),
            proposal=None if self.proposal is None else self.proposal.text,
            episode=episode,
        )


def point(spot: Spot | None) -> Point | None:
    """A spot as it is published."""
    return None if spot is None else Point(x=spot[0], y=spot[1])
