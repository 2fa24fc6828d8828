"""The ruling of one tick while it is being made."""

from dataclasses import dataclass, field

from schemas.config.roster import Placement
from schemas.config.soccer.rule_book import RuleBook
from schemas.frames import Pose
from schemas.messages.soccer.game import GameEvent
from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Score
from sim_host.snapshot import BALL, Snapshot
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.referee_state import RefereeState, point
from sim_host.soccer.referee.game.restart import Spot
from sim_host.soccer.referee.match_constants import MatchConstants


@dataclass(slots=True)
class RulingDraft:
    """Collects state changes, events and placements of one tick, within one call of `Referee.step`."""

    match: MatchConstants
    snapshot: Snapshot
    state: RefereeState
    events: list[GameEvent] = field(default_factory=list)
    placements: list[Placement] = field(default_factory=list)
    checkpoint: bool = False

    def add_event(
        self,
        kind: EventKind,
        rule: str,
        text: str,
        *,
        side: Side | None = None,
        robot: str | None = None,
        robots: tuple[str, ...] = (),
        place: Spot | None = None,
        score: Score | None = None,
        measured: float | None = None,
        limit: float | None = None,
        unit: str = "",
        card: Card | None = None,
    ) -> None:
        """Add an event of this tick; `rule` is the module name of the rule or action that decided.

        `measured` is the quantity that broke the rule, and `limit` the bound that it allows or requires, in `unit`.
        """
        event = GameEvent(
            tick=self.snapshot.tick,
            time=self.snapshot.time,
            clock=self.state.clock,
            kind=kind,
            rule=rule,
            side=side,
            robot=robot,
            robots=list(robots),
            place=point(place),
            score=score,
            measured=None if measured is None else round(measured, 4),
            limit=limit,
            unit=unit,
            card=card,
            text=text,
        )
        self.events.append(event)

    def add_decision_event(
        self, kind: EventKind, rule: str, decision: Decision, text: str, score: Score | None = None
    ) -> None:
        """Add an event with all facts of a decision, which was made, proposed or noted."""
        self.add_event(
            kind,
            rule,
            text,
            side=decision.side,
            robot=decision.robot,
            robots=decision.robots,
            place=decision.place,
            score=score,
            measured=decision.measured,
            limit=decision.limit,
            unit=decision.unit,
            card=decision.card,
        )

    def place_ball(self, spot: Spot) -> None:
        """Place the ball at rest before the next tick."""
        self.placements.append(Placement(body=BALL, x=spot[0], y=spot[1]))

    @property
    def ball_spot(self) -> Spot:
        """Position of the ball: where it was placed in this tick, or where the snapshot has it."""
        down = [(placement.x, placement.y) for placement in self.placements if placement.body == BALL]
        return down[-1] if down else (self.snapshot.ball.x, self.snapshot.ball.y)

    @property
    def book(self) -> RuleBook:
        """The rule book of the match."""
        return self.match.book

    def place_robot(self, name: str, pose: Pose) -> None:
        """Place a robot at rest before the next tick."""
        self.placements.append(Placement(body=name, x=pose.x, y=pose.y, heading=pose.heading))
