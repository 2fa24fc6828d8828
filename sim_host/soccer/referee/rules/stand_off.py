"""Stand-off: the ball is dropped when two opponents have leaned on each other for a long time.

Section: play, pushing: stand-off.
Measures: the time for which the engine has reported the two in contact, with gaps shorter than 0.2 s.
Not judged: which of them began.
"""

from sim_host.soccer.referee.evidence.pushes import Push
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.offence_order import worst_first
from sim_host.soccer.referee.rules.out import dropped
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A drop ball where the ball is, in a penalty area at the nearest restart spot outside it, or None."""
    limit = situation.match.book.contact.stand_off_duration
    pushes = situation.state.evidence.pushes
    for push in worst_first(situation, pushes, lambda push: push.lasted, lambda push: _nearer_to_ball(situation, push)):
        if push.lasted < limit:
            continue
        names = situation.match.roster.names
        robots = (names[push.first], names[push.second])
        text = f"stand-off: {' and '.join(robots)} leaned on each other for {push.lasted:.1f} s, limit {limit:.1f}"
        return dropped(situation, text, (push.lasted, limit, "s"), robots=robots)
    return None


def _nearer_to_ball(situation: Situation, push: Push) -> int:
    """The robot of the two that is nearer to the ball."""
    robots, ball = situation.snapshot.robots, situation.snapshot.ball
    return min(
        (push.first, push.second), key=lambda index: (robots[index].x - ball.x) ** 2 + (robots[index].y - ball.y) ** 2
    )
