"""Keepaway, three against two: for how long the ball stays with the three. A keeper and a taker to start from."""

import math

from touchline import Action, Briefing, CoachOrder, Drive, Moment, Player, Score, WorldBelief, skills

NUMBERS = {"pressed": 2.2, "long": 3.0, "corner": 4.0, "arriving": 3.5}
"""The numbers of a keeper, which the parameters of its team replace: m of a taker at which the holder passes; s with
the ball after which it passes in any case, because the referee stops a ball that rests for 5 s; m from the middle to
the corners, along x and y; m/s of a pass when it arrives."""
AIR = 0.1
"""m between the hulls of two robots that pass each other."""


def kept(now: Moment) -> Score:
    """s until a taker holds the ball, it leaves the square, or the referee stops play."""
    assert now.ball is not None
    taken = now.holder is not None and now.sides[now.holder] != "cyan"
    is_out = not now.zones["square"].contains(now.ball.x, now.ball.y)
    return Score(now.time, over=taken or is_out or now.game.phase != "play")


class Taker(Player):
    """Drives to the ball and takes it."""

    def play(self, belief: WorldBelief, _order: CoachOrder | None) -> Action:
        """Get the ball."""
        return self.get_ball(belief)

    def get_ball(self, belief: WorldBelief) -> Action:
        """Drive to where the ball can be met first."""
        if belief.ball is None:
            return Action("", "wait", Drive())
        ball, gap = belief.ball.now, self.setup.dribble.gap
        meeting = skills.meet(belief.me, skills.way_of(ball, self.rolling), gap, self.limits)
        mates = [mate.body[:2] for mate in belief.mates.values()]
        clearance = 2.0 * self.setup.robot.reach + AIR
        drive = skills.take_ball(belief.me, ball, meeting, gap, belief.opponents, clearance, self.limits, mates)
        return Action("attacker", "get the ball", drive, dribble=True)


class Keeper(Taker):
    """Holds the ball until a taker comes, and passes along the more open side; the others wait at its neighbours."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        numbers = {name: float(briefing.parameters.get(name, value)) for name, value in NUMBERS.items()}
        self.pressed, self.long, far, self.arriving = numbers.values()
        self.corners = ((-far, -far), (far, -far), (far, far), (-far, far))
        """m; where keepers wait for a pass: at the two beside that of the ball."""
        self.receiver = ""
        """The keeper that the ball was passed to last."""
        self.held = 0.0
        """s with the ball."""

    def play(self, belief: WorldBelief, _order: CoachOrder | None) -> Action:
        """Hold, pass, receive or wait."""
        self.held = self.held + belief.dt if belief.holding else 0.0
        if belief.ball is None:
            return Action("", "wait", Drive())
        if belief.holding:
            return self.keep(belief)
        passed = [mate.pass_to for mate in belief.mates.values() if mate.pass_to]
        self.receiver = passed[0] if passed else self.receiver
        spot, me = belief.ball.now[:2], self.briefing.robot
        field = {me: belief.me[:2]} | {name: mate.body[:2] for name, mate in belief.mates.items()}
        first = min(field, key=lambda name: (name != self.receiver, math.dist(field[name], spot)))
        if first == me:
            return self.get_ball(belief)
        self.receiver = "" if self.receiver == me else self.receiver
        del field[first]
        x, y = self.place(field, spot)
        facing = math.atan2(spot[1] - belief.me.y, spot[0] - belief.me.x)
        return Action("", "wait", skills.go_to(belief.me, x, y, facing, self.limits))

    def place(self, waiting: dict[str, tuple[float, float]], spot: tuple[float, float]) -> tuple[float, float]:
        """The corner of this robot: those beside the ball's corner are shared with the least way in all."""
        near = min(range(4), key=lambda corner: math.dist(self.corners[corner], spot))
        mine = waiting.pop(self.briefing.robot)

        def way(corner: tuple[float, float]) -> float:
            return math.dist(mine, corner) - sum(math.dist(other, corner) for other in waiting.values())

        return min(self.corners[near - 1], self.corners[(near + 1) % 4], key=way)

    def keep(self, belief: WorldBelief) -> Action:
        """Wait for the takers, then pass."""
        me = belief.me[:2]
        mates = {name: mate.body[:2] for name, mate in belief.mates.items()}
        best = max(mates, key=lambda name: skills.lane_width(me, mates[name], belief.opponents), default=None)
        near = min((math.dist(me, opponent) for opponent in belief.opponents), default=math.inf)
        if best is None or (near > self.pressed and self.held < self.long):
            return Action("holder", "hold", Drive(), dribble=True)
        drive, kick = skills.pass_to(belief.me, mates[best], self.setup, self.limits, self.arriving)
        self.receiver = best
        return Action("holder", "pass", drive, dribble=True, kick=kick, pass_to=best if kick else None)
