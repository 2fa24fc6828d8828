"""Deep: a sparring team that waits before its own goal, lofts the ball to its one forward, and lobs at the goal."""

import math

from sparring.team import Point, Sparring
from touchline import Action, KickMode, WorldBelief, skills

LOB_RANGE, LOB_NEAREST = 8.0, 3.4
"""m from the goal's middle, between which it lobs: a nearer lob is still rising over the bar."""
SHOT_RANGE, OPEN = 4.5, 0.45
"""m from the goal's middle, and m of free lane, at which it shoots along the ground instead."""
GOES = 1.0
"""m into the other half, up to which its defenders go for the ball."""
WALL, APART, FORWARD = -6.6, 2.2, 4.0
"""m: x of the defenders, the space between two of them, and x of the forward."""
GRAVITY = 9.81
"""m/s²."""


class Deep(Sparring):
    """One robot; the last of the team is the forward."""

    def role(self, belief: WorldBelief, spot: Point) -> tuple[bool, Point]:
        """One robot goes for the ball where it is the team's to win; the others wait at their places."""
        place = skills.inside(*self.place(spot), self.setup.pitch, 0.6)
        return self.goes_for_the_ball(belief, spot) == self.briefing.robot, place

    def goes_for_the_ball(self, belief: WorldBelief, spot: Point) -> str | None:
        """The robot that does; None for a ball that opponents have far from our goal."""
        best, *_ = self.first_at_the_ball(belief, spot)
        nearest = min((math.dist(one, spot) for one in belief.opponents), default=9.0)
        is_theirs = nearest < math.dist(self.field(belief)[best][:2], spot) and spot[0] > GOES
        return None if is_theirs and not belief.game.phase.ours else best

    def place(self, spot: Point) -> Point:
        """The forward waits ahead on the side away from the ball, the others in a row that moves with it."""
        row = self.row
        index = row.index(self.briefing.robot) if self.briefing.robot in row else 0
        if index == len(row) - 1:
            return FORWARD, math.copysign(2.5, -spot[1])
        middle = 0.5 * (len(row) - 2)
        return WALL + 0.2 * max(0.0, spot[0]), 0.45 * spot[1] + APART * (index - middle)

    @property
    def row(self) -> list[str]:
        """The field robots in their order; the last one is the forward."""
        return [name for name in self.setup.teams[self.briefing.side].robots if name != self.keeper]

    def attack(self, belief: WorldBelief) -> Action:
        """Get the ball; with it lob or shoot at the goal, or loft it to the forward, or carry it."""
        assert belief.ball is not None
        ball, mates = belief.ball.now, self.receivers(belief)
        if not belief.holding:
            return self.get_ball(belief)
        away = math.dist(ball[:2], self.goal)
        aim, width = skills.best_place(ball[:2], belief.opponents, self.setup.pitch)
        target = (self.goal[0], aim)
        if self.may_score and away < SHOT_RANGE and width > OPEN:
            return self.kick(belief, target, self.setup.kicker.max_ground_speed, KickMode.GROUND)
        if self.may_score and LOB_NEAREST < away < LOB_RANGE and abs(ball.y) < 4.0:
            return self.kick(belief, target, self.setup.kicker.max_lob_speed, KickMode.LOB)
        forward = self.row[-1]
        if forward in mates and not self.may_score and mates[forward][0] - ball.x > 4.0:
            lands = 0.75 * math.dist(ball[:2], mates[forward])  # m; then the ball rolls
            speed = math.sqrt(lands * GRAVITY / math.sin(2.0 * self.setup.kicker.loft))
            return self.kick(belief, mates[forward], speed, KickMode.LOFT, forward)
        receiver = skills.best_receiver(ball[:2], mates, belief.opponents, belief.me.heading)
        if receiver and (self.must_pass_on or not self.may_score):
            speed = skills.pass_speed(math.dist(ball[:2], mates[receiver]), self.setup)
            return self.kick(belief, mates[receiver], speed, KickMode.GROUND, receiver)
        return self.carry(belief, 3.0, 0.3)

    def kick(self, belief: WorldBelief, target: Point, speed: float, mode: KickMode, to: str | None = None) -> Action:
        """Turn, and kick once the target is ahead."""
        drive, kick = skills.kick_at(belief.me, target, speed, 0.4 if to else 0.15, self.limits, mode)
        drive = self.with_ball(belief, drive)
        return Action("attacker", mode.value, drive, dribble=True, kick=kick, pass_to=to if kick else None)
