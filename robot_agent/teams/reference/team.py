"""One robot of the reference team: the estimate, its role, and the action of its role."""

import math

import msgspec

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.skills.brake_before import brake_before
from robot_agent.sdk.world_model import WorldBelief, places_of
from robot_agent.soccer.skills.intercept import meet, way_of
from robot_agent.soccer.skills.keep_hold import keep_hold
from robot_agent.soccer.skills.keep_in_play import keep_in_play
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.take_ball import take_ball
from robot_agent.teams.action import Action
from robot_agent.teams.fair_play import Carry
from robot_agent.teams.own_push import OwnPush, let_go_of_opponent, push_after
from robot_agent.teams.player import LET_GO_BEFORE, STOP_BEFORE, Player
from robot_agent.teams.promise import Promise, promise_after
from robot_agent.teams.reference.attacker import Situation, play_ball
from robot_agent.teams.reference.drawing import drawing
from robot_agent.teams.reference.estimate import HOLDS, SharedEstimate, report
from robot_agent.teams.reference.formation import front_of
from robot_agent.teams.reference.give_and_go import run_past
from robot_agent.teams.reference.held_place import DEFENDS, HeldPlace
from robot_agent.teams.reference.keeper import fetches, guard
from robot_agent.teams.reference.parameters import PARAMETERS, Parameters
from robot_agent.teams.reference.passing import Pass
from robot_agent.teams.reference.recovery import BackOut
from robot_agent.teams.reference.role_finding import RoleFinder
from robot_agent.teams.reference.roles import Candidate, Role
from robot_agent.teams.reference.set_pieces import Restart, restart_kick
from robot_agent.teams.reference.shooting import Shot
from robot_agent.teams.set_piece import stand, step_in, wait_behind
from schemas.frames import Point
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command, Drive
from schemas.messages.sight import Sight
from schemas.soccer.game import TeamPhase

CLEAR = "clear"
"""Intention of a keeper that leaves its line for the ball."""


class Reference(Player):
    """One of up to eleven robots."""

    def __init__(self, briefing: Briefing, parameters: Parameters = PARAMETERS) -> None:
        super().__init__(briefing)
        self.parameters = parameters
        self._estimate = self._world = SharedEstimate(briefing, parameters)
        self._back_out = BackOut(parameters)
        self._push = OwnPush()
        self._roles = RoleFinder(briefing, self.rolling, parameters)
        self._role: Role = Role.KEEPER if self.is_keeper else Role.SUPPORTER
        self._promised: Promise | None = None
        self._chosen: Pass | None = None
        """The pass that this robot aims at."""
        self._held = self._waited = self._silent = 0.0
        """s with the ball; s since START of a restart; s without a message of any teammate in the field."""
        self._arrival = self._sent_arrival = math.inf
        """s until this robot could be at the ball: now, and as it was sent last."""
        self._held_place = HeldPlace(parameters)
        self._shot: Shot | None = None
        """The shot that this robot aims at."""
        self._weighed: dict[str, float] = {}
        """What this robot chose from, with the ball."""

    def restart(self) -> None:
        """Forget what was believed of the world: another episode begins."""
        super().restart()
        self._estimate = self._world = SharedEstimate(self.briefing, self.parameters)
        self._held_place = HeldPlace(self.parameters)
        self._promised = self._chosen = None

    def act(self, sight: Sight) -> Command:
        """The answer to one sight, with the words to the teammates in its radio message."""
        command = super().act(sight)
        if command.radio is None or command.radio.self is None:
            return command
        self._sent_arrival = self._arrival
        me, opponents = command.radio.self, [(body.x, body.y) for body in command.radio.obstacles]
        words = report(opponents, (me.x, me.y), self._arrival)
        debug = drawing(
            Body(me.x, me.y, me.heading),
            command.radio.role or "",
            command.radio.intention or "",
            place=self._held_place.at,
            aimed=self._chosen,
            weighed=self._weighed,
            opponents=opponents,
        )
        return msgspec.structs.replace(command, radio=msgspec.structs.replace(command.radio, extra=words), debug=debug)

    def _by_the_rules(self, belief: WorldBelief, action: Action, order: CoachOrder | None) -> Action:
        """The same action within the rules, and no harder than the dribbler keeps the ball."""
        me, wanted = belief.me, action.drive
        self._push = push_after(self._push, me, belief.opponents, belief.dt, self.setup.robot.reach)
        in_play = belief.game.phase is TeamPhase.PLAY and action.kick is None
        if in_play and belief.ball is not None and self._plays_ball(belief):
            wanted = keep_in_play(me, belief.ball.now[:2], wanted, self.setup, self.limits)
        wanted = let_go_of_opponent(self._push, me, wanted, self.setup, self.limits)
        action = super()._by_the_rules(belief, action._replace(drive=wanted), order)
        if not belief.holding or self._last is None:
            return action
        return action._replace(drive=keep_hold(me, action.drive, self._last.drive, belief.dt, self.setup))

    def _spare(self, belief: WorldBelief, wanted: Drive) -> Drive:
        """The same demand, braked before opponents; with the ball, before those that are not beyond it."""
        me, opponents, parameters = belief.me, belief.opponents, self.parameters
        if belief.ball is not None and self._plays_ball(belief):
            x, y = belief.ball.now.x - me.x, belief.ball.now.y - me.y
            opponents = [place for place in opponents if x * (place[0] - me.x) + y * (place[1] - me.y) < 0.0]
        limits = self.limits._replace(deceleration=parameters.spares * self.limits.deceleration)
        return brake_before(me, wanted, opponents, self.setup.robot.reach, limits, parameters.bump, hard=True)

    def _carry_on(self, belief: WorldBelief, action: Action, carry: Carry) -> Action:
        """A robot that aims at the goal stops rather than lets the ball go, after which it could not shoot for 1 s."""
        left = self._rule_limits.circle - carry.way
        if self._shot is None or left > LET_GO_BEFORE:
            return super()._carry_on(belief, action, carry)
        return action._replace(drive=self._stopping(action.drive, left - STOP_BEFORE))

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """Find the role, then act by it."""
        del order
        self._held = self._held + belief.dt if belief.holding else 0.0
        self._waited = self._waited + belief.dt if belief.game.running and belief.game.phase.ours else 0.0
        self._promised = promise_after(self._promised, belief)
        self._weighed = {}
        self._shot = self._shot if belief.holding else None
        if belief.game.phase.theirs or belief.game.phase is TeamPhase.DROP_BALL:
            self._chosen = None
        if belief.ball is None:
            self._arrival = math.inf
            return Action(self._role, "wait", Drive())
        ball = belief.ball.now
        spot = (belief.game.spot.x, belief.game.spot.y) if belief.game.spot is not None else (ball.x, ball.y)
        if belief.game.phase is not TeamPhase.PLAY:
            ball = Ball(*spot) if not belief.game.running else ball
        self._arrival = self._arrival_at(belief.me, ball, holding=belief.holding)
        if self.is_keeper:
            self._role = Role.KEEPER
            return self._keep(belief, ball, spot)
        out = self._back_out.motion(belief.me, self._estimate.stuck, belief.others, belief.dt, self.limits)
        if out is not None and not belief.holding:
            return Action(self._role, "back out", out)
        self._role, place = self._find_role(belief, ball, spot)
        return self._act_by_role(belief, ball, spot, place)

    def _act_by_role(self, belief: WorldBelief, ball: Ball, spot: Point, place: Point) -> Action:
        phase = belief.game.phase
        if self._role is not Role.ATTACKER or phase.theirs:
            return self._support(belief, place, spot)
        if phase.ours:
            return self._take_restart(belief, ball, spot)
        if phase is TeamPhase.DROP_BALL and not belief.game.running:
            return self._support(belief, place, spot)
        if any(mate.intention == CLEAR for mate in belief.mates.values()):
            return self._support(belief, place, spot)
        if belief.holding:
            return self._play_ball(belief)
        self._chosen = None
        return Action(Role.ATTACKER, "get the ball", self._get(belief, ball), dribble=True)

    def _arrival_at(self, body: Body, ball: Ball, *, holding: bool = False) -> float:
        """When a robot could be at the ball, s from now; before any other when it holds it."""
        if holding:
            return HOLDS
        return meet(body, way_of(ball, self.rolling), self.setup.dribble.gap, self.limits).time

    def _find_role(self, belief: WorldBelief, ball: Ball, spot: Point) -> tuple[Role, Point]:
        """The role and the place of this robot, from what all robots of the team know of each other."""
        silent = self.silent_field(belief)
        self._silent = self._silent + belief.dt if silent else 0.0
        if silent and (belief.game.phase.ours or self._silent > self.parameters.silent_after):
            return self._roles.find_alone(belief, silent, ball, spot, self._role)
        receiver = self._promised.receiver if self._promised is not None else None
        sent = self._sent_arrival if math.isfinite(self._sent_arrival) and not belief.holding else self._arrival
        candidates = self._roles.candidates(
            belief,
            Candidate(belief.me, sent, self._role, receiver == self.briefing.robot),
            self._estimate.words,
            self.keeper,
            receiver,
            lambda body: self._arrival_at(body, ball),
        )
        return self._roles.find(belief, candidates, ball, spot, promised=self._promised is not None)

    def _field_mates(self, belief: WorldBelief) -> dict[str, Body]:
        return {name: mate.body for name, mate in belief.mates.items() if name != self.keeper}

    def _play_ball(self, belief: WorldBelief) -> Action:
        """Shoot, pass or dribble."""
        self._held_place.run = None
        chosen = (self._chosen.receiver, self._chosen.target) if self._chosen is not None else None
        situation = Situation(
            belief.me,
            self._field_mates(belief),
            belief.opponents,
            self._held,
            chosen,
            may_score=self.may_score,
            must_pass=self.must_pass_on,
            aimed=self._shot,
        )
        action, self._chosen, self._weighed, self._shot = play_ball(situation, self.setup, self.limits, self.parameters)
        if action.pass_to is not None and belief.kicker_ready:
            self._promised = Promise(action.pass_to)
            if self._chosen is not None:
                pitch = self.setup.pitch
                front = front_of(pitch, self.setup.robot.reach)
                target = self._chosen.target
                self._held_place.run = run_past(belief.me, target, belief.opponents, pitch, front, self.parameters)
        return action

    def _get(self, belief: WorldBelief, ball: Ball) -> Drive:
        """Meet the ball: a pass is met on its way, a loose ball where it rolls."""
        gap, way = self.setup.dribble.gap, way_of(ball, self.rolling)
        meeting = meet(belief.me, way, gap, self.limits)
        if math.hypot(ball.vx, ball.vy) > self.parameters.meets_ahead_fast:
            ahead = meet(belief.me, way, gap, self.limits, self.parameters.meets_ahead)
            theirs = min((math.dist(ahead[:2], place) for place in belief.opponents), default=math.inf)
            meeting = ahead if theirs > self.parameters.meets_ahead_free else meeting
        clearance = 2.0 * self.setup.robot.reach + self.parameters.passes_by
        mates = places_of(belief.mates).values()
        return take_ball(belief.me, ball, meeting, gap, belief.opponents, clearance, self.limits, mates)

    def _support(self, belief: WorldBelief, place: Point, spot: Point) -> Action:
        """Hold the place; walk to it unless this robot defends, is on a run or is in the way of those at the ball."""
        holds, passed = self._roles.holder is not None, self._promised is not None
        at = self._held_place.choose(belief, self._role, place, spot, holds=holds, passed=passed)
        runs = self._held_place.run is not None and self._role not in DEFENDS
        is_clear = math.dist(belief.me[:2], spot) > self.parameters.clears_within
        walks = is_clear and not runs and self._role not in DEFENDS and belief.game.phase is TeamPhase.PLAY
        speed = self.parameters.guard_speed if self._role is Role.GUARD else self.parameters.support_speed
        limits = self.limits.capped(speed) if walks else self.limits
        motion = stand(belief.me, at, belief.game, spot, belief.others, self.setup, limits)
        return Action(self._role, "run" if runs else "hold", motion)

    def _take_restart(self, belief: WorldBelief, ball: Ball, spot: Point) -> Action:
        """Line up behind the ball; after START play it to the best receiver, or a penalty at the goal."""
        running, mates, away = belief.game.running, self._field_mates(belief), math.dist(belief.me[:2], spot)
        now = Restart(
            belief.game.phase, spot, mates, belief.opponents, running, self._waited, away, chosen=self._chosen
        )
        target, speed, error, aimed, waits = restart_kick(now, self.setup, self.parameters)
        self._chosen = aimed or self._chosen
        if waits or not running:
            intention = "wait for a receiver" if waits else "wait behind the ball"
            motion = wait_behind(belief.me, spot, target, belief.others, self.setup, self.limits)
            return Action(Role.ATTACKER, intention, motion)
        if not belief.holding:
            return Action(Role.ATTACKER, "step in", step_in(belief.me, ball[:2], target, self.setup, self.limits), True)
        motion, kick = kick_at(belief.me, target, speed, error, self.limits)
        receiver = aimed.receiver or None if aimed is not None and kick is not None else None
        if receiver is not None and belief.kicker_ready:
            self._promised = Promise(receiver)
        return Action(Role.ATTACKER, "kick", motion, True, kick, receiver)

    def _keep(self, belief: WorldBelief, ball: Ball, spot: Point) -> Action:
        """Guard the goal; fetch a slow ball near it, and play it out."""
        pitch, reach, in_play = self.setup.pitch, self.setup.robot.reach, belief.game.phase is TeamPhase.PLAY
        if in_play and belief.holding:
            action = self._play_ball(belief)
            return action._replace(role=Role.KEEPER, intention=CLEAR)
        comes_out = fetches(
            belief.me,
            ball,
            belief.opponents,
            self.rolling,
            pitch,
            self.limits,
            self.parameters,
            has_area=self._rule_limits.keeps_out,
        )
        if in_play and comes_out and not self._estimate.is_flying:
            return Action(Role.KEEPER, CLEAR, self._get(belief, ball), dribble=True)
        if belief.game.phase is TeamPhase.DROP_BALL:
            place = (-pitch.goal_line + reach + 0.1, 0.0)
            motion = stand(belief.me, place, belief.game, spot, belief.others, self.setup, self.limits)
            return Action(Role.KEEPER, "guard", motion)
        motion = guard(belief.me, ball, belief.opponents, pitch, reach, self.limits, self.parameters)
        return Action(Role.KEEPER, "guard", motion, dribble=in_play)
