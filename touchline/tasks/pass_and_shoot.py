"""Pass and shoot: a goal of two robots that counts only after a pass. Its score, and robots to start from."""

import math

from touchline import Action, CoachOrder, Drive, Moment, Player, Score, WorldBelief, skills

NEARER = 0.05
"""Reward for each metre that the ball comes nearer to its receiver, and after the pass to the goal."""
PASSED = 0.5
"""Reward for the pass."""
SHOT_ERROR = 0.15
"""m beside the target, at most."""
OPEN = 0.8
"""m of free lane into the goal, with which the striker shoots."""
NEAR = 4.0
"""m from the goal line, where it shoots in any case."""
SLOW = 0.5
"""m/s; a faster ball is on its way to the striker."""
CLEAR = 0.7
"""m between the centres of two robots that pass each other."""


def scored(now: Moment) -> Score:
    """1 for a goal after a pass, otherwise 0; over with any goal, when the goalkeeper has the ball or play stops.

    The reward leads a learner to a goal, which random actions hardly ever score.
    """
    assert now.ball is not None
    last, passed, before = now.memory or ("cyan1", False, None)
    for robot in now.touches:
        if now.sides[robot] == "cyan":
            last, passed = robot, passed or robot != last
    receiver = now.robots["cyan1" if last == "cyan2" else "cyan2"]
    target = (now.pitch.goal_line, 0.0) if passed else receiver[:2]
    ahead = PASSED * passed - NEARER * math.dist(now.ball[:2], target)
    goals = float(passed and now.game.score.cyan)
    over = now.game.phase != "play" or (now.holder is not None and now.sides[now.holder] != "cyan")
    reward = goals + ahead - (ahead if before is None else before)
    return Score(goals, over, reward, memory=(last, passed, ahead))


class Attacker(Player):
    """The first robot passes; the second takes the ball, carries it to where the goal is open, and shoots."""

    def play(self, belief: WorldBelief, _order: CoachOrder | None) -> Action:
        """Get the ball, then pass or shoot."""
        if belief.ball is None:
            return Action("", "wait", Drive())
        if not belief.holding:
            return self.get_ball(belief)
        if self.briefing.number == 2:
            return self.shoot(belief)
        for name, mate in belief.mates.items():
            drive, kick = skills.pass_to(belief.me, mate.body[:2], self.setup, self.limits)
            return Action("passer", "pass", drive, dribble=True, kick=kick, pass_to=name if kick else None)
        return Action("passer", "hold", Drive(), dribble=True)

    def get_ball(self, belief: WorldBelief) -> Action:
        """Meet the ball; the passer only where it lies nearer than the other."""
        assert belief.ball is not None
        me, ball, gap = belief.me, belief.ball.now, self.setup.dribble.gap
        away = min((math.dist(mate.body[:2], ball[:2]) for mate in belief.mates.values()), default=math.inf)
        if self.briefing.number == 1 and (away < math.dist(me[:2], ball[:2]) or math.hypot(ball.vx, ball.vy) > SLOW):
            return Action("passer", "wait", Drive())
        meeting = skills.meet(me, skills.way_of(ball, self.rolling), gap, self.limits)
        drive = skills.take_ball(me, ball, meeting, gap, belief.opponents, CLEAR, self.limits)
        return Action("striker", "get the ball", drive, dribble=True)

    def shoot(self, belief: WorldBelief) -> Action:
        """Shoot where the goal is open; carry the ball nearer to it where it is not."""
        pitch, me = self.setup.pitch, belief.me
        y, width = skills.best_place(me[:2], belief.opponents, pitch)
        if width > OPEN or pitch.goal_line - me.x < NEAR:
            speed = self.setup.kicker.max_ground_speed
            drive, kick = skills.kick_at(me, (pitch.goal_line, y), speed, SHOT_ERROR, self.limits)
            return Action("striker", "shoot", drive, dribble=True, kick=kick)
        facing = math.atan2(y - me.y, pitch.goal_line - me.x)
        drive = skills.dribble_to(me, pitch.goal_line - 0.8 * NEAR, 0.5 * me.y, facing, [], self.limits)
        return Action("striker", "carry", drive, dribble=True)
