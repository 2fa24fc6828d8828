"""Limits of the rules in play for one robot, which are infinite or off where the rule book has none.

Uses only what a robot knows: its own catches and distances exactly, possession from what it sees.
"""

import math
from typing import NamedTuple

from robot_agent.sdk.bodies import Body
from robot_agent.sdk.world_model import WorldBelief
from robot_agent.soccer.skills.take_ball import HAS_IT
from schemas.frames import Point
from schemas.messages.setup import Setup
from schemas.soccer.game import TeamPhase

SHORT_STAY = 2.0
"""s; a shorter time is too short to leave an area."""
HALFWAY = 0.25
"""m beyond the halfway line, where the ball is in the other half in spite of noise."""
GOES_BACK = -0.05
"""m/s along the kick axis; a lower speed is driving backward."""
PAUSE = 0.4
"""s; after a longer interruption, others have touched the ball."""
_ROLL_MARGIN = 0.3
"""m added to the rule book's free roll, for noise."""


class RuleLimits(NamedTuple):
    """The limits of the rule book."""

    circle: float
    """m; how far the ball may be dribbled from where it was caught."""
    backward: float
    """m; how far a robot may drive backward with the ball more than once."""
    keeps_out: bool
    """Only the goalkeeper may enter a goal area."""
    area_robots: float
    """Field robots of a side that may be in a penalty area at the same time."""
    at_once: bool
    """One more robot there is a foul at once, or nearly so."""
    stay: float
    """s; how long one robot may be there."""
    passes_first: bool
    """A ball won in the own half has to be passed in the other half before a goal counts."""
    roll: float
    """m of free roll that count as a pass."""
    spares_opponents: bool = False
    """A robot without the ball must not drive into an opponent at speed."""
    released: float = 0.0
    """m between the centres of robot and ball, from where the ball is visibly released."""

    @property
    def counts_ways(self) -> bool:
        """Whether any distance with the ball is limited."""
        return math.isfinite(self.circle) or math.isfinite(self.backward)

    @classmethod
    def of(cls, setup: Setup) -> "RuleLimits":
        """The limits of a match."""
        fouls, handling, scoring, areas = setup.fouls, setup.handling, setup.scoring, setup.areas
        return cls(
            circle=handling.circle if fouls.dribble_circle != "off" else math.inf,
            backward=handling.backward_once if fouls.backward != "off" else math.inf,
            keeps_out=fouls.goal_area != "off",
            area_robots=areas.penalty_area_robots if fouls.penalty_area != "off" else math.inf,
            at_once=areas.penalty_area_duration < SHORT_STAY,
            stay=areas.penalty_area_stay if areas.penalty_area_stay else math.inf,
            passes_first=fouls.own_half_goal != "off",
            roll=scoring.pass_roll,
            spares_opponents=fouls.charging != "off",
            released=setup.robot.radius + setup.ball.radius + handling.release_gap,
        )


class Carry(NamedTuple):
    """The ball in this robot's hold."""

    caught: Point
    """m; where the ball was when it was caught."""
    way: float = 0.0
    """m from there to where it is."""
    backward: float = 0.0
    """m driven backward with it."""
    paused: float = 0.0
    """s without the ball in the dribbler, which may still be the same dribble."""


def carry_after(before: Carry | None, belief: WorldBelief, released: float) -> Carry | None:
    """The carry after one more sight; None without the ball.

    A hold that is interrupted for a moment is the same dribble, until the ball is `released` m from the robot.
    """
    if belief.ball is None:
        return None
    ball = belief.ball.now[:2]
    if not belief.holding:
        paused = before.paused + belief.dt if before is not None else math.inf
        is_near = math.dist(belief.me[:2], ball) < released
        return before._replace(paused=paused) if before is not None and is_near and paused < PAUSE else None
    if before is None:
        return Carry(ball)
    along = _along(belief.me)
    back = -along * belief.dt if along < GOES_BACK else 0.0
    return Carry(before.caught, math.dist(before.caught, ball), before.backward + back)


class Possession(NamedTuple):
    """Which side has the ball, as far as one robot can tell."""

    ours: bool | None = None
    won_ahead: bool = False
    """Our side won the ball in the other half."""
    received: bool = False
    """Since then one of our robots has received a pass there."""
    holder: str | None = None
    """The robot of our side that had the ball last."""
    left: Point = (0.0, 0.0)
    """m; where the ball was at that time."""

    @property
    def may_score(self) -> bool:
        """Whether a goal from the ball's place would count."""
        return self.left[0] > HALFWAY and (self.won_ahead or self.received)


def possession_after(before: Possession, belief: WorldBelief, name: str, roll: float) -> Possession:
    """Possession after one more sight; a roll of `roll` m counts as a pass."""
    if belief.ball is None:
        return before
    ball, phase = belief.ball.now[:2], belief.game.phase
    if phase is not TeamPhase.PLAY and (phase.ours or phase.theirs):
        return Possession(phase.ours, ball[0] > HALFWAY, holder=None, left=ball)
    ours = _nearest_of_us(belief, ball, name)
    theirs = min([math.dist(ball, opponent) for opponent in belief.opponents], default=math.inf) < HAS_IT
    if ours is None:
        return before._replace(ours=False, holder=None) if theirs else before
    if theirs and not belief.holding:
        return before
    if not before.ours:
        return Possession(True, ball[0] > HALFWAY, holder=ours, left=ball)
    passed = before.holder not in (None, ours) and math.dist(before.left, ball) > roll + _ROLL_MARGIN
    received = before.received or (passed and ball[0] > HALFWAY)
    return before._replace(received=received, holder=ours, left=ball)


def _nearest_of_us(belief: WorldBelief, ball: Point, name: str) -> str | None:
    """The robot of our side that has the ball; None where none has."""
    if belief.holding:
        return name
    bodies = [(belief.me, name), *[(mate.body, other) for other, mate in belief.mates.items()]]
    have_it = [(away, one) for body, one in bodies if (away := math.dist(ball, body[:2])) < HAS_IT]
    return min(have_it)[1] if have_it else None


def _along(me: Body) -> float:
    """m/s along the kick axis."""
    return me.vx * math.cos(me.heading) + me.vy * math.sin(me.heading)
