"""Early: a sparring team that shoots on the run as soon as a lane is open, and marks tightly without the ball."""

import itertools
import math

from sparring.team import Point, Sparring
from touchline import Action, WorldBelief, skills

SHOT_RANGE, OPEN, RUNS = 6.5, 0.4, 2.0
"""m from the goal's middle, m of free lane, and m/s at which it drives on, when it shoots."""
PRESSED, MARKS = 1.3, 0.9
"""m from the ball within which an opponent presses; m from an opponent to its marker, toward our goal and the ball."""
AHEAD = ((3.5, 3.4), (3.5, -3.4), (-3.0, 0.0), (-6.0, 0.0))
"""m; places of supporters from the ball."""


class Early(Sparring):
    """One robot."""

    promised = 1.5

    def role(self, belief: WorldBelief, spot: Point) -> tuple[bool, Point]:
        """The robot that is first at the ball plays it, the others take the places with the least total way."""
        me, field = self.briefing.robot, self.field(belief)
        first, *_ = self.first_at_the_ball(belief, spot)
        names = sorted(name for name in field if name != first)
        nearest = min((math.dist(one, spot) for one in belief.opponents), default=9.0)
        ours = math.dist(field[first][:2], spot) < nearest or belief.game.phase.ours
        places = [self.inside(spot[0] + x, 0.6 * spot[1] + y) for x, y in AHEAD]
        places = (places if ours else [*self.defending(belief, spot), *places])[: len(names)]

        def way(order: tuple[Point, ...]) -> float:
            return sum(math.dist(field[name][:2], place) for name, place in zip(names, order, strict=True))

        best = min(itertools.permutations(places), key=way)
        return first == me, best[names.index(me)] if me in names else self.inside(spot[0] - 1.0, spot[1])

    def defending(self, belief: WorldBelief, spot: Point) -> list[Point]:
        """One place before the goal, then one at each opponent without the ball, the nearest to the goal first."""
        own = -self.goal[0]
        places = [self.inside(own + 0.4 * (spot[0] - own), 0.4 * spot[1])]
        free = [one for one in belief.opponents if math.dist(one, spot) > 1.2]
        for x, y in sorted(free, key=lambda one: math.dist(one, (own, 0.0))):
            angle = math.atan2(0.5 * spot[1] - y, 0.5 * (own + spot[0]) - x)
            places.append(self.inside(x + MARKS * math.cos(angle), y + MARKS * math.sin(angle)))
        return places

    def inside(self, x: float, y: float) -> Point:
        """The nearest place on the pitch outside the penalty areas."""
        return skills.inside(max(-self.front, min(self.front, x)), y, self.setup.pitch, 0.8)

    def attack(self, belief: WorldBelief) -> Action:
        """Get the ball; with it shoot if a lane is open, pass if pressed, else carry it toward the goal."""
        assert belief.ball is not None
        ball, mates = belief.ball.now, self.receivers(belief)
        if not belief.holding:
            self.chosen = None
            return self.get_ball(belief, ahead=0.2 if math.hypot(ball.vx, ball.vy) > 1.0 else 0.0)
        aim, width = skills.best_place(ball[:2], belief.opponents, self.setup.pitch)
        if self.may_score and width > OPEN and math.dist(ball[:2], self.goal) < SHOT_RANGE:
            return self.kick(belief, (self.goal[0], aim), self.setup.kicker.max_ground_speed)
        pressed = any(math.dist(ball[:2], opponent) < PRESSED for opponent in belief.opponents)
        self.chosen = skills.best_receiver(ball[:2], mates, belief.opponents, belief.me.heading, self.chosen)
        if self.chosen and (pressed or self.must_pass_on or not self.may_score or self.is_keeper):
            speed = skills.pass_speed(math.dist(ball[:2], mates[self.chosen]), self.setup, 3.0)
            return self.kick(belief, mates[self.chosen], speed, self.chosen)
        return self.carry(belief, 2.6, 0.4)

    def kick(self, belief: WorldBelief, target: Point, speed: float, to: str | None = None) -> Action:
        """Kick on the run: aim without braking."""
        me, away = belief.me, max(math.dist(belief.me[:2], target), 0.1)
        aim, kick = skills.kick_at(me, target, speed, 0.3 if to else 0.12, self.limits)
        vx, vy = RUNS * (target[0] - me.x) / away, RUNS * (target[1] - me.y) / away
        drive = skills.drive(me, vx, vy, aim.omega, self.limits)
        drive = skills.keep_hold(me, drive, self.last, belief.dt, self.setup)
        if to and kick and belief.kicker_ready:
            self.promise = (to, self.promised)
        return Action("attacker", "kick", drive, dribble=True, kick=kick, pass_to=to if kick else None)
