"""Messages about the game: its state, its events, and the requests to the referee."""

from collections.abc import Collection
from typing import Annotated, Self

from msgspec import Meta

from schemas.side import Side
from schemas.soccer.game import ActionName, Card, EventKind, GameStage, OffField, Phase, Point, Score, TeamPhase
from schemas.wire.message import Message, Name, Source
from schemas.wire.part import Part
from schemas.wire.units import Seconds


class DisciplinaryRecord(Part):
    """The cards of one robot, and whether it is off the field."""

    yellow: Annotated[int, Meta(ge=0)] = 0
    """Yellow cards that count toward the next punishment."""
    red: Annotated[int, Meta(ge=0)] = 0
    """Red cards."""
    off_field: OffField | None = None
    """Why the robot does not take part; None while it does."""
    left: Seconds | None = None
    """Time until the robot may return, at the next stoppage, in s; None on the field, and where it may not return."""


class RobotQuestion(Part):
    """An action for a robot of a side that names no robot: the side's coach names it with the action `name_robot`."""

    action: ActionName
    """The action that waits for its robot."""
    side: Side
    """The side whose robot it concerns, and whose coach may answer."""
    left: float
    """Time to answer in s; then `default` is taken."""
    robots: list[Name]
    """The robots that the action was allowed for when the question was opened."""
    default: Name
    """The robot that is taken without an answer: the side's last offender, otherwise its highest number that is no
    goalkeeper."""


class GameState(Message):
    """The state of the game, in the field frame."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    phase: Phase
    """What is being played; a restart belongs to `side`."""
    side: Side | None = None
    """The side that takes the restart; None where no side does."""
    running: bool = False
    """START was given; before that, robots take their positions and may not play the ball."""
    half: Annotated[int, Meta(ge=1)] = 1
    """The half that is being played; counts on through extra time."""
    stage: GameStage = GameStage.REGULAR
    """Regular time, extra time, or the penalty shoot-out."""
    clock: float = 0.0
    """Game clock in s: playing time of this half and those before it."""
    effective: float = 0.0
    """Effective playing time in s: how long the ball has been in play."""
    score: Score = Score()
    """Goals without the penalty shoot-out's."""
    shoot_out: Score | None = None
    """Goals of the penalty shoot-out, during and after it; None without one."""
    cyan_attacks: Annotated[int, Meta(ge=-1, le=1)] = 1
    """Sign of the x direction that cyan attacks."""
    spot: Point | None = None
    """Where the ball is placed for the restart, in the field frame; None where the referee has set no spot."""
    left: float | None = None
    """Time in s until the limit of the current phase (START, ball in play, end of a break or of a shoot-out's attempt);
    None without one."""
    robots: dict[Name, DisciplinaryRecord] = {}
    """Robot → its cards, and why it is off the field; robots without either are left out."""
    proposal: str | None = None
    """Mixed officiating: what the referee has proposed and not yet carried out; None without a proposal."""
    episode: int = 1
    """Counts the starts of the world: the match's own, each scene that is loaded, each reset."""
    refbox: bool = False
    """A league's referee box officiates: it alone ends halves, breaks and the match, not the clock. Remains true until
    the box has been gone for 10 s of simulated time."""
    questions: list[RobotQuestion] = []
    """Actions that wait for a side to name its robot; of two questions to one side, the first is answered first."""
    value: float | None = None
    """Score of a game without goals, in the unit that its setup names; None in soccer."""


class GameView(Part):
    """The state of the game from one team's point of view."""

    phase: TeamPhase
    """What is being played, and whose restart it is."""
    running: bool
    """START was given; before that, robots take their positions and may not play the ball."""
    half: int = 1
    """The half that is being played; counts on through extra time."""
    clock: Seconds
    """Game clock in s: playing time of this half and those before it."""
    our_score: int
    """Our goals, without the penalty shoot-out's."""
    their_score: int
    """Their goals, without the penalty shoot-out's."""
    spot: Point | None = None
    """Where the ball is placed for the restart, in the team frame; None where the referee has set no spot."""
    stage: GameStage = GameStage.REGULAR
    """Regular time, extra time, or the penalty shoot-out."""
    left: Seconds | None = None
    """Time in s until the limit of the current phase (START, ball in play, end of a break or of a shoot-out's attempt);
    None without one."""
    robots: dict[Name, DisciplinaryRecord] = {}
    """Our robot → its cards, and why it is off the field; robots without either are left out."""
    episode: int = 1
    """Counts the starts of the world. When the number changes, the world was set up anew, and earlier beliefs are
    void."""

    @classmethod
    def of(cls, state: GameState, side: Side, robots: Collection[str]) -> Self:
        """The state from the point of view of a side, whose robots are given."""
        score, attack, spot = state.score, side.attack(state.cyan_attacks), state.spot
        return cls(
            phase=TeamPhase.of(state.phase, state.side, side),
            running=state.running,
            half=state.half,
            clock=state.clock,
            our_score=score.of(side),
            their_score=score.of(side.opponent),
            spot=Point(x=attack * spot.x, y=attack * spot.y) if spot is not None else None,
            stage=state.stage,
            left=state.left,
            robots={name: record for name, record in state.robots.items() if name in robots},
            episode=state.episode,
        )


class GameEvent(Message):
    """Something that happened, with its rule, place, robots and measured quantity."""

    tick: int
    """Control ticks since the match began."""
    time: float
    """Simulated time in s: tick × control tick."""
    clock: float
    """Game clock in s."""
    kind: EventKind
    """What happened."""
    rule: str
    """Name of the rule or action that caused it."""
    side: Side | None = None
    """The side that it concerns; None where it concerns neither or both."""
    robot: Name | None = None
    """The robot that caused it: the scorer, the last to touch the ball, the offender."""
    robots: list[Name] = []
    """All robots that it concerns, where there is more than one."""
    place: Point | None = None
    """Where it happened, in the field frame; None where it has no place."""
    score: Score | None = None
    """The score after it; None where the score did not change."""
    measured: float | None = None
    """The measured quantity, in `unit`; None where the rule measures none."""
    limit: float | None = None
    """The limit that the rule sets for it, in `unit`; None where the rule measures none."""
    unit: str = ""
    """Unit of `measured` and `limit`; empty without them."""
    card: Card | None = None
    """The card that was shown; None without one."""
    text: str
    """One sentence for display, with the measured quantity where there is one."""


class RefereeAction(Message):
    """A request to the referee; accepted, or refused with the reason."""

    action: ActionName
    """The requested action."""
    side: Side | None = None
    """The side that it concerns; None for actions without a side."""
    robot: Name | None = None
    """The scorer of a goal; the robot that a card, a repair, a substitution or an entry concerns. Such an action with a
    side in place of a robot asks the side's coach which robot it concerns."""
    place: Point | None = None
    """Place of the action in the field frame, from which a restart takes its spot; by default where the ball lies."""
    source: Source = "coach"
    """Name of the sender, for display."""
    referee: Name | None = None
    """Name of the referee that sends it, which no other referee has; None for a sender without a name.
    One referee officiates at a time."""


class ActionReply(Message):
    """The referee's reply to an action."""

    accepted: bool
    """The action was carried out."""
    reason: str = ""
    """Why it was refused; empty where it was accepted."""
    tick: int | None = None
    """Tick in which the referee judged the action; the state of that tick is published before the reply. None where
    the request did not reach the referee."""
