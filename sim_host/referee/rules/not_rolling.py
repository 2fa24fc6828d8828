"""Ball holding: a robot that moves the ball lets it turn as a rolling ball does.

It may be kept from turning for a second and 30 cm, and after a wait again. The other side gets a free kick.

Section: play, ball handling.
Measures: time and way for which a ball in the hold moves faster than 0.1 m/s and turns at less than half the natural
rate, by the spin that the engine gives it; both begin anew after the rule book's wait.
Not judged: how deep the ball lies in the hull, which the robot's model fixes; a ball that stands still; a ball
that an opponent is at, too, which he may keep from turning.
"""

from sim_host.referee.game.decision import Decision
from sim_host.referee.rules.foul import exceeds, foul, is_called
from sim_host.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side where the ball is, or nothing."""
    dribble = situation.state.evidence.dribble
    if dribble is None or not dribble.slid:
        return None
    handling, ball = situation.match.book.handling, situation.snapshot.ball
    place = (ball.x, ball.y)
    for measured, limit, unit in (
        (dribble.slid_way, handling.roll_distance, "m"),
        (dribble.slid, handling.roll_duration, "s"),
    ):
        if exceeds(measured, limit) and is_called(situation, "not_rolling"):
            text = f"{dribble.robot} moved the ball {measured:.2f} {unit} without letting it roll, limit {limit:.2f}"
            return foul(
                situation, "not_rolling", (dribble.robot,), text, measured=measured, limit=limit, unit=unit, place=place
            )
    return None
