"""Long hold: a robot may not keep the ball for longer than the rule book allows. The other side gets a free kick.

Section: China simulation league 2020, yellow cards; the rule book of the Middle Size League has no such limit.
Measures: the time since the ball was caught, as long as it was not visibly released.
Not judged: whether the robot could have played it.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side where the ball is, or None."""
    dribble = situation.state.evidence.dribble
    if dribble is None or situation.snapshot.possession != dribble.robot:
        return None
    limit = situation.match.book.handling.hold_duration
    kept = situation.snapshot.time - dribble.since
    if not exceeds(kept, limit) or not is_called(situation, "long_hold"):
        return None
    text = f"{dribble.robot} kept the ball for {kept:.1f} s, limit {limit:.1f}"
    return foul(situation, "long_hold", (dribble.robot,), text, (kept, limit, "s"))
