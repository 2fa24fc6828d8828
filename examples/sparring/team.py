"""What the sparring teams share: who plays the ball, a keeper, restarts, and the ball in the dribbler."""

import math
from abc import abstractmethod

from touchline import Action, Briefing, CoachOrder, Drive, Player, TeamPhase, WorldBelief, skills

STAYS = 0.4
"""s by which another must be earlier at the ball to play it."""

Point = tuple[float, float]


class Sparring(Player):
    """One robot. A team says where its robots wait, and how the one at the ball attacks."""

    promised = 0.0
    """s for which a passed ball is left to its receiver."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.goal = (self.setup.pitch.goal_line, 0.0)
        self.front = self.setup.pitch.goal_line - self.setup.pitch.penalty_area_depth - 0.5
        self.attacks = False
        self.promise: tuple[str | None, float] = (None, 0.0)
        self.chosen: str | None = None
        self.aims_at: Point | None = None
        self.last = Drive()

    @abstractmethod
    def role(self, belief: WorldBelief, spot: Point) -> tuple[bool, Point]:
        """Whether this field robot plays the ball, and where it waits otherwise, in the team frame in m."""

    @abstractmethod
    def attack(self, belief: WorldBelief) -> Action:
        """What the robot does that plays the ball."""

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """The keeper guards, one robot plays the ball, the others wait at their places."""
        del order
        if belief.ball is None:
            return Action("", "wait", Drive())
        game, ball = belief.game, belief.ball.now
        spot = (game.spot.x, game.spot.y) if game.spot is not None else ball[:2]
        in_play = game.phase is TeamPhase.PLAY
        if self.is_keeper and not (belief.holding and in_play):
            drive = skills.keep_goal(belief.me, ball, self.setup.pitch, self.setup.robot.reach, self.limits)
            return Action("keeper", "guard", drive, dribble=in_play)
        plays, place = self.role(belief, spot)
        self.attacks = plays or self.is_keeper
        if not self.attacks or game.phase.theirs or (game.phase is TeamPhase.DROP_BALL and not game.running):
            drive = skills.stand(belief.me, place, game, spot, belief.others, self.setup, self.limits)
            return Action("supporter", "wait", drive)
        action = self.take_restart(belief, spot) if game.phase.ours else self.attack(belief)
        self.last = action.drive
        return action

    def first_at_the_ball(self, belief: WorldBelief, spot: Point) -> list[str]:
        """The field robots, those that are first at the ball before others; all robots reckon alike."""
        assert belief.ball is not None
        me, ball = self.briefing.robot, belief.ball.now
        field = self.field(belief)
        had = {name: mate.role == "attacker" for name, mate in belief.mates.items()} | {me: self.attacks}
        passed = next((mate.pass_to for mate in belief.mates.values() if mate.pass_to), None)  # in one message only
        self.promise = (passed, self.promised) if passed else (self.promise[0], self.promise[1] - belief.dt)
        path = skills.way_of(ball if belief.game.phase is TeamPhase.PLAY else skills.Ball(*spot), self.rolling)

        def arrival(name: str) -> float:
            favour = STAYS * had[name] + self.promised * (name == self.promise[0] and self.promise[1] > 0.0)
            time = skills.meet(field[name], path, self.setup.dribble.gap, self.limits).time
            return -9.0 if name == me and belief.holding else time - favour

        return sorted(sorted(field), key=arrival)

    def field(self, belief: WorldBelief) -> dict[str, skills.Body]:
        """This robot, and its teammates but for the keeper."""
        mates = {name: mate.body for name, mate in belief.mates.items() if name != self.keeper}
        return mates | {self.briefing.robot: belief.me}

    def receivers(self, belief: WorldBelief) -> dict[str, Point]:
        """Where the teammates are but for the keeper."""
        return {name: mate.body[:2] for name, mate in belief.mates.items() if name != self.keeper}

    def get_ball(self, belief: WorldBelief, ahead: float = 0.0) -> Action:
        """Meet the ball, `ahead` s later than would be possible."""
        assert belief.ball is not None
        me, ball, gap = belief.me, belief.ball.now, self.setup.dribble.gap
        clearance, mates = 2.0 * self.setup.robot.reach + 0.05, [mate.body[:2] for mate in belief.mates.values()]
        meeting = skills.meet(me, skills.way_of(ball, self.rolling), gap, self.limits, ahead)
        drive = skills.take_ball(me, ball, meeting, gap, belief.opponents, clearance, self.limits, mates)
        return Action("attacker", "get the ball", drive, dribble=True)

    def carry(self, belief: WorldBelief, before: float, share: float) -> Action:
        """Carry the ball to `before` m from the goal line, at this share of its distance from the middle."""
        me, blocked = belief.me, skills.circles(belief.opponents, 2.0 * self.setup.robot.reach + 0.2)
        facing = math.atan2(-me.y, self.goal[0] - me.x)
        drive = skills.dribble_to(me, self.goal[0] - before, share * me.y, facing, blocked, self.limits)
        return Action("attacker", "carry", self.with_ball(belief, drive), dribble=True)

    def with_ball(self, belief: WorldBelief, wanted: Drive) -> Drive:
        """The same drive, so gentle that the dribbler keeps the ball, and braked before the lines."""
        assert belief.ball is not None
        wanted = skills.keep_in_play(belief.me, belief.ball.now[:2], wanted, self.setup, self.limits)
        return skills.keep_hold(belief.me, wanted, self.last, belief.dt, self.setup)

    def take_restart(self, belief: WorldBelief, spot: Point) -> Action:
        """Wait behind the ball; after START step in and play it to the best receiver, a penalty at the goal."""
        assert belief.ball is not None
        if self.aims_at is None or not belief.game.running:
            mates = self.receivers(belief)
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
