"""What robots of all shipped teams have in common: world model, obedience to coach and referee, rules, radio."""

import math
from abc import ABC, abstractmethod
from typing import ClassVar

from robot_agent.sdk.bodies import Ball, DriveLimits
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.skills.avoid import circles, go_around
from robot_agent.sdk.skills.brake_before import brake_before
from robot_agent.sdk.skills.braking import braking_speed
from robot_agent.sdk.skills.go_to import LAG
from robot_agent.sdk.skills.keep_out import Area, keep_out
from robot_agent.sdk.world_model import WorldBelief, WorldModel
from robot_agent.soccer.skills.keep_goal import keep_goal
from robot_agent.soccer.skills.keep_hold import hold_deceleration
from robot_agent.soccer.skills.let_go import let_go
from robot_agent.soccer.skills.search import search_place
from robot_agent.teams import coach_tests, shoot_out
from robot_agent.teams.action import Action, checked
from robot_agent.teams.area_turn import AreaTurn, leaves
from robot_agent.teams.fair_play import Carry, Possession, RuleLimits, carry_after, possession_after
from robot_agent.teams.parking import park
from robot_agent.teams.reports import radio_message, why_refused
from robot_agent.teams.set_piece import PENALTIES
from schemas.config.rolling import Rolling
from schemas.config.roster import goalkeeper_of
from schemas.messages.coach import CoachMode, CoachOrder, CoachTest
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from schemas.messages.soccer.game import GameView
from schemas.soccer.game import GameStage, TeamPhase

RADIO_EVERY = 5
"""Ticks between two radio messages: 10 Hz at a tick of 20 ms."""
FAR = 2.0
"""m along x and y together; farther from the ball, plus its way in `NOTICE`, a robot decides only when it sends."""
NOTICE = 0.5
"""s of the ball's motion."""
LETS_GO = 0.4
"""s without the dribbler after a kick: the ball of a soft kick would be caught again at once."""
STILL = frozenset({TeamPhase.PRE_GAME, TeamPhase.STOPPED, TeamPhase.HALF_TIME, TeamPhase.FULL_TIME})
"""Phases in which robots stand still."""
PASS_BEFORE = 1.8
"""m before the end of the dribbling circle, where a robot begins to look for a receiver."""
LET_GO_BEFORE = 1.3
"""m before its end, where the ball is released if there is room ahead."""
STOP_BEFORE = 0.5
"""m before its end, where a robot without room ahead has stopped: an opponent that presses pushes it on."""
TURN_BEFORE = 0.3
"""m before the longest repeatable distance backward, where a robot turns instead."""
TURN_RATE = 2.5
"""rad/s of that turn."""
PLAYS_BALL = 0.3
"""m of air between its hull and the ball up to which a robot plays the ball."""
_AT_THE_CENTRE = Ball(0.0, 0.0)
"""Stands in for a ball whose place is unknown."""
_AIR = 0.1
"""m between two robots that pass each other."""


class Player(ABC):
    """One robot of a team; each team defines what it does in play and in restarts."""

    plays_alone: ClassVar[bool] = False
    """Whether a robot without teammates plays in the field rather than keeps the goal."""
    tests: ClassVar[frozenset[CoachTest]] = frozenset({CoachTest.STOP, *coach_tests.STEPS})
    """The coach's tests that its robots carry out."""
    tactics: ClassVar[frozenset[str]] = frozenset()
    """The tactics that its robots know."""

    def __init__(self, briefing: Briefing) -> None:
        self.briefing = briefing
        self.setup = briefing.setup
        self.limits = DriveLimits.of(briefing.setup)
        team = self.setup.teams[briefing.side]
        plays_field = not team.goalkeeper or (self.plays_alone and not briefing.teammates)
        self._robots = team.robots
        self._keepers = [] if plays_field else team.robots
        """Candidates for the goalkeeper: the first of them on the field."""
        self.keeper = self._first_keeper = goalkeeper_of(self._keepers, ())
        """The goalkeeper at present; None where there is none."""
        self.is_keeper = self.keeper == briefing.robot
        """Whether this robot is the goalkeeper."""
        self._full_limits = self.limits
        self._world = WorldModel(briefing)
        self._rule_limits = RuleLimits.of(briefing.setup)
        self._counts_ways = self._rule_limits.counts_ways
        self.rolling = Rolling.of(self.setup.ball)
        self._goal_area = Area.goal(self.setup.pitch)
        self._penalty_area = Area.penalty(self.setup.pitch)
        self._area_turn = AreaTurn(self._rule_limits, self._penalty_area)
        self._carry: Carry | None = None
        self.possession = Possession()
        """Which side has the ball, and whether a goal would count; updated only where the rules require a pass."""
        self._lets_go = 0.0
        """s for which the dribbler stays off after a kick."""
        self._penalty_kicked = False
        """Whether this robot has kicked its penalty of the shoot-out, for which it has one kick."""
        self._progress = coach_tests.NOTHING_DONE
        """How far this robot has come with the coach's test."""
        self._last: Command | None = None
        self._game: GameView | None = None

    def act(self, sight: Sight) -> Command:
        """The answer to one sight."""
        if self._game is not None and sight.game.episode != self._game.episode:
            self.restart()
        if self._last is not None and self._may_go_on(sight, self._last):
            self._last = self._last.replace(answers_tick=sight.tick, radio=None, debug=None)
        else:
            self._last = self._decide(sight)
            self._game = sight.game
        return self._last

    def restart(self) -> None:
        """Forget what was believed of the world: another episode begins."""
        self._world = WorldModel(self.briefing)
        self._lets_go = 0.0
        self._progress = coach_tests.NOTHING_DONE
        self._last = None

    def _may_go_on(self, sight: Sight, last: Command) -> bool:
        """Whether the last command may be repeated: far from the ball, no radio message due, same game, same order."""
        ball, me, game, before = sight.ball, sight.self, sight.game, self._game
        return (
            (sight.tick + self.briefing.number) % RADIO_EVERY != 0
            and sight.tick == last.answers_tick + 1
            and last.kick is None
            and ball is not None
            and abs(ball.x - me.x) + abs(ball.y - me.y) > FAR + NOTICE * (abs(ball.vx) + abs(ball.vy))
            and before is not None
            and game.phase is before.phase
            and game.running == before.running
            and (sight.order.sequence if sight.order else None) == last.acknowledges_order
            and (sight.order is None or sight.order.mode is not CoachMode.TEST)
        )

    def _decide(self, sight: Sight) -> Command:
        """Make a new decision."""
        belief = self._world.update(sight)
        self.keeper = goalkeeper_of(self._keepers, _away(belief.game)) if belief.game.robots else self._first_keeper
        self.is_keeper = self.keeper == self.briefing.robot
        self._penalty_kicked = self._penalty_kicked and belief.game.phase is TeamPhase.OUR_PENALTY
        order = sight.order
        self.limits = self._full_limits.capped(order.max_speed, order.max_turn_rate) if order else self._full_limits
        if self._counts_ways:
            self._carry = carry_after(self._carry, belief, self._rule_limits.released)
        if self._rule_limits.passes_first:
            self.possession = possession_after(self.possession, belief, self.briefing.robot, self._rule_limits.roll)
        action = self._obey(belief, order) or self._by_the_rules(belief, self._act(belief, order), order)
        if not belief.kicker_ready:
            action = action._replace(kick=None, pass_to=None)  # the kick would be refused: keep the ball, and aim
        self._lets_go = LETS_GO if action.kick is not None else max(0.0, self._lets_go - belief.dt)
        sends = (sight.tick + self.briefing.number) % RADIO_EVERY == 0
        return Command(
            answers_tick=sight.tick,
            drive=action.drive,
            dribble=action.dribble and (action.kick is not None or self._lets_go == 0.0),
            kick=action.kick,
            debug=action.debug,
            radio=radio_message(belief, action) if sends or action.pass_to is not None else None,
            acknowledges_order=order.sequence if order else None,
            refuses_order=why_refused(order, self.tests, self.tactics) if order else "",
        )

    def _act(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """The action in the coach's test or in the game; what all teams have in common comes before the team's play."""
        game = belief.game
        if order is not None and order.mode is CoachMode.TEST:
            return self.show_test(belief, order)
        if game.stage is GameStage.SHOOT_OUT and game.phase in PENALTIES:
            return self._shoot_out(belief)
        if belief.ball is None and game.phase is TeamPhase.PLAY:
            return self._search(belief)
        return checked(self.play(belief, order), self.play)

    @abstractmethod
    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """The action in a restart or in play."""

    def silent_field(self, belief: WorldBelief) -> list[str]:
        """All field robots in the team's order, if this one has no ball and receives none of them; otherwise none."""
        field = [name for name in self._robots if name != self.keeper and name not in _away(belief.game)]
        is_silent = len(field) > 1 and not belief.holding and not any(name in belief.mates for name in field)
        return field if is_silent else []

    @property
    def may_score(self) -> bool:
        """Whether a goal that this robot kicks from its place would count."""
        return not self._rule_limits.passes_first or self.possession.may_score

    @property
    def is_bound_forward(self) -> bool:
        """Whether the rules limit driving backward with the ball."""
        return math.isfinite(self._rule_limits.backward)

    @property
    def must_pass_on(self) -> bool:
        """Whether this robot has to give up the ball soon."""
        return self._carry is not None and self._carry.way > self._rule_limits.circle - PASS_BEFORE

    def _by_the_rules(self, belief: WorldBelief, action: Action, order: CoachOrder | None) -> Action:
        """The same action within the rules in play; in a coach's test a robot spares opponents only where told to."""
        if action.kick is None and self._carry is not None and belief.holding:
            action = self._carry_on(belief, action, self._carry)
        if self.is_keeper:
            return action
        drive = action.drive
        if self._rule_limits.keeps_out and not leaves(belief, self._goal_area):
            drive = keep_out(belief.me, drive, self._goal_area, self.limits)
        if math.isfinite(self._rule_limits.area_robots):
            must_be_out = self._area_turn.has_to_be_out(belief, self.keeper)
            outside = keep_out(belief.me, drive, self._penalty_area, self.limits)
            if must_be_out and outside is not drive and not leaves(belief, self._penalty_area):
                drive = outside
        in_test = order is not None and order.mode is CoachMode.TEST
        if self._rule_limits.spares_opponents and not in_test:
            drive = self._spare(belief, drive)
        return action if drive is action.drive else action._replace(drive=drive)

    def _spare(self, belief: WorldBelief, wanted: Drive) -> Drive:
        """The same demand, braked before opponents; a robot that plays the ball may run into them."""
        if self._plays_ball(belief):
            return wanted
        return brake_before(belief.me, wanted, belief.opponents, self.setup.robot.reach, self.limits)

    def _plays_ball(self, belief: WorldBelief) -> bool:
        """Whether this robot has the ball, or the ball is so near that it may run into an opponent for it."""
        if belief.holding or belief.ball is None:
            return belief.holding
        reach = self.setup.robot.reach + self.setup.ball.radius + PLAYS_BALL
        return math.dist(belief.me[:2], belief.ball.now[:2]) < reach

    def _carry_on(self, belief: WorldBelief, action: Action, carry: Carry) -> Action:
        """Release the ball or brake before the dribbling circle ends; turn before the distance backward is too long."""
        left = self._rule_limits.circle - carry.way
        if left < PASS_BEFORE:
            kick = let_go(belief.me, belief.opponents, self.setup) if belief.kicker_ready else None
            if kick is not None and left < LET_GO_BEFORE:
                return action._replace(intention="let go", dribble=True, kick=kick, pass_to=None)
            if kick is None:
                action = action._replace(drive=self._stopping(action.drive, left - STOP_BEFORE))
        if carry.backward > self._rule_limits.backward - TURN_BEFORE and action.drive.vx < 0.0:
            turn = math.copysign(TURN_RATE, action.drive.vy)
            return action._replace(drive=Drive(vy=action.drive.vy, omega=turn))
        return action

    def _stopping(self, drive: Drive, left: float) -> Drive:
        """The same drive, as slow as a robot with the ball has to be to stop within `left` m."""
        most = braking_speed(max(0.0, left), min(hold_deceleration(self.setup), self.limits.deceleration), LAG)
        speed = math.hypot(drive.vx, drive.vy)
        if speed <= most:
            return drive
        return Drive(vx=drive.vx * most / speed, vy=drive.vy * most / speed, omega=drive.omega)

    def _obey(self, belief: WorldBelief, order: CoachOrder | None) -> Action | None:
        """The action that the referee or the coach prescribes; None where the robot is free."""
        phase, mine = belief.game.phase, belief.game.robots.get(self.briefing.robot)
        if mine is not None and mine.off_field is not None:
            return Action("", "off the field", Drive())
        if phase in STILL:
            return Action("", "wait", Drive())
        if phase is TeamPhase.PARKING or (order and order.mode is CoachMode.PARK):
            motion = park(belief.me, self.briefing.number, belief.others, self.setup, self.limits)
            return Action("", "park", motion)
        if order and order.mode is CoachMode.HOLD:
            return Action("", "hold", Drive())
        return None

    def show_test(self, belief: WorldBelief, order: CoachOrder) -> Action:
        """The action in the coach's test."""
        situation = coach_tests.Situation(self.briefing, belief, order, self.limits)
        action, self._progress = coach_tests.step(situation, self._progress)
        return action

    def _shoot_out(self, belief: WorldBelief) -> Action:
        """The action in a penalty of the shoot-out: take it, keep the goal, or wait."""
        game, limits = belief.game, self.limits
        kicker = shoot_out.kicker_of(self.setup.teams[self.briefing.side].robots, self.keeper, game)
        if game.phase is TeamPhase.OUR_PENALTY and kicker == self.briefing.robot:
            if self._penalty_kicked:
                return Action("kicker", "watch the penalty", Drive())
            if not game.running:
                return Action("kicker", "wait for START", shoot_out.wait_for_start(belief, self.setup, limits))
            motion, kick = shoot_out.take_penalty(belief, self.setup, limits)
            self._penalty_kicked = kick is not None and belief.kicker_ready
            return Action("kicker", "take the penalty", motion, dribble=True, kick=kick)
        if self.is_keeper and belief.ball is not None:
            reach, pitch = self.setup.robot.reach, self.setup.pitch
            return Action("keeper", "keep", keep_goal(belief.me, belief.ball.now, pitch, reach, limits), dribble=True)
        count = len(self.briefing.teammates) + 1
        return Action("", "wait", shoot_out.wait(belief, self.briefing.number, count, self.setup, limits))

    def _search(self, belief: WorldBelief) -> Action:
        """Search for a lost ball in play: the keeper guards the goal, the others drive around."""
        pitch, reach, me = self.setup.pitch, self.setup.robot.reach, belief.me
        if self.is_keeper:
            return Action("", "look for the ball", keep_goal(me, _AT_THE_CENTRE, pitch, reach, self.limits))
        x, y = search_place(self.briefing.number, belief.game.clock, pitch)
        blocked = circles(belief.others, 2.0 * reach + _AIR)
        return Action("", "look for the ball", go_around(me, x, y, me.heading, blocked, self.limits))


def _away(game: GameView) -> list[str]:
    """Own robots that are off the field."""
    return [name for name, record in game.robots.items() if record.off_field is not None]
