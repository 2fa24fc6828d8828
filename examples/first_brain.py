"""A first brain: get the ball, carry it toward the goal, shoot past the keeper."""

import math

from touchline import Briefing, Command, Drive, Sight, skills


class FirstBrain:
    def __init__(self, briefing: Briefing) -> None:
        self.pitch, self.limits = briefing.setup.pitch, skills.DriveLimits.of(briefing.setup)

    def act(self, sight: Sight) -> Command:
        me, goal = sight.self, self.pitch.goal_line
        ball = sight.ball or sight.game.spot  # before it is seen: where the referee has placed it
        drive, kick = Drive(), None
        if sight.holding and me.x > goal - 5.0:
            others = [(other.x, other.y) for other in sight.obstacles]
            aim, _ = skills.best_place((me.x, me.y), others, self.pitch)
            drive, kick = skills.kick_at(me, (goal, aim), 8.0, 0.2, self.limits)
        elif sight.holding:
            drive = skills.dribble_to(me, goal, 0.0, 0.0, [], self.limits)
        elif ball and sight.game.running and not sight.game.phase.theirs:
            drive = skills.go_to(me, ball.x, ball.y, math.atan2(ball.y - me.y, ball.x - me.x), self.limits)
        return Command(answers_tick=sight.tick, drive=drive, dribble=True, kick=kick)
