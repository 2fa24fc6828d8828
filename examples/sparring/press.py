"""Press: a sparring team whose three nearest robots close the ball in, and that plays on in short passes."""

import math

from touchline import Action, Briefing, CoachOrder, Drive, KickMode, Player, TeamPhase, WorldBelief, skills

SHOT_RANGE, OPEN = 5.5, 0.35
"""m from the goal's middle, and m of free lane, at which it shoots."""
CLOSES_IN, SHORT = 1.1, 2.6
"""m from the ball to the second and third robot while opponents have it, and while this team has it."""
PRESSED = 1.2
"""m; an opponent nearer to the ball than this presses."""
STAYS, PROMISED = 0.4, 1.5
"""s by which another must be earlier at the ball to play it; s for which a passed ball is left to its receiver."""

Point = tuple[float, float]


class Press(Player):
    """One robot."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.goal = (self.setup.pitch.goal_line, 0.0)
        self.front = self.setup.pitch.goal_line - self.setup.pitch.penalty_area_depth - 0.5
        self.rank = 3
        self.promise: tuple[str | None, float] = (None, 0.0)
        self.chosen: str | None = None
        self.aims_at: Point | None = None
        self.last = Drive()

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """The first robot plays the ball, the second and third close in, the fourth stays behind them."""
        del order
        if belief.ball is None:
            return Action("", "wait", Drive())
        game, ball = belief.game, belief.ball.now
        spot = (game.spot.x, game.spot.y) if game.spot is not None else ball[:2]
        in_play = game.phase is TeamPhase.PLAY
        if self.is_keeper and not (belief.holding and in_play):
            drive = skills.keep_goal(belief.me, ball, self.setup.pitch, self.setup.robot.reach, self.limits)
            return Action("keeper", "guard", drive, dribble=in_play)
        self.rank = 0 if self.is_keeper else self.rank_of_mine(belief, spot)
        if self.rank or game.phase.theirs or (game.phase is TeamPhase.DROP_BALL and not game.running):
            place = self.place(belief, spot)
            drive = skills.stand(belief.me, place, game, spot, belief.others, self.setup, self.limits)
            return Action(str(self.rank), "close in", drive)
        action = self.take_restart(belief, spot) if game.phase.ours else self.attack(belief)
        self.last = action.drive
        return action

    def rank_of_mine(self, belief: WorldBelief, spot: Point) -> int:
        """How many field robots are at the ball before this one; all robots reckon alike."""
        assert belief.ball is not None
        field = {name: mate.body for name, mate in belief.mates.items() if name != self.keeper}
        had = {name: mate.role == "0" for name, mate in belief.mates.items()} | {self.briefing.robot: self.rank == 0}
        field[self.briefing.robot] = belief.me
        passed = next((mate.pass_to for mate in belief.mates.values() if mate.pass_to), None)  # in one message only
        self.promise = (passed, PROMISED) if passed else (self.promise[0], self.promise[1] - belief.dt)
        ball = belief.ball.now if belief.game.phase is TeamPhase.PLAY else skills.Ball(*spot)
        path = skills.way_of(ball, self.rolling)

        def arrival(name: str) -> float:
            favour = STAYS * had[name] + PROMISED * (name == self.promise[0] and self.promise[1] > 0.0)
            holds = name == self.briefing.robot and belief.holding
            return -9.0 if holds else skills.meet(field[name], path, self.setup.dribble.gap, self.limits).time - favour

        return sorted(sorted(field), key=arrival).index(self.briefing.robot)

    def place(self, belief: WorldBelief, spot: Point) -> Point:
        """Behind the ball and beside it, near while opponents have it; the last robot between ball and goal."""
        (x, y), own = spot, -self.goal[0]
        theirs = min((math.dist(one, spot) for one in belief.opponents), default=9.0)
        ours = min((math.dist(mate.body[:2], spot) for mate in belief.mates.values()), default=9.0)
        if self.rank >= 3:
            x, y = own + 0.45 * (x - own), 0.45 * y
        elif ours < theirs or belief.game.phase.ours:
            side = math.copysign(1.0, belief.me.y - y)
            x, y = x + (1.5 if self.rank == 1 else -1.5), y + side * SHORT
        else:
            wide = 0.25 if self.rank == 1 else 1.5  # rad: the second robot before the goal, the third beside it
            angle = math.atan2(-y, own - x) + math.copysign(wide, y)
            x, y = x + CLOSES_IN * math.cos(angle), y + CLOSES_IN * math.sin(angle)
        return skills.inside(max(-self.front, min(self.front, x)), y, self.setup.pitch, 0.5)

    def attack(self, belief: WorldBelief) -> Action:
        """Get the ball; with it shoot if a lane is open, pass on if pressed, else carry it toward the goal."""
        assert belief.ball is not None
        me, ball, gap = belief.me, belief.ball.now, self.setup.dribble.gap
        if not belief.holding:
            self.chosen, clearance = None, 2.0 * self.setup.robot.reach + 0.05
            meeting = skills.meet(me, skills.way_of(ball, self.rolling), gap, self.limits)
            mates = [mate.body[:2] for mate in belief.mates.values()]
            drive = skills.take_ball(me, ball, meeting, gap, belief.opponents, clearance, self.limits, mates)
            return Action("0", "get the ball", drive, dribble=True)
        aim, width = skills.best_place(ball[:2], belief.opponents, self.setup.pitch)
        if self.may_score and width > OPEN and math.dist(ball[:2], self.goal) < SHOT_RANGE:
            return self.kick(belief, (self.goal[0], aim), self.setup.kicker.max_ground_speed, "shoot")
        pressed = any(math.dist(ball[:2], opponent) < PRESSED for opponent in belief.opponents)
        mates_at = {name: mate.body[:2] for name, mate in belief.mates.items() if name != self.keeper}
        self.chosen = skills.best_receiver(ball[:2], mates_at, belief.opponents, me.heading, self.chosen)
        if self.chosen and (pressed or self.must_pass_on or not self.may_score or self.is_keeper):
            speed = skills.pass_speed(math.dist(ball[:2], mates_at[self.chosen]), self.setup, 2.8)
            return self.kick(belief, mates_at[self.chosen], speed, "pass", self.chosen)
        blocked = skills.circles(belief.opponents, 2.0 * self.setup.robot.reach + 0.2)
        facing = math.atan2(-me.y, self.goal[0] - me.x)
        drive = skills.dribble_to(me, self.goal[0] - 2.6, 0.3 * me.y, facing, blocked, self.limits)
        return Action("0", "carry", self.with_ball(belief, drive), dribble=True)

    def with_ball(self, belief: WorldBelief, wanted: Drive) -> Drive:
        """The same drive, so gentle that the dribbler keeps the ball, and braked before the lines."""
        assert belief.ball is not None
        wanted = skills.keep_in_play(belief.me, belief.ball.now[:2], wanted, self.setup, self.limits)
        return skills.keep_hold(belief.me, wanted, self.last, belief.dt, self.setup)

    def kick(self, belief: WorldBelief, target: Point, speed: float, word: str, to: str | None = None) -> Action:
        """Turn, and kick once the target is ahead."""
        drive, kick = skills.kick_at(belief.me, target, speed, 0.3 if to else 0.1, self.limits, KickMode.GROUND)
        if to and kick and belief.kicker_ready:
            self.promise = (to, PROMISED)
        drive = self.with_ball(belief, drive)
        return Action("0", word, drive, dribble=True, kick=kick, pass_to=to if kick else None)

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
            return Action("0", "wait behind the ball", drive)
        if not belief.holding:
            drive = skills.step_in(belief.me, belief.ball.now[:2], self.aims_at, self.setup, self.limits)
            return Action("0", "step in", drive, dribble=True)
        arriving = {TeamPhase.OUR_KICK_OFF: 1.0, TeamPhase.OUR_PENALTY: 9.9}.get(belief.game.phase, 3.0)
        speed = skills.pass_speed(math.dist(spot, self.aims_at), self.setup, arriving)
        drive, kick = skills.kick_at(belief.me, self.aims_at, speed, 0.2, self.limits)
        return Action("0", "kick", drive, dribble=True, kick=kick)
