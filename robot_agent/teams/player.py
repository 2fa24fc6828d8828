"""What a robot of every shipped team does alike: takes in the sight, obeys coach and referee, speaks on the radio."""

import math
from abc import ABC, abstractmethod
from typing import ClassVar

from robot_agent.bodies import Ball, DriveLimits
from robot_agent.contract import Briefing
from robot_agent.fair_play import Carry, Possession, RuleLimits, carry_after, possession_after
from robot_agent.skills.avoid import circles, go_around
from robot_agent.skills.keep_goal import keep_goal
from robot_agent.skills.keep_out import Area, keep_out
from robot_agent.skills.let_go import let_go
from robot_agent.skills.search import search_place
from robot_agent.teams import coach_tests, shoot_out
from robot_agent.teams.action import Action
from robot_agent.teams.set_piece import PENALTIES
from robot_agent.world_model import WorldBelief, WorldModel
from schemas.config.goalkeeper import goalkeeper_of
from schemas.game import GameStage, GameView, TeamPhase
from schemas.messages.coach import CoachMode, CoachOrder
from schemas.messages.command import BallBelief, Command, Drive, Motion, Radio
from schemas.messages.sight import Sight

RADIO_EVERY = 5
"""Ticks between two words on the radio: 10 Hz at a tick of 20 ms."""
FAR = 2.0
"""m along x and y together; a robot farther from the ball than it can come in `NOTICE` decides only when it speaks."""
NOTICE = 0.5
"""s."""
LETS_GO = 0.4
"""s without the dribbler after a kick: a soft one would be caught again before it has left."""
STILL = frozenset({TeamPhase.PRE_GAME, TeamPhase.STOPPED, TeamPhase.HALF_TIME, TeamPhase.FULL_TIME})
"""Phases in which nobody has anything to do."""
PASS_BEFORE = 1.5
"""m before the end of the dribbling circle where a robot begins to look for somebody to pass to."""
LET_GO_BEFORE = 1.0
"""m before its end where the ball is let go, if there is room ahead."""
STOP_BEFORE = 0.6
"""m before its end where a robot with no room ahead brakes: it comes to rest in 0.4 m from 2 m/s."""
TURN_BEFORE = 0.3
"""m before the longest way backward that may be repeated where a robot turns instead."""
TURN_RATE = 2.5
"""rad/s; of that turn."""
_PARKING_SPEED = 1.5
"""m/s."""
_AT_THE_CENTRE = Ball(0.0, 0.0)
"""Where a ball is that may be anywhere."""
_AIR = 0.1
"""m between two robots that pass each other."""


class Player(ABC):
    """One robot of a team; a team says what it does while the ball is in play or about to be."""

    plays_alone: ClassVar[bool] = False
    """A robot without teammates plays in the field; otherwise it keeps the goal."""

    def __init__(self, briefing: Briefing) -> None:
        self.briefing = briefing
        self.setup = briefing.setup
        self.limits = DriveLimits.of(briefing.setup)
        team = self.setup.teams[briefing.side]
        plays_field = not team.goalkeeper or (self.plays_alone and not briefing.teammates)
        self._keepers = [] if plays_field else team.robots
        """Who keeps the goal: the first of them that is on the field."""
        self.keeper = self._first_keeper = goalkeeper_of(self._keepers, ())
        """Who keeps it now, or nothing."""
        self.is_keeper = self.keeper == briefing.robot
        """Whether this robot does."""
        self._full_limits = self.limits
        self._world = WorldModel(briefing)
        self._rule_limits = RuleLimits.of(briefing.setup)
        self._counts_ways = self._rule_limits.counts_ways
        self._goal_area = Area.goal(self.setup.pitch)
        self._penalty_area = Area.penalty(self.setup.pitch)
        self._carry: Carry | None = None
        self.possession = Possession()
        """Which side has the ball, and whether a goal would count; followed where the rules ask for a pass."""
        self._lets_go = 0.0
        """s for which the dribbler stays off after a kick."""
        self._penalty_kicked = False
        """This robot has kicked its penalty of the shoot-out; there is one kick."""
        self._progress = coach_tests.NOTHING_DONE
        """How far this robot is with the coach's test."""
        self._last: Command | None = None
        self._game: GameView | None = None

    def act(self, sight: Sight) -> Command:
        """The answer to one sight."""
        if self._game is not None and sight.game.episode != self._game.episode:
            self.restart()
        if self._last is not None and self._may_go_on(sight, self._last):
            self._last = _repeated(self._last, sight.tick)
        else:
            self._last = self._decide(sight)
            self._game = sight.game
        return self._last

    def restart(self) -> None:
        """Another episode begins: what was believed of the world is void."""
        self._world = WorldModel(self.briefing)
        self._lets_go = 0.0
        self._progress = coach_tests.NOTHING_DONE
        self._last = None

    def _may_go_on(self, sight: Sight, last: Command) -> bool:
        """Whether nothing asks for a decision: far from the ball, nothing to say, the same game, the same order."""
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
        """A new decision."""
        belief = self._world.update(sight)
        self.keeper = goalkeeper_of(self._keepers, _away(belief.game)) if belief.game.robots else self._first_keeper
        self.is_keeper = self.keeper == self.briefing.robot
        self._penalty_kicked = self._penalty_kicked and belief.game.phase is TeamPhase.OUR_PENALTY
        order = sight.order
        self.limits = self._full_limits.capped(order.max_speed, order.max_turn_rate) if order else self._full_limits
        if self._counts_ways:
            self._carry = carry_after(self._carry, belief)
        if self._rule_limits.passes_first:
            self.possession = possession_after(self.possession, belief, self.briefing.robot, self._rule_limits.roll)
        action = self._obey(belief, order) or self._by_the_rules(belief, self._act(belief, order))
        if not belief.kicker_ready:
            action = action._replace(kick=None, pass_to=None)  # it would be refused: keep the ball, and aim
        self._lets_go = LETS_GO if action.kick is not None else max(0.0, self._lets_go - belief.dt)
        speaks = (sight.tick + self.briefing.number) % RADIO_EVERY == 0
        return Command(
            answers_tick=sight.tick,
            drive=action.drive,
            dribble=action.dribble and (action.kick is not None or self._lets_go == 0.0),
            kick=action.kick,
            radio=self._radio(belief, action) if speaks or action.pass_to is not None else None,
            acknowledges_order=order.sequence if order else None,
        )

    def _act(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """What the coach's test asks for, or the game; what every shipped team does alike stands before its play."""
        game = belief.game
        if order is not None and order.mode is CoachMode.TEST:
            return self.show_test(belief, order)
        if game.stage is GameStage.SHOOT_OUT and game.phase in PENALTIES:
            return self._shoot_out(belief)
        if belief.ball is None and game.phase is TeamPhase.PLAY:
            return self._search(belief)
        return self.play(belief, order)

    @abstractmethod
    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """What to do in a restart or in play."""

    @property
    def may_score(self) -> bool:
        """Whether the rules let a goal count that this robot kicks from where it is."""
        return not self._rule_limits.passes_first or self.possession.may_score

    @property
    def is_bound_forward(self) -> bool:
        """Whether the rules count ways driven backward with the ball."""
        return math.isfinite(self._rule_limits.backward)

    @property
    def must_pass_on(self) -> bool:
        """Whether the ball has to leave this robot's hold soon."""
        return self._carry is not None and self._carry.way > self._rule_limits.circle - PASS_BEFORE

    def _by_the_rules(self, belief: WorldBelief, action: Action) -> Action:
        """The same action as far as the rules in play let this robot do it."""
        if action.kick is None and self._carry is not None:
            action = self._carry_on(belief, action, self._carry)
        if self.is_keeper:
            return action
        drive = action.drive
        if self._rule_limits.keeps_out:
            drive = keep_out(belief.me, drive, self._goal_area, self.limits)
        if self._rule_limits.takes_turns:
            outside = keep_out(belief.me, drive, self._penalty_area, self.limits)
            if outside is not drive and self._is_second_in_area(belief):
                drive = outside
        return action if drive is action.drive else action._replace(drive=drive)

    def _is_second_in_area(self, belief: WorldBelief) -> bool:
        """Whether a teammate in the field is nearer to the ball than this robot, and in the nearer penalty area.

        Where a second one there is a foul at once, wherever it is: it may be about to enter.
        """
        end = math.copysign(1.0, belief.me.x)
        ball = belief.ball.now[:2] if belief.ball is not None else (end * self.setup.pitch.goal_line, 0.0)
        mine = math.dist(ball, belief.me[:2])
        return not belief.holding and any(
            math.dist(ball, mate.body[:2]) < mine
            and (self._rule_limits.at_once or self._penalty_area.has(end, *mate.body[:2]))
            for name, mate in belief.mates.items()
            if name != self.keeper
        )

    def _carry_on(self, belief: WorldBelief, action: Action, carry: Carry) -> Action:
        """Before the circle ends the ball is let go, or the robot stops; it turns before it has gone back for long."""
        if carry.way > self._rule_limits.circle - LET_GO_BEFORE:
            kick = let_go(belief.me, belief.opponents, self.setup) if belief.kicker_ready else None
            if kick is not None:
                return action._replace(intention="let go", dribble=True, kick=kick, pass_to=None)
            if carry.way > self._rule_limits.circle - STOP_BEFORE:
                return action._replace(drive=Drive(omega=action.drive.omega))
        if carry.backward > self._rule_limits.backward - TURN_BEFORE and action.drive.vx < 0.0:
            turn = math.copysign(TURN_RATE, action.drive.vy)
            return action._replace(drive=Drive(vy=action.drive.vy, omega=turn))
        return action

    def _obey(self, belief: WorldBelief, order: CoachOrder | None) -> Action | None:
        """What the referee or the coach leaves no choice about."""
        phase, mine = belief.game.phase, belief.game.robots.get(self.briefing.robot)
        if mine is not None and mine.off_field is not None:
            return Action("", "off the field", Drive())
        if phase in STILL:
            return Action("", "wait", Drive())
        if phase is TeamPhase.PARKING or (order and order.mode is CoachMode.PARK):
            return Action("", "park", self._park(belief))
        if order and order.mode is CoachMode.HOLD:
            return Action("", "hold", Drive())
        return None

    def show_test(self, belief: WorldBelief, order: CoachOrder) -> Action:
        """What the coach's test asks of this robot."""
        situation = coach_tests.Situation(self.briefing, belief, order, self.limits)
        action, self._progress = coach_tests.step(situation, self._progress)
        return action

    def _shoot_out(self, belief: WorldBelief) -> Action:
        """In a penalty of the shoot-out: take it, keep the goal, or wait."""
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
        return Action("", "wait", shoot_out.wait(belief, self.briefing.number, self.setup, limits))

    def _search(self, belief: WorldBelief) -> Action:
        """In play, when nobody has seen the ball for long: the keeper guards the goal, the others drive around."""
        pitch, reach, me = self.setup.pitch, self.setup.robot.reach, belief.me
        if self.is_keeper:
            return Action("", "look for the ball", keep_goal(me, _AT_THE_CENTRE, pitch, reach, self.limits))
        x, y = search_place(self.briefing.number, belief.game.clock, pitch)
        blocked = circles(belief.others, 2.0 * reach + _AIR)
        return Action("", "look for the ball", go_around(me, x, y, me.heading, blocked, self.limits))

    def _park(self, belief: WorldBelief) -> Drive:
        """To the right touch line of the own half, beside each other (simatch: 1.5 m apart)."""
        pitch, radius = self.setup.pitch, self.setup.robot.reach
        x = -pitch.goal_line + 1.5 * self.briefing.number
        y = -pitch.touch_line + radius + 0.1
        blocked = circles(belief.others, 2.0 * self.setup.robot.reach + _AIR)
        return go_around(belief.me, x, y, 0.0, blocked, self.limits.capped(_PARKING_SPEED))

    def _radio(self, belief: WorldBelief, action: Action) -> Radio:
        """What the teammates are told."""
        me, ball = belief.me, belief.ball
        return Radio(
            self=Motion(x=me.x, y=me.y, heading=me.heading, vx=me.vx, vy=me.vy, omega=me.omega),
            ball=BallBelief(x=ball.now.x, y=ball.now.y, vx=ball.now.vx, vy=ball.now.vy, age=ball.age) if ball else None,
            role=action.role,
            intention=action.intention,
            pass_to=action.pass_to,
        )


def _away(game: GameView) -> list[str]:
    """Who of us is off the field."""
    return [name for name, standing in game.robots.items() if standing.off_field is not None]


def _repeated(last: Command, tick: int) -> Command:
    """The last command as the answer to one more sight, with nothing kicked and nothing said."""
    return Command(
        answers_tick=tick, drive=last.drive, dribble=last.dribble, acknowledges_order=last.acknowledges_order
    )
