"""Press: a sparring team whose three nearest robots close the ball in, and that plays on in short passes."""

import math

from sparring.team import Point, Sparring
from touchline import Action, KickMode, WorldBelief, skills

SHOT_RANGE, OPEN = 5.5, 0.35
"""m from the goal's middle, and m of free lane, at which it shoots."""
CLOSES_IN, SHORT = 1.1, 2.6
"""m from the ball to the second and third robot while opponents have it, and while this team has it."""
PRESSED = 1.2
"""m; an opponent nearer to the ball than this presses."""


class Press(Sparring):
    """One robot."""

    promised = 1.5

    def role(self, belief: WorldBelief, spot: Point) -> tuple[bool, Point]:
        """The first robot plays the ball, the second and third close in, the fourth stays behind them."""
        rank = 0 if self.is_keeper else self.first_at_the_ball(belief, spot).index(self.briefing.robot)
        return rank == 0, self.place(belief, spot, rank)

    def place(self, belief: WorldBelief, spot: Point, rank: int) -> Point:
        """Behind the ball and beside it, near while opponents have it; the last robot between ball and goal."""
        (x, y), own = spot, -self.goal[0]
        theirs = min((math.dist(one, spot) for one in belief.opponents), default=9.0)
        ours = min((math.dist(mate.body[:2], spot) for mate in belief.mates.values()), default=9.0)
        if rank >= 3:
            x, y = own + 0.45 * (x - own), 0.45 * y
        elif ours < theirs or belief.game.phase.ours:
            side = math.copysign(1.0, belief.me.y - y)
            x, y = x + (1.5 if rank == 1 else -1.5), y + side * SHORT
        else:
            wide = 0.25 if rank == 1 else 1.5  # rad: the second robot before the goal, the third beside it
            angle = math.atan2(-y, own - x) + math.copysign(wide, y)
            x, y = x + CLOSES_IN * math.cos(angle), y + CLOSES_IN * math.sin(angle)
        return skills.inside(max(-self.front, min(self.front, x)), y, self.setup.pitch, 0.5)

    def attack(self, belief: WorldBelief) -> Action:
        """Get the ball; with it shoot if a lane is open, pass on if pressed, else carry it toward the goal."""
        assert belief.ball is not None
        ball, mates = belief.ball.now, self.receivers(belief)
        if not belief.holding:
            self.chosen = None
            return self.get_ball(belief)
        aim, width = skills.best_place(ball[:2], belief.opponents, self.setup.pitch)
        if self.may_score and width > OPEN and math.dist(ball[:2], self.goal) < SHOT_RANGE:
            return self.kick(belief, (self.goal[0], aim), self.setup.kicker.max_ground_speed, "shoot")
        pressed = any(math.dist(ball[:2], opponent) < PRESSED for opponent in belief.opponents)
        self.chosen = skills.best_receiver(ball[:2], mates, belief.opponents, belief.me.heading, self.chosen)
        if self.chosen and (pressed or self.must_pass_on or not self.may_score or self.is_keeper):
            speed = skills.pass_speed(math.dist(ball[:2], mates[self.chosen]), self.setup, 2.8)
            return self.kick(belief, mates[self.chosen], speed, "pass", self.chosen)
        return self.carry(belief, 2.6, 0.3)

    def kick(self, belief: WorldBelief, target: Point, speed: float, word: str, to: str | None = None) -> Action:
        """Turn, and kick once the target is ahead."""
        drive, kick = skills.kick_at(belief.me, target, speed, 0.3 if to else 0.1, self.limits, KickMode.GROUND)
        if to and kick and belief.kicker_ready:
            self.promise = (to, self.promised)
        drive = self.with_ball(belief, drive)
        return Action("attacker", word, drive, dribble=True, kick=kick, pass_to=to if kick else None)
