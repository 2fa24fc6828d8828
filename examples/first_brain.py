"""A first brain: get the ball, carry it toward the goal, shoot beside the keeper."""

import math

from robot_agent.bodies import DriveLimits
from robot_agent.contract import Briefing
from robot_agent.skills.dribble_to import dribble_to
from robot_agent.skills.go_to import go_to
from robot_agent.skills.kick_at import kick_at
from robot_agent.skills.shoot import best_place
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight


class FirstBrain:
    def __init__(self, briefing: Briefing) -> None:
        self.pitch, self.limits = briefing.setup.pitch, DriveLimits.of(briefing.setup)

    def act(self, sight: Sight) -> Command:
        me, goal = sight.self, self.pitch.goal_line
        ball = sight.ball or sight.game.spot  # before it is seen, where the referee has put it
        drive, kick = Drive(), None
        if sight.holding and me.x > goal - 5.0:
            aim, _ = best_place((me.x, me.y), [(other.x, other.y) for other in sight.obstacles], self.pitch)
            drive, kick = kick_at(me, (goal, aim), 8.0, 0.2, self.limits)
        elif sight.holding:
            drive = dribble_to(me, goal, 0.0, 0.0, [], self.limits)
        elif ball and sight.game.running and not sight.game.phase.theirs:
            drive = go_to(me, ball.x, ball.y, math.atan2(ball.y - me.y, ball.x - me.x), self.limits)
        return Command(answers_tick=sight.tick, drive=drive, dribble=True, kick=kick)
