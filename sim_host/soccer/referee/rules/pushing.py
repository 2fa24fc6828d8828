"""Pushing: a robot that leans on an opponent must not push it away.

The other side gets a free kick, or a penalty if the offender is in its own penalty area.

Section: play, pushing.
Measures: the way that both robots have moved along the line between their centres, toward the pushed robot, while the
engine reports them in contact.
Not judged: intent, and the right to the ball; the robot that moves the other is the offender.
"""

from schemas.soccer.game import Phase
from sim_host.soccer.referee.areas import in_penalty_area
from sim_host.soccer.referee.evidence.pushes import Push
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick or a penalty for the other side, or None."""
    limit = situation.match.book.contact.push_distance
    pushes = situation.state.evidence.pushes
    for push in worst_first(situation, pushes, lambda push: abs(push.way), _offender):
        if not exceeds(abs(push.way), limit) or not is_called(situation, "pushing"):
            continue
        roster, way = situation.match.roster, abs(push.way)
        offender = _offender(push)
        victim = push.second if offender == push.first else push.first
        robot = situation.snapshot.robots[offender]
        own_end = -situation.state.attack(roster.sides[offender])
        inside = in_penalty_area(situation.match.pitch, own_end, robot.x, robot.y)
        text = (
            f"{roster.names[offender]} pushed {roster.names[victim]} {way:.2f} m{' in its own penalty area' * inside}, "
            f"limit {limit:.2f}; intent is not judged"
        )
        phase, place = Phase.PENALTY if inside else Phase.FREE_KICK, (robot.x, robot.y)
        return foul(situation, "pushing", (roster.names[offender],), text, (way, limit, "m"), place, phase=phase)
    return None


def _offender(push: Push) -> int:
    """The robot that moves the other."""
    return push.first if push.way > 0 else push.second
