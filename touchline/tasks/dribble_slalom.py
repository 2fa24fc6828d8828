"""Dribbling through a slalom: gates passed, there and back again. Its score, and a robot to start from."""

import math

from touchline import Action, Briefing, CoachOrder, Drive, Moment, Player, Score, WorldBelief, skills

POLES = (-5.0, -2.5, 0.0, 2.5, 5.0)
"""m; x of the poles. Their y is near 0."""
COURSE = (*POLES, *reversed(POLES))
"""m; x of the pole beside each gate of a round. The even gates are at +y of their poles, the others at -y."""
WIDTH = 1.5
"""m from the pole to the other end of a gate."""
MIDDLE = 0.75
"""m from the pole, where the dribbler passes a gate."""
BEYOND = 0.6
"""m along x from a gate to the places before and behind it."""
CLEAR = 0.5
"""m between the dribbler's centre and a pole."""
AWAY = 0.7
"""m by which a pole may be seen away from the middle of its line."""


def gate_of(count: int) -> tuple[float, int, int]:
    """The gate after `count` gates: x of its pole in m, 1 if it is passed along +x or -1, 1 if it is at +y or -1."""
    gate = count % len(COURSE)
    return COURSE[gate], 1 if gate < len(POLES) else -1, -1 if gate % 2 else 1


def is_passed(count: int, before: float, ball: tuple[float, float], pole: float) -> bool:
    """Whether the ball rolls through the gate after `count` gates, from x `before`; `pole` is the y of its pole."""
    x, ahead, side = gate_of(count)
    return ahead * (before - x) < 0.0 <= ahead * (ball[0] - x) and 0.0 < side * (ball[1] - pole) < WIDTH


def passed(now: Moment) -> Score:
    """Gates that the ball has passed in order, round after round; over when the referee stops play."""
    assert now.ball is not None
    count, before = now.memory or (0, now.ball.x)
    x, _, _ = gate_of(count)
    pole = min(now.obstacles.values(), key=lambda one: abs(one.x - x))
    count += is_passed(count, before, now.ball[:2], pole.y)
    return Score(count, over=now.game.phase != "play", memory=(count, now.ball.x))


class Dribbler(Player):
    """Carries the ball to a place behind each gate, past its pole, and gets the ball where it loses it."""

    plays_alone = True

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.last = Drive()
        """The drive of the tick before."""
        self.count = 0
        """Gates passed."""
        self.before: float | None = None
        """m; x of the ball in the tick before."""

    def restart(self) -> None:
        """Begin the course anew."""
        super().restart()
        self.last, self.count, self.before = Drive(), 0, None

    def play(self, belief: WorldBelief, _order: CoachOrder | None) -> Action:
        """Dribble to the next gate, or get the ball."""
        if belief.ball is None:
            return Action("", "wait", Drive())
        me, ball, gap = belief.me, belief.ball.now, self.setup.dribble.gap
        pole = self.pole(belief)
        if self.before is not None and is_passed(self.count, self.before, ball[:2], pole[1]):
            self.count += 1
            pole = self.pole(belief)
        self.before = ball.x
        if belief.holding:
            x, y = self.target(ball[:2], pole)
            blocked = skills.circles(belief.opponents, CLEAR)
            drive = skills.dribble_to(me, x, y, math.atan2(y - me.y, x - me.x), blocked, self.limits)
            self.last = skills.keep_hold(me, drive, self.last, belief.dt, self.setup)
        else:
            meeting = skills.meet(me, skills.way_of(ball, self.rolling), gap, self.limits)
            self.last = skills.take_ball(me, ball, meeting, gap, belief.opponents, CLEAR, self.limits)
        return Action("dribbler", "slalom", self.last, dribble=True)

    def pole(self, belief: WorldBelief) -> tuple[float, float]:
        """The pole of the next gate, where it is seen."""
        line = gate_of(self.count)[0], 0.0
        seen = min(belief.opponents, key=lambda one: math.dist(one, line), default=line)
        return seen if math.dist(seen, line) < AWAY else line

    def target(self, ball: tuple[float, float], pole: tuple[float, float]) -> tuple[float, float]:
        """A place behind the gate; one before it where the ball is not in front of the gate."""
        _, ahead, side = gate_of(self.count)
        left, beside = ahead * (pole[0] - ball[0]), side * (ball[1] - pole[1])
        is_before = left > BEYOND or (left > 0.0 and beside > 0.0)
        return pole[0] + (ahead if is_before else -ahead) * BEYOND, pole[1] + side * MIDDLE
