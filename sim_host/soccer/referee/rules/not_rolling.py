"""Ball holding: a robot that moves the ball must let it turn like a rolling ball.

It may keep the ball from turning for one second and 30 cm, and again after a pause. Otherwise the other side gets a
free kick.

Section: play, ball handling.
Measures: time and way for which a held ball moves faster than 0.1 m/s and has less than half the spin of a rolling
ball, as the engine reports it; both start again at zero after the rule book's pause.
Not judged: the depth of the ball in the hull, which the robot's model fixes; a ball at rest; a ball that an opponent is
also at, since the opponent may keep it from turning.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side where the ball is, or None."""
    dribble = situation.state.evidence.dribble
    if dribble is None or not dribble.slid:
        return None
    handling = situation.match.book.handling
    for measured, limit, unit in (
        (dribble.slid_way, handling.roll_distance, "m"),
        (dribble.slid, handling.roll_duration, "s"),
    ):
        if exceeds(measured, limit) and is_called(situation, "not_rolling"):
            text = f"{dribble.robot} moved the ball {measured:.2f} {unit} without letting it roll, limit {limit:.2f}"
            return foul(situation, "not_rolling", (dribble.robot,), text, (measured, limit, unit))
    return None
