"""A goalkeeper against one shooter: whether the goal stays clean. A goalkeeper to start from, and the shooter."""

from touchline import Action, CoachOrder, Drive, Moment, Player, Score, WorldBelief, skills

SHOT_ERROR = 0.1
"""m beside the target, at most."""


def saved(now: Moment) -> Score:
    """1 until the shooter scores, then 0; over with a goal, when the goalkeeper has the ball or play stops."""
    caught = now.holder is not None and now.sides[now.holder] == "cyan"
    return Score(float(not now.game.score.magenta), over=caught or now.game.phase != "play")


class Goalkeeper(Player):
    """Stands on the goal line where it halves the angle of a shot, and moves to where one will pass."""

    def play(self, belief: WorldBelief, _order: CoachOrder | None) -> Action:
        """Keep the goal."""
        if belief.ball is None:
            return Action("keeper", "wait", Drive())
        drive = skills.keep_goal(belief.me, belief.ball.now, self.setup.pitch, self.setup.robot.radius, self.limits)
        return Action("keeper", "keep", drive, dribble=True)


class Shooter(Player):
    """Fetches the ball, and shoots where the goal is open."""

    plays_alone = True

    def play(self, belief: WorldBelief, _order: CoachOrder | None) -> Action:
        """Fetch the ball or shoot."""
        if belief.ball is None:
            return Action("", "wait", Drive())
        me, ball, gap, pitch = belief.me, belief.ball.now, self.setup.dribble.gap, self.setup.pitch
        if not belief.holding:
            meeting = skills.meet(me, skills.way_of(ball, self.rolling), gap, self.limits)
            return Action("", "fetch", skills.take_ball(me, ball, meeting, gap, [], 0.0, self.limits), dribble=True)
        y, _ = skills.best_place(ball[:2], belief.opponents, pitch)
        speed = self.setup.kicker.max_ground_speed
        drive, kick = skills.kick_at(me, (pitch.goal_line, y), speed, SHOT_ERROR, self.limits)
        return Action("", "shoot", drive, dribble=True, kick=kick)
