"""Deep: a sparring team that waits before its own goal, lofts the ball to its one forward, and lobs at the goal."""

import math

from touchline import Action, Briefing, CoachOrder, Drive, KickMode, Player, TeamPhase, WorldBelief, skills

LOB_RANGE, LOB_NEAREST = 8.0, 3.4
"""m from the goal's middle, between which it lobs: a nearer lob is still rising over the bar."""
SHOT_RANGE, OPEN = 4.5, 0.45
"""m from the goal's middle, and m of free lane, at which it shoots along the ground instead."""
GOES = 1.0
"""m into the other half, up to which its defenders go for the ball."""
WALL, APART, FORWARD = -6.6, 2.2, 4.0
"""m: x of the defenders, the space between two of them, and x of the forward."""
STAYS = 0.4
"""s by which another must be earlier at the ball to play it."""
GRAVITY = 9.81
"""m/s²."""

Point = tuple[float, float]


class Deep(Player):
    """One robot; the last of the team is the forward."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.goal = (self.setup.pitch.goal_line, 0.0)
        self.field = [name for name in self.setup.teams[briefing.side].robots if name != self.keeper]
        self.attacks = False
        self.aims_at: Point | None = None
        self.last = Drive()

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """One robot goes for the ball where it is the team's to win; the others wait at their places."""
        del order
        if belief.ball is None:
            return Action("", "wait", Drive())
        game, ball = belief.game, belief.ball.now
        spot = (game.spot.x, game.spot.y) if game.spot is not None else ball[:2]
        in_play = game.phase is TeamPhase.PLAY
        if self.is_keeper and not (belief.holding and in_play):
            drive = skills.keep_goal(belief.me, ball, self.setup.pitch, self.setup.robot.reach, self.limits)
            return Action("keeper", "guard", drive, dribble=in_play)
        self.attacks = self.is_keeper or self.first(belief, spot) == self.briefing.robot
        if not self.attacks or game.phase.theirs or (game.phase is TeamPhase.DROP_BALL and not game.running):
            place = skills.inside(*self.place(spot), self.setup.pitch, 0.6)
            drive = skills.stand(belief.me, place, game, spot, belief.others, self.setup, self.limits)
            return Action("waiting", "wait", drive)
        action = self.take_restart(belief, spot) if game.phase.ours else self.attack(belief)
        self.last = action.drive
        return action

    def first(self, belief: WorldBelief, spot: Point) -> str | None:
        """The robot that goes for the ball; None for a ball that opponents have far from our goal."""
        assert belief.ball is not None
        me, phase = self.briefing.robot, belief.game.phase
        field = {name: mate.body for name, mate in belief.mates.items() if name != self.keeper} | {me: belief.me}
        had = {name: mate.role == "attacker" for name, mate in belief.mates.items()} | {me: self.attacks}
        path = skills.way_of(belief.ball.now if phase is TeamPhase.PLAY else skills.Ball(*spot), self.rolling)

        def arrival(name: str) -> float:
            holds = name == me and belief.holding
            time = skills.meet(field[name], path, self.setup.dribble.gap, self.limits).time
            return -9.0 if holds else time - STAYS * had[name]

        best = min(sorted(field), key=arrival)
        nearest = min((math.dist(one, spot) for one in belief.opponents), default=9.0)
        is_theirs = nearest < math.dist(field[best][:2], spot) and spot[0] > GOES
        return None if is_theirs and not phase.ours else best

    def place(self, spot: Point) -> Point:
        """The forward waits ahead on the side away from the ball, the others in a row that moves with it."""
        index = self.field.index(self.briefing.robot) if self.briefing.robot in self.field else 0
        if index == len(self.field) - 1:
            return FORWARD, math.copysign(2.5, -spot[1])
        middle = 0.5 * (len(self.field) - 2)
        return WALL + 0.2 * max(0.0, spot[0]), 0.45 * spot[1] + APART * (index - middle)

    def attack(self, belief: WorldBelief) -> Action:
        """Get the ball; with it lob or shoot at the goal, or loft it to the forward, or carry it."""
        assert belief.ball is not None
        me, ball, gap = belief.me, belief.ball.now, self.setup.dribble.gap
        if not belief.holding:
            clearance, mates = 2.0 * self.setup.robot.reach + 0.05, [mate.body[:2] for mate in belief.mates.values()]
            meeting = skills.meet(me, skills.way_of(ball, self.rolling), gap, self.limits)
            drive = skills.take_ball(me, ball, meeting, gap, belief.opponents, clearance, self.limits, mates)
            return Action("attacker", "get the ball", drive, dribble=True)
        away = math.dist(ball[:2], self.goal)
        aim, width = skills.best_place(ball[:2], belief.opponents, self.setup.pitch)
        target = (self.goal[0], aim)
        if self.may_score and away < SHOT_RANGE and width > OPEN:
            return self.kick(belief, target, self.setup.kicker.max_ground_speed, KickMode.GROUND)
        if self.may_score and LOB_NEAREST < away < LOB_RANGE and abs(ball.y) < 4.0:
            return self.kick(belief, target, self.setup.kicker.max_lob_speed, KickMode.LOB)
        forward = belief.mates.get(self.field[-1])
        if forward is not None and not self.may_score and forward.body.x - ball.x > 4.0:
            far = math.dist(ball[:2], forward.body[:2])
            speed = math.sqrt(
                0.75 * far * GRAVITY / math.sin(2.0 * self.setup.kicker.loft)
            )  # lands before it, and rolls
            return self.kick(belief, forward.body[:2], speed, KickMode.LOFT, self.field[-1])
        mates_at = {name: mate.body[:2] for name, mate in belief.mates.items() if name != self.keeper}
        receiver = skills.best_receiver(ball[:2], mates_at, belief.opponents, me.heading)
        if receiver and (self.must_pass_on or not self.may_score):
            speed = skills.pass_speed(math.dist(ball[:2], mates_at[receiver]), self.setup)
            return self.kick(belief, mates_at[receiver], speed, KickMode.GROUND, receiver)
        blocked = skills.circles(belief.opponents, 2.0 * self.setup.robot.reach + 0.2)
        facing = math.atan2(-me.y, self.goal[0] - me.x)
        drive = skills.dribble_to(me, self.goal[0] - 3.0, 0.3 * me.y, facing, blocked, self.limits)
        return Action("attacker", "carry", self.with_ball(belief, drive), dribble=True)

    def with_ball(self, belief: WorldBelief, wanted: Drive) -> Drive:
        """The same drive, so gentle that the dribbler keeps the ball, and braked before the lines."""
        assert belief.ball is not None
        wanted = skills.keep_in_play(belief.me, belief.ball.now[:2], wanted, self.setup, self.limits)
        return skills.keep_hold(belief.me, wanted, self.last, belief.dt, self.setup)

    def kick(self, belief: WorldBelief, target: Point, speed: float, mode: KickMode, to: str | None = None) -> Action:
        """Turn, and kick once the target is ahead."""
        drive, kick = skills.kick_at(belief.me, target, speed, 0.4 if to else 0.15, self.limits, mode)
        drive = self.with_ball(belief, drive)
        return Action("attacker", mode.value, drive, dribble=True, kick=kick, pass_to=to if kick else None)

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
