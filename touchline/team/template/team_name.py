"""TeamName: the robot nearest to the ball plays it, the goalkeeper guards the goal, the others wait for a pass.

`Player` keeps the rules, follows referee and coach, and fuses what the robots see. `play` decides what this robot does.
All places are in m in the team frame: the own goal at x = -11, the opponents' at x = 11, y to the left.
"""

import math

from touchline import Action, Briefing, CoachOrder, Drive, KickMode, Player, TeamPhase, WorldBelief, skills

PLACES = ((-7.0, 0.0), (-2.5, 3.5), (-2.5, -3.5), (3.0, 0.0))
"""m; where field robots wait while the ball lies in the centre."""
FOLLOWS = 0.4
"""Part of the ball's way from the centre by which these places are moved."""
BACK = 2.0
"""m by which they are nearer to the own goal when the coach orders to defend."""
STAYS = 0.5
"""m by which a teammate must be nearer to the ball than the robot that plays it, to play it instead."""
PROMISED = 1.5
"""s after a pass, for which the ball is left to its receiver."""
SHOT_RANGE = 7.0
"""m from the goal's middle."""
OPEN = 0.5
"""m of free lane that a shot needs."""
BEFORE_GOAL = 4.0
"""m in front of the goal line, where the ball is carried to."""
KICK_OFF_TO = (1.0, 3.0)
"""m; the taker of a kick-off waits behind the ball in its own half, so that it has to play the ball ahead."""
PRESSED = 1.0
"""m; an opponent nearer than this presses for the ball."""
ERROR = 0.15
"""m by which a kick may miss its target."""
BEFORE_AREA = 0.6
"""m from the penalty areas to the nearest place of a robot that waits."""
AIR = 0.1
"""m between the hulls of two robots that pass each other."""

Point = tuple[float, float]


class TeamName(Player):
    """One robot; each robot of the team is one of these, in a process of its own."""

    tactics = frozenset({"defend"})
    """Tactics that the coach may order: `touchline coach order cyan --mode play --tactic defend`."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self.was_attacker = False
        self.promise: tuple[str | None, float] = (None, 0.0)
        """The receiver of the team's last pass, and the s for which the ball is left to it."""
        self.restart_to: tuple[str | None, Point] | None = None
        """The receiver of a restart. It stays while this robot steps in: to turn with the ball would be a foul."""

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """What this robot does in play and in restarts."""
        if belief.ball is None:
            return Action("", "wait", Drive())
        game, ball = belief.game, belief.ball.now
        spot = (game.spot.x, game.spot.y) if game.spot is not None else (ball.x, ball.y)
        if self.is_keeper:
            return self.guard(belief)
        defends = order is not None and order.tactic == "defend"
        role, place = self.role(belief, spot, BACK if defends else 0.0)
        must_wait = game.phase.theirs or (game.phase is TeamPhase.DROP_BALL and not game.running)
        if role != "attacker" or must_wait:
            drive = skills.stand(belief.me, place, game, spot, belief.others, self.setup, self.limits)
            return Action(role, "wait", drive)
        if not game.phase.ours:
            self.restart_to = None
        elif not belief.holding:
            return self.take_restart(belief, spot)
        return self.attack(belief, game.phase.ours) if belief.holding else self.get_ball(belief)

    def role(self, belief: WorldBelief, spot: Point, back: float) -> tuple[str, Point]:
        """This robot's role and place, `back` m nearer to the own goal; all robots decide alike."""
        me, field = self.briefing.robot, {self.briefing.robot: belief.me}
        field |= {name: mate.body for name, mate in belief.mates.items() if name != self.keeper}
        has_role = {name: mate.role == "attacker" for name, mate in belief.mates.items()}
        passed = next((mate.pass_to for mate in belief.mates.values() if mate.pass_to), None)  # in one message only
        name, left = self.promise
        self.promise = (passed, PROMISED) if passed else (name, left - belief.dt)
        receiver = self.promise[0] if self.promise[1] > 0.0 else None

        def way(name: str) -> float:
            if name == receiver:
                return -1.0  # before any other
            return math.dist(field[name][:2], spot) - STAYS * has_role.get(name, self.was_attacker)

        attacker = min(sorted(field), key=way)
        self.was_attacker = attacker == me
        others = sorted(name for name in field if name != attacker)
        place = PLACES[others.index(me) % len(PLACES)] if me in others else (spot[0] - 1.0, spot[1])
        if me in others:
            front = self.setup.pitch.goal_line - self.setup.pitch.penalty_area_depth - BEFORE_AREA
            x = place[0] + FOLLOWS * spot[0] - back  # one field robot of a side may be in a penalty area, not two
            place = (max(-front, min(front, x)), place[1] + FOLLOWS * spot[1])
        return ("attacker" if self.was_attacker else "supporter"), place

    def guard(self, belief: WorldBelief) -> Action:
        """Stand where a shot has to pass; play a ball that is held to a teammate, or far away."""
        assert belief.ball is not None
        if belief.holding and belief.game.phase is TeamPhase.PLAY:
            return self.attack(belief, must_pass=True)
        drive = skills.keep_goal(belief.me, belief.ball.now, self.setup.pitch, self.setup.robot.reach, self.limits)
        return Action("keeper", "guard", drive, dribble=belief.game.phase is TeamPhase.PLAY)

    def get_ball(self, belief: WorldBelief) -> Action:
        """Drive to where the ball can be met first, and catch it."""
        assert belief.ball is not None
        ball, gap = belief.ball.now, self.setup.dribble.gap
        meeting = skills.meet(belief.me, skills.way_of(ball, self.rolling), gap, self.limits)
        mates = [mate.body[:2] for mate in belief.mates.values()]
        clearance = 2.0 * self.setup.robot.reach + AIR
        drive = skills.take_ball(belief.me, ball, meeting, gap, belief.opponents, clearance, self.limits, mates)
        return Action("attacker", "get the ball", drive, dribble=True)

    def take_restart(self, belief: WorldBelief, spot: Point) -> Action:
        """Before START: wait behind the ball; after it: step in, until the dribbler holds the ball."""
        assert belief.ball is not None
        if self.restart_to is None or not belief.game.running:
            self.restart_to = self.restart_receiver(belief, spot)
        target = self.restart_to[1]
        if belief.game.running:
            drive = skills.step_in(belief.me, belief.ball.now[:2], target, self.setup, self.limits)
            return Action("attacker", "step in", drive, dribble=True)
        drive = skills.wait_behind(belief.me, spot, target, belief.others, self.setup, self.limits)
        return Action("attacker", "wait behind the ball", drive)

    def restart_receiver(self, belief: WorldBelief, spot: Point) -> tuple[str | None, Point]:
        """The receiver of a restart: the one chosen before, as long as the lane to it is open."""
        name = self.restart_to[0] if self.restart_to is not None else None
        if name in belief.mates:
            place = belief.mates[name].body[:2]
            if skills.is_open(spot, place, belief.opponents):
                return name, place
        return self.receiver(belief)

    def attack(self, belief: WorldBelief, must_pass: bool = False) -> Action:
        """With the ball: shoot if the lane is open, pass if pressed, else carry the ball toward the goal.

        Where the dribbling circle ends and nobody is free, `Player` lets the ball go for a moment, or stops.
        """
        me, pitch, kicker = belief.me, self.setup.pitch, self.setup.kicker
        aim, width = skills.best_place(me[:2], belief.opponents, pitch)
        is_penalty = belief.game.phase is TeamPhase.OUR_PENALTY
        in_range = math.dist(me[:2], (pitch.goal_line, 0.0)) < SHOT_RANGE
        if is_penalty or (not must_pass and in_range and self.may_score):
            mode = KickMode.GROUND if width > OPEN or is_penalty else KickMode.LOB
            speed = kicker.max_ground_speed if mode is KickMode.GROUND else kicker.max_lob_speed
            drive, kick = skills.kick_at(me, (pitch.goal_line, aim), speed, ERROR, self.limits, mode)
            return Action("attacker", "shoot", drive, dribble=True, kick=kick)
        name, target = self.restart_to or self.receiver(belief)
        pressed = any(math.dist(me[:2], opponent) < PRESSED for opponent in belief.opponents)
        if must_pass or (name is not None and (pressed or self.must_pass_on)):
            drive, kick = skills.pass_to(me, target, self.setup, self.limits)
            if kick is not None and belief.kicker_ready:
                self.promise = (name, PROMISED)
            return Action("attacker", "pass", drive, dribble=True, kick=kick, pass_to=name if kick else None)
        blocked = skills.circles(belief.opponents, 2.0 * self.setup.robot.reach + AIR)
        facing = math.atan2(-me.y, pitch.goal_line - me.x)
        drive = skills.dribble_to(me, pitch.goal_line - BEFORE_GOAL, 0.5 * me.y, facing, blocked, self.limits)
        return Action("attacker", "carry", drive, dribble=True)

    def receiver(self, belief: WorldBelief) -> tuple[str | None, Point]:
        """The teammate to pass to, and where it is; without one, a place ahead."""
        if belief.game.phase is TeamPhase.OUR_KICK_OFF:
            return None, KICK_OFF_TO
        mates = {name: mate.body[:2] for name, mate in belief.mates.items() if name != self.keeper}
        name = skills.best_receiver(belief.me[:2], mates, belief.opponents)
        return name, mates[name] if name is not None else (belief.me.x + 5.0, 0.8 * belief.me.y)
