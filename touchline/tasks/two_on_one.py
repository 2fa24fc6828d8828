"""Two attackers against a defender and its goalkeeper: a goal, or none. Its score, and attackers to start from."""

import math

from touchline import Action, Briefing, CoachOrder, Drive, Moment, Player, Score, WorldBelief, skills

RANGE = 6.5
"""m from the goal, within which an attacker shoots where it is open."""
OPEN = 0.8
"""m of free lane into the goal, with which an attacker shoots."""
NEAR = 3.5
"""m from the goal line, where it shoots in any case."""
LEAD = 0.6
"""s of a teammate's motion by which a pass is aimed ahead of it."""
PRESSED = 3.2
"""m; with an opponent before it and nearer than this, an attacker passes."""
AHEAD = 2.5
"""m before the ball, where the others run to."""
WIDE = 2.8
"""m from the middle, on the wing that the ball is not on."""
CLEAR = 0.7
"""m between the centres of two robots that pass each other."""


def scored(now: Moment) -> Score:
    """1 for a goal, otherwise 0; over with any goal, when an opponent has the ball or play stops."""
    lost = now.holder is not None and now.sides[now.holder] != "cyan"
    return Score(float(now.game.score.cyan), over=lost or now.game.phase != "play")


class Attacker(Player):
    """Shoots where the goal is open, passes before an opponent, carries the ball on; without it, runs free."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.last = Drive()
        """The drive of the tick before."""

    def play(self, belief: WorldBelief, _order: CoachOrder | None) -> Action:
        """Play the ball, get it, or run free."""
        action = self.play_ball(belief) if belief.holding else self.play_off_ball(belief)
        drive = action.drive
        if belief.holding:
            drive = skills.keep_hold(belief.me, drive, self.last, belief.dt, self.setup)
        self.last = drive
        return action._replace(drive=drive)

    def play_off_ball(self, belief: WorldBelief) -> Action:
        """Get the ball as the first, or when it was passed to this robot; otherwise run free."""
        if belief.ball is None:
            return Action("", "wait", Drive())
        ball, me, gap = belief.ball.now, belief.me, self.setup.dribble.gap
        way = skills.way_of(ball, self.rolling)
        meeting = skills.meet(me, way, gap, self.limits)
        bodies = [mate.body for mate in belief.mates.values()]
        is_called = any(mate.pass_to == self.briefing.robot for mate in belief.mates.values())
        is_first = all(meeting.time < skills.meet(body, way, gap, self.limits).time for body in bodies)
        if is_called or is_first:
            drive = skills.take_ball(me, ball, meeting, gap, belief.opponents, CLEAR, self.limits)
            return Action("attacker", "get the ball", drive, dribble=True)
        x = min(ball.x + AHEAD, self.setup.pitch.goal_line - AHEAD)
        wing = math.copysign(WIDE, -ball.y)
        blocked = skills.circles(belief.others, CLEAR)
        facing = math.atan2(ball.y - me.y, ball.x - me.x)
        drive = skills.go_around(me, x, wing, facing, blocked, self.limits)
        return Action("attacker", "run free", drive)

    def play_ball(self, belief: WorldBelief) -> Action:
        """Shoot, pass or carry."""
        me, pitch, opponents = belief.me, self.setup.pitch, belief.opponents
        y, width = skills.best_place(me[:2], opponents, pitch)
        if (width > OPEN and math.dist(me[:2], (pitch.goal_line, y)) < RANGE) or pitch.goal_line - me.x < NEAR:
            speed = self.setup.kicker.max_ground_speed
            drive, kick = skills.kick_at(me, (pitch.goal_line, y), speed, 0.2, self.limits)
            return Action("attacker", "shoot", drive, dribble=True, kick=kick)
        mates = {name: mate.body.after(LEAD)[:2] for name, mate in belief.mates.items()}
        receiver = skills.best_receiver(me[:2], mates, opponents)
        if receiver is not None and any(math.dist(me[:2], one) < PRESSED and one[0] > me.x for one in opponents):
            drive, kick = skills.pass_to(me, mates[receiver], self.setup, self.limits)
            return Action("attacker", "pass", drive, dribble=True, kick=kick, pass_to=receiver if kick else None)
        facing = math.atan2(-me.y, pitch.goal_line - me.x)
        blocked = skills.circles(opponents, CLEAR + 0.3)
        drive = skills.dribble_to(me, pitch.goal_line - 0.8 * NEAR, 0.5 * me.y, facing, blocked, self.limits)
        return Action("attacker", "carry", drive, dribble=True)
