"""Charging: a robot that drives into an opponent at speed.

The offender is the robot that drove faster toward the other by its own drive. For a second after another robot has hit
it, a robot is not responsible for more speed than its drive can have gained since, nor while an opponent pushes it; if
a teammate hit it, the teammate is the offender. Two robots that drive into each other nearly equally fast commit no
foul. A robot that plays the ball commits none either: the ball is within its reach, on the side on which it drives into
the opponent. Robots side by side approach each other slowly, however fast they drive. The other side gets a free kick,
or a penalty if the offender is in its own penalty area. An offender that drove fast is shown a yellow card, too.

Section: play, charging.
Measures: the velocities of both robots before the impact, along the normal of their contact, as the engine reports it.
Not judged: intent, and the harm done; hulls that strike because they turn.
"""

from typing import NamedTuple

from schemas.soccer.game import Card, Phase
from sim_host.snapshot import Impact
from sim_host.soccer.referee.areas import in_penalty_area
from sim_host.soccer.referee.evidence.shoves import own_speed
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation

_PUSHED = 0.05
"""m; a robot that an opponent has pushed this far does not drive by itself."""


class Charge(NamedTuple):
    """Who is responsible for an impact; robots by their indices in the roster."""

    offender: int
    driven: int
    """The robot that hit the victim: the offender, or the teammate that it drove into the victim."""
    victim: int
    direction: tuple[float, float]
    """Unit vector from the robot that hit to the victim."""
    speed: float
    """m/s at which they approached each other."""
    driven_speed: float
    """m/s of it that the offender drove."""


def judge(situation: Situation) -> Decision | None:
    """A free kick or a penalty for the other side, or None."""
    if not is_called(situation, "charging"):
        return None
    charges = [
        charge
        for impact in situation.snapshot.impacts
        if (charge := _charge(situation, impact)) is not None and not _plays_ball(situation, charge)
    ]
    if not charges:
        return None
    return _decision(situation, worst_first(situation, charges, lambda one: one.speed, lambda one: one.offender)[0])


def _charge(situation: Situation, impact: Impact) -> Charge | None:
    """The charge that an impact is, or None."""
    roster, numbers = situation.match.roster, situation.match.book.contact
    if roster.sides[impact.first] is roster.sides[impact.second]:
        return None
    if not exceeds(impact.closing_speed, numbers.charge_speed):
        return None
    shoves = situation.state.evidence.shoves
    (x, y), back = impact.direction, (-impact.direction[0], -impact.direction[1])
    one, one_cause = own_speed(situation.match, shoves, impact.first, impact.first_velocity, (x, y))
    other, other_cause = own_speed(situation.match, shoves, impact.second, impact.second_velocity, back)
    if _is_pushed(situation, impact.first):
        one = min(one, 0.0)
    if _is_pushed(situation, impact.second):
        other = min(other, 0.0)
    if exceeds(one + other, numbers.charge_speed):
        if abs(one - other) < numbers.charge_margin:
            return None
        if one > other:
            return Charge(impact.first, impact.first, impact.second, impact.direction, one + other, one)
        return Charge(impact.second, impact.second, impact.first, back, one + other, other)
    for robot, victim, cause, toward in (
        (impact.first, impact.second, one_cause, impact.direction),
        (impact.second, impact.first, other_cause, back),
    ):
        if cause is not None and roster.sides[cause.by] is roster.sides[robot] and cause.speed > numbers.charge_speed:
            return Charge(cause.by, robot, victim, toward, impact.closing_speed, cause.speed)
    return None


def _is_pushed(situation: Situation, robot: int) -> bool:
    """Whether an opponent pushes the robot along."""
    return any(
        (push.way > _PUSHED and push.second == robot) or (push.way < -_PUSHED and push.first == robot)
        for push in situation.state.evidence.pushes
    )


def _plays_ball(situation: Situation, charge: Charge) -> bool:
    """Whether the ball is within reach of the robot that hit, on the side of the victim."""
    match, ball = situation.match, situation.snapshot.ball
    robot = situation.snapshot.robots[charge.driven]
    x, y = ball.x - robot.x, ball.y - robot.y
    ahead = x * charge.direction[0] + y * charge.direction[1]
    reach = match.reaches[charge.driven] + match.ball.radius + match.book.contact.charge_ball
    on_ground = ball.z - match.ball.radius < match.roster.models[charge.driven].body.height
    return on_ground and ahead > 0.0 and x * x + y * y <= reach * reach


def _decision(situation: Situation, charge: Charge) -> Decision:
    roster, numbers = situation.match.roster, situation.match.book.contact
    side = roster.sides[charge.offender]
    robot = situation.snapshot.robots[charge.driven]
    inside = in_penalty_area(situation.match.pitch, -situation.state.attack(side), robot.x, robot.y)
    name, victim = roster.names[charge.offender], roster.names[charge.victim]
    deed = "drove into" if charge.driven == charge.offender else f"drove {roster.names[charge.driven]} into"
    text = (
        f"{name} {deed} {victim} at {charge.speed:.2f} m/s{' in its own penalty area' * inside}, "
        f"limit {numbers.charge_speed:.2f}; intent is not judged"
    )
    hard = numbers.charge_card_speed > 0.0 and exceeds(charge.driven_speed, numbers.charge_card_speed)
    return foul(
        situation,
        "charging",
        (name,),
        text,
        (charge.speed, numbers.charge_speed, "m/s"),
        (robot.x, robot.y),
        phase=Phase.PENALTY if inside else Phase.FREE_KICK,
        card=Card.YELLOW if hard else None,
    )
