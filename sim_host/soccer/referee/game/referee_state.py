"""The state of the referee between two ticks, which is its whole memory."""

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from schemas.messages.soccer.game import GameState
from schemas.natural_order import natural_order
from schemas.side import Side
from schemas.soccer.game import GameStage, Phase, Point, Score
from sim_host.soccer.referee.evidence import NO_EVIDENCE, Evidence
from sim_host.soccer.referee.game.advantage import Advantage
from sim_host.soccer.referee.game.decision import Proposal
from sim_host.soccer.referee.game.participation import Absence, Participation
from sim_host.soccer.referee.game.question import Question
from sim_host.soccer.referee.game.restart import Restart, Spot
from sim_host.soccer.referee.game.set_piece import SetPiece
from sim_host.soccer.referee.game.shoot_out import ShootOut
from sim_host.soccer.referee.game.timing import Timing


class RefereeState(NamedTuple):
    """The game as the referee remembers it; times in s, places in m in the field frame."""

    phase: Phase
    timing: Timing
    kick_off: Side
    """The side that kicks off this half."""
    side: Side | None = None
    """The side that takes the signalled restart."""
    spot: Spot | None = None
    """The spot of the signalled restart."""
    running: bool = False
    """START was given."""
    half: int = 1
    """Number of the half, counted through extra time."""
    stage: GameStage = GameStage.REGULAR
    score: Score = Score()
    cyan_attacks: int = 1
    """Sign of the x direction that cyan attacks."""
    pending: Restart | None = None
    """The restart to signal after STOP; None if people have to decide."""
    set_piece: SetPiece | None = None
    """The last started restart, as long as its rules restrict any robot."""
    participation: Participation = Participation()
    shoot_out: ShootOut | None = None
    proposal: Proposal | None = None
    """In mixed officiating, the decision that people may overrule."""
    history: "tuple[RefereeState, ...]" = ()
    """The states before the last decisions of this half, the newest last, each without a history of its own: for
    `undo`."""
    still: float = 0.0
    """s for which the ball in play has not moved."""
    ball: tuple[float, float, float] | None = None
    """Position of the ball's centre at the last tick."""
    evidence: Evidence = NO_EVIDENCE
    """The evidence since START."""
    refbox_gone: float | None = None
    """s since the referee box that officiates has gone; 0 while it is connected, None where none officiates."""
    questions: tuple[Question, ...] = ()
    """Actions that wait for a side to name its robot."""
    offender: str | None = None
    """The robot that committed the last foul that the referee saw."""
    advantage: Advantage | None = None
    """The foul after which play goes on."""

    @property
    def over(self) -> bool:
        """Whether the match has been played to its end."""
        return self.phase is Phase.FULL_TIME

    @property
    def absences(self) -> Mapping[str, Absence]:
        """Robots off the field."""
        return self.participation.absences

    @property
    def change_key(self) -> tuple[Any, ...]:
        """What of the state is published as soon as it changes."""
        return (
            self.phase,
            self.side,
            self.running,
            self.half,
            self.score,
            self.cyan_attacks,
            self.spot,
            self.participation.change_key,
            self.shoot_out,
            self.proposal is None,
            self.refbox_gone is None,
            len(self.questions),
        )

    @property
    def refbox_decides(self) -> bool:
        """Whether a league's referee box alone ends halves, breaks and the match."""
        return self.refbox_gone is not None

    @property
    def last_touch(self) -> str | None:
        """The robot that last touched the ball since START."""
        touch = self.evidence.play.last
        return touch.robot if touch is not None else None

    @property
    def level_touches(self) -> tuple[str, ...]:
        """Robots of both sides that last touched the ball at the same time; empty if one of them was the last."""
        return self.evidence.play.level

    @property
    def clock(self) -> float:
        """Playing time of this half and those before it."""
        return self.timing.clock

    @property
    def restart(self) -> Restart | None:
        """The restart that is signalled and not yet in play, or None."""
        return Restart(self.phase, self.side, self.spot) if self.spot is not None else None

    def after_layout_change(self, names: Collection[str]) -> "RefereeState":
        """The state after an operator has moved bodies, or left these robots on the field.

        A body that was placed did not run or dribble there: what was seen before proves nothing. An advantage ends,
        and decisions on robots that are gone are dropped.
        """
        participation, noted, proposal = self.participation, self.advantage, self.proposal
        if noted is not None and noted.decision.card is not None and noted.decision.robot is not None:
            participation = participation.with_owed_card(noted.decision.robot, noted.rule, noted.decision.card)
        is_void = proposal is not None and proposal.decision.robot not in (None, *names)
        return self._replace(
            participation=participation.of_robots(names),
            evidence=NO_EVIDENCE,
            set_piece=None if self.set_piece is None else self.set_piece._replace(intrusions=None),
            advantage=None,
            proposal=None if is_void else proposal,
        )

    def attack(self, side: Side) -> int:
        """Sign of the x direction that a side attacks."""
        return side.attack(self.cyan_attacks)

    def game_state(self, tick: int, time: float, episode: int = 1) -> GameState:
        """The published state of the game at this tick and simulated time in s, in this episode."""
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
            robots=participation.disciplinary_records(
                sorted({*participation.cards, *participation.absences}, key=natural_order)
            ),
            proposal=None if self.proposal is None else self.proposal.text,
            episode=episode,
            refbox=self.refbox_gone is not None,
            questions=[question.published() for question in self.questions],
        )


def point(spot: Spot | None) -> Point | None:
    """A spot as a published point."""
    return None if spot is None else Point(x=spot[0], y=spot[1])
