"""Early: a sparring team that shoots on the run as soon as a lane is open, and marks tightly without the ball."""

import itertools
import math

from touchline import Action, Briefing, CoachOrder, Drive, Player, TeamPhase, WorldBelief, skills

SHOT_RANGE, OPEN, RUNS = 6.5, 0.4, 2.0
"""m from the goal's middle, m of free lane, and m/s at which it drives on, when it shoots."""
PRESSED, MARKS = 1.3, 0.9
"""m from the ball within which an opponent presses; m from an opponent to its marker, toward our goal and the ball."""
STAYS, PROMISED = 0.4, 1.5
"""s by which another must be earlier at the ball to play it; s for which a passed ball is left to its receiver."""
AHEAD = ((3.5, 3.4), (3.5, -3.4), (-3.0, 0.0), (-6.0, 0.0))
"""m; places of supporters from the ball."""

Point = tuple[float, float]


class Early(Player):
    """One robot."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.goal = (self.setup.pitch.goal_line, 0.0)
        self.front = self.setup.pitch.goal_line - self.setup.pitch.penalty_area_depth - 0.5
        self.attacks = False
        self.promise: tuple[str | None, float] = (None, 0.0)
        self.chosen: str | None = None
        self.aims_at: Point | None = None
        self.last = Drive()

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """The robot that is first at the ball plays it, the others take the places with the least total way."""
        del order
        if belief.ball is None:
            return Action("", "wait", Drive())
        game, ball = belief.game, belief.ball.now
        spot = (game.spot.x, game.spot.y) if game.spot is not None else ball[:2]
        in_play = game.phase is TeamPhase.PLAY
        if self.is_keeper and not (belief.holding and in_play):
            drive = skills.keep_goal(belief.me, ball, self.setup.pitch, self.setup.robot.reach, self.limits)
            return Action("keeper", "guard", drive, dribble=in_play)
        first, place = self.first_and_place(belief, spot)
        self.attacks = self.is_keeper or first == self.briefing.robot
        if not self.attacks or game.phase.theirs or (game.phase is TeamPhase.DROP_BALL and not game.running):
            drive = skills.stand(belief.me, place, game, spot, belief.others, self.setup, self.limits)
            return Action("supporter", "wait", drive)
        action = self.take_restart(belief, spot) if game.phase.ours else self.attack(belief)
        self.last = action.drive
        return action

    def first_and_place(self, belief: WorldBelief, spot: Point) -> tuple[str, Point]:
        """Who plays the ball, and this robot's place; all robots reckon alike."""
        assert belief.ball is not None
        me, ball = self.briefing.robot, belief.ball.now
        field = {name: mate.body for name, mate in belief.mates.items() if name != self.keeper} | {me: belief.me}
        had = {name: mate.role == "attacker" for name, mate in belief.mates.items()} | {me: self.attacks}
        passed = next((mate.pass_to for mate in belief.mates.values() if mate.pass_to), None)  # in one message only
        self.promise = (passed, PROMISED) if passed else (self.promise[0], self.promise[1] - belief.dt)
        path = skills.way_of(ball if belief.game.phase is TeamPhase.PLAY else skills.Ball(*spot), self.rolling)

        def arrival(name: str) -> float:
            favour = STAYS * had[name] + PROMISED * (name == self.promise[0] and self.promise[1] > 0.0)
            time = skills.meet(field[name], path, self.setup.dribble.gap, self.limits).time
            return -9.0 if name == me and belief.holding else time - favour

        first = min(sorted(field), key=arrival)
        names = sorted(name for name in field if name != first)
        nearest = min((math.dist(one, spot) for one in belief.opponents), default=9.0)
        ours = math.dist(field[first][:2], spot) < nearest or belief.game.phase.ours
        places = [self.inside(spot[0] + x, 0.6 * spot[1] + y) for x, y in AHEAD]
        places = (places if ours else [*self.defending(belief, spot), *places])[: len(names)]

        def way(order: tuple[Point, ...]) -> float:
            return sum(math.dist(field[name][:2], place) for name, place in zip(names, order, strict=True))

        best = min(itertools.permutations(places), key=way)
        return first, best[names.index(me)] if me in names else self.inside(spot[0] - 1.0, spot[1])

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
        me, ball, gap = belief.me, belief.ball.now, self.setup.dribble.gap
        if not belief.holding:
            self.chosen, ahead = None, 0.2 if math.hypot(ball.vx, ball.vy) > 1.0 else 0.0
            clearance, mates = 2.0 * self.setup.robot.reach + 0.05, [mate.body[:2] for mate in belief.mates.values()]
            meeting = skills.meet(me, skills.way_of(ball, self.rolling), gap, self.limits, ahead)
            drive = skills.take_ball(me, ball, meeting, gap, belief.opponents, clearance, self.limits, mates)
            return Action("attacker", "get the ball", drive, dribble=True)
        aim, width = skills.best_place(ball[:2], belief.opponents, self.setup.pitch)
        if self.may_score and width > OPEN and math.dist(ball[:2], self.goal) < SHOT_RANGE:
            return self.kick(belief, (self.goal[0], aim), self.setup.kicker.max_ground_speed)
        pressed = any(math.dist(ball[:2], opponent) < PRESSED for opponent in belief.opponents)
        mates_at = {name: mate.body[:2] for name, mate in belief.mates.items() if name != self.keeper}
        self.chosen = skills.best_receiver(ball[:2], mates_at, belief.opponents, me.heading, self.chosen)
        if self.chosen and (pressed or self.must_pass_on or not self.may_score or self.is_keeper):
            speed = skills.pass_speed(math.dist(ball[:2], mates_at[self.chosen]), self.setup, 3.0)
            return self.kick(belief, mates_at[self.chosen], speed, self.chosen)
        blocked = skills.circles(belief.opponents, 2.0 * self.setup.robot.reach + 0.2)
        facing = math.atan2(-me.y, self.goal[0] - me.x)
        drive = skills.dribble_to(me, self.goal[0] - 2.6, 0.4 * me.y, facing, blocked, self.limits)
        drive = skills.keep_in_play(me, ball[:2], drive, self.setup, self.limits)
        drive = skills.keep_hold(me, drive, self.last, belief.dt, self.setup)
        return Action("attacker", "carry", drive, dribble=True)

    def kick(self, belief: WorldBelief, target: Point, speed: float, to: str | None = None) -> Action:
        """Kick on the run: aim without braking."""
        me, away = belief.me, max(math.dist(belief.me[:2], target), 0.1)
        aim, kick = skills.kick_at(me, target, speed, 0.3 if to else 0.12, self.limits)
        vx, vy = RUNS * (target[0] - me.x) / away, RUNS * (target[1] - me.y) / away
        drive = skills.drive(me, vx, vy, aim.omega, self.limits)
        drive = skills.keep_hold(me, drive, self.last, belief.dt, self.setup)
        if to and kick and belief.kicker_ready:
            self.promise = (to, PROMISED)
        return Action("attacker", "kick", drive, dribble=True, kick=kick, pass_to=to if kick else None)

    def take_restart(self, belief: WorldBelief, spot: Point) -> Action:
        """Wait behind the ball; after START step in and play it to the best receiver, a penalty at the goal."""
        assert belief.ball is not None
        if self.aims_at is None or not belief.game.running:
            mates = {name: mate.body[:2] for name, mate in belief.mates.items() if name != self.keeper}
            name = skills.best_receiver(spot, mates, belief.opponents)
            self.aims_at = mates[name] if name else (spot[0] + 4.0, 0.5 * spot[1])
            special = {TeamPhase.OUR_KICK_OFF: (0.8, 3.0), TeamPhase.OUR_PENALTY: (self.goal[0], 0.85)}
            self.aims_at = special.get(belief.game.phase, self.aims_at)
        if not belief.game.running:
            drive = skills.wait_behind(belief.me, spot, self.aims_at, belief.others, self.setup, self.limits)
            return Action("attacker", "wait behind the ball", drive)
        if not belief.holding:
            drive = skills.step_in(belief.me, belief.ball.now[:2], self.aims_at, self.setup, self.limits)
            return Action("attacker", "step in", drive, dribble=True)
        arriving = {TeamPhase.OUR_KICK_OFF: 1.0, TeamPhase.OUR_PENALTY: 9.9}.get(belief.game.phase, 3.0)
        speed = skills.pass_speed(math.dist(spot, self.aims_at), self.setup, arriving)
        drive, kick = skills.kick_at(belief.me, self.aims_at, speed, 0.2, self.limits)
        return Action("attacker", "kick", drive, dribble=True, kick=kick)
