"""The paper's robots in a match: the one nearest to the ball runs the machine, the others hold their places."""

import math

from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.skills.avoid import circles, steer
from robot_agent.sdk.skills.go_to import drive
from robot_agent.sdk.skills.turn_to import turn_rate
from robot_agent.sdk.world_model import SeenBall, WorldBelief, places_of
from robot_agent.soccer.skills.keep_goal import keep_goal
from robot_agent.soccer.skills.keep_off import keep_off
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.pass_to import best_receiver, pass_speed, pass_to
from robot_agent.teams.action import Action
from robot_agent.teams.keeper import CLEAR, fetch, is_keepers_ball, play_out
from robot_agent.teams.nubot.machine import KICK, Machine, MachineOutput, Points, Situation, State
from robot_agent.teams.nubot.trajectory import ROTATION
from robot_agent.teams.player import Player
from robot_agent.teams.promise import Promise, promise_after
from robot_agent.teams.set_piece import KICK_OFFS, stand, step_in, wait_behind
from robot_agent.teams.zones import owner_of
from schemas.messages.coach import CoachOrder, CoachTest
from schemas.messages.command import KickMode
from schemas.soccer.game import TeamPhase

HOMES = (
    (-10.5, 0.0),
    (-2.0, 1.0),
    (-2.0, -1.0),
    (-5.0, 2.0),
    (-5.0, -2.0),
    (-2.0, 4.8),
    (-2.0, -4.8),
    (-5.0, 5.0),
    (-5.0, -5.0),
    (-7.5, 1.2),
    (-7.5, -1.2),
)
"""m on 22 × 14 m, the goalkeeper first; the first five are simatch's start poses."""
AHEAD = {2: (3.0, 2.5), 3: (3.0, -2.5), 6: (5.0, 4.8), 7: (5.0, -4.8)}
"""m on 22 × 14 m; where some robots wait for a pass, without which a goal of their side would not count."""
LOYALTY = 0.5
"""m by which a teammate must be nearer to the ball than the robot that plays it, to play it instead."""
PROMISED = 3.0
"""m by which the robot that was promised the ball may be farther from it than another."""
_FOLLOWS, _BACK_FOLLOWS_LESS = 0.9, 0.1
"""Share of the ball's x that a place moves along: 0.9, less 0.1 for each m that its home is behind the middle."""
_ASIDE_FOLLOWS = 0.25
"""Share of the ball's y."""
_CLEAR_OF_BALL = 2.4
"""m between a place and a ball that a teammate plays."""
_PREPARED = 1.0
"""m into the other half."""
_NEAR_ENOUGH = 1.5
"""m around the dribble point; a pressed robot does not brake for the last step."""
_TURNS = 4.0
"""m before the dribble point, where the robot begins to turn to the goal; until then its body shields the ball."""
_BALL_ROOM = 0.1
"""m of air to opponents, for the ball before the robot."""
_RESTART_ROLLS = 8.0
"""m that the ball of a restart rolls, at most, if no robot takes it before."""
_KICK_OFF_TO = (0.2, -1.0)
"""m; target of a kick-off: softly to the side, and the taker follows."""
_KICK_OFF_ROLLS = 2.5
"""m that the ball of a kick-off rolls, if no robot takes it before."""
_RESTART_ERROR = 0.4
"""m beside the target of a restart, at most."""
PLAYS, HOLDS, KEEPS = "plays the ball", "holds its place", "keeper"


class NuBot(Player):
    """One of up to eleven robots; alone, the paper's robot."""

    plays_alone = True
    tests = Player.tests | {CoachTest.MACHINE}

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        pitch = self.setup.pitch
        x, y = HOMES[briefing.number - 1]
        self._home = x * pitch.length / 22.0, y * pitch.width / 14.0
        x, y = AHEAD.get(briefing.number, HOMES[briefing.number - 1])
        self._ahead = x * pitch.length / 22.0, y * pitch.width / 14.0
        self._points = Points().on(pitch)
        self._machine = Machine(self._points)
        self._role = HOLDS
        self._promised: Promise | None = None
        self._receiver: str | None = None
        """The receiver of the ball that this robot plays."""
        self._shown = 0
        """Number of the order for which the machine was started last."""

    def restart(self) -> None:
        """Restart the machine, as the paper's reset of the world does."""
        super().restart()
        self._machine.restart()

    def show_test(self, belief: WorldBelief, order: CoachOrder) -> Action:
        """The tests of all teams, and `machine`: one robot runs the machine once, to the order's points or its own."""
        if order.test is not CoachTest.MACHINE or order.robot_a != self.briefing.robot or belief.ball is None:
            return super().show_test(belief, order)
        if order.sequence != self._shown:
            self._machine.restart()
            self._shown = order.sequence
        dribble = (order.point_a.x, order.point_a.y) if order.point_a else self._points.dribble
        reset = (order.point_b.x, order.point_b.y) if order.point_b else self._points.reset
        self._machine.points = Points(dribble, self._points.goal, reset)
        situation = Situation(
            belief.me, belief.ball.now[:2], belief.holding, belief.dt, kicker_ready=belief.kicker_ready
        )
        in_the_way = belief.others if order.avoid else belief.opponents
        return self._carried_out(belief._replace(opponents=in_the_way), self._machine.step(situation))

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """Keep the goal, play the ball, or hold the place."""
        ball = belief.ball
        del order
        self._promised = promise_after(self._promised, belief)
        if ball is None:
            return self._hold(belief, self._home)
        spot = _spot(belief, ball)
        if self.is_keeper:
            return self._keep(belief, ball, spot)
        plays = self._nearest(belief, spot) == self.briefing.robot
        self._role = PLAYS if plays else HOLDS
        phase = belief.game.phase
        if not plays or phase.theirs or (phase is TeamPhase.DROP_BALL and not belief.game.running):
            self._machine.restart()
            return self._hold(belief, spot)
        return self._take_restart(belief, ball, spot) if phase.ours else self._run_machine(belief, ball)

    def _nearest(self, belief: WorldBelief, spot: tuple[float, float]) -> str:
        """The field robot that plays the ball: the nearest, with a bonus for playing it already or a promised pass."""
        if silent := self.silent_field(belief):
            plays = self.briefing.robot if self._role == PLAYS else None
            return owner_of(spot, silent, self.setup.pitch, plays)
        promised = self._promised.receiver if self._promised is not None else None
        robots = [(self.briefing.robot, belief.me, self._role)]
        robots += [(name, mate.body, mate.role) for name, mate in belief.mates.items() if name != self.keeper]
        nearest, least = "", math.inf
        for name, body, role in robots:
            away = math.dist(spot, body[:2]) - (LOYALTY if role == PLAYS else 0.0)
            away -= PROMISED if name == promised else 0.0
            if away < least or (away == least and name < nearest):
                nearest, least = name, away
        return nearest

    def _run_machine(self, belief: WorldBelief, ball: SeenBall) -> Action:
        """Run the paper's machine; after a kick it starts over as soon as the dribbler is on again."""
        self._machine.points = self._points._replace(dribble=self._dribble_point(belief, ball))
        back = self._machine.state in (State.RESET, State.HOME)
        if back and self._lets_go == 0.0:
            self._machine.restart()
        output = self._machine.step(
            Situation(belief.me, ball.now[:2], belief.holding, belief.dt, kicker_ready=belief.kicker_ready)
        )
        if self._machine.state is State.CHASE_BALL:
            self._receiver = None
            return Action(
                PLAYS, self._machine.state.value, fetch(belief, ball.now, self.setup, self.limits), dribble=True
            )
        if belief.holding and not self.may_score:
            prepared = self._pass_ahead(belief)
            if prepared is not None:
                return prepared
        return self._carried_out(belief, output)

    def _pass_ahead(self, belief: WorldBelief) -> Action | None:
        """Where a goal would not count, pass to a teammate in the other half; None if a pass reaches none."""
        ahead = {name: place for name, place in places_of(belief.mates).items() if place[0] > _PREPARED}
        self._receiver = receiver = best_receiver(belief.me[:2], ahead, belief.opponents, chosen=self._receiver)
        if receiver is None:
            return None
        motion, kick = pass_to(belief.me, ahead[receiver], self.setup, self.limits)
        return self._promising(Action(PLAYS, "pass ahead", motion, dribble=True, kick=kick), receiver)

    def _promising(self, action: Action, receiver: str | None) -> Action:
        """The same action; with its kick, the radio message names the receiver."""
        if action.kick is None or receiver is None:
            return action
        self._promised = Promise(receiver)
        return action._replace(pass_to=receiver)

    def _dribble_point(self, belief: WorldBelief, ball: SeenBall) -> tuple[float, float]:
        """The paper's point or its mirror image on the ball's side; the robot's own place once it is near enough."""
        x, y = self._points.dribble
        point = x, math.copysign(y, ball.now.y)
        return belief.me[:2] if math.dist(point, belief.me[:2]) < _NEAR_ENOUGH else point

    def _carried_out(self, belief: WorldBelief, output: MachineOutput) -> Action:
        """The machine's output, steered around opponents, and turned to the goal on the last metres with the ball."""
        vx, vy = output.vx, output.vy
        if self._machine.state is not State.CHASE_BALL:
            others = circles(belief.opponents, 2.0 * self.setup.robot.reach + _BALL_ROOM)
            vx, vy = steer(belief.me, vx, vy, 1.5, others)
        omega = output.omega
        facing = self._facing(belief, vx, vy) if self._machine.state is State.MOVE_BALL else None
        if facing is not None:
            omega = turn_rate(belief.me, facing, self.limits.capped(turn_rate=ROTATION.top))
        motion = drive(belief.me, vx, vy, omega, self.limits)
        return Action(PLAYS, self._machine.state.value, motion, output.dribble, output.kick)

    def _facing(self, belief: WorldBelief, vx: float, vy: float) -> float | None:
        """The heading with the ball: to the goal on the last metres; before, ahead if driving backward is limited."""
        if math.dist(self._machine.points.dribble, belief.me[:2]) < _TURNS:
            x, y = self._points.goal
            return math.atan2(y - belief.me.y, x - belief.me.x)
        return math.atan2(vy, vx) if self.is_bound_forward else None

    def _take_restart(self, belief: WorldBelief, ball: SeenBall, spot: tuple[float, float]) -> Action:
        """Kick to a teammate that a pass reaches, else ahead, and follow; a penalty with the machine's own kick."""
        target, receiver = self._restart_target(belief, spot)
        if not belief.game.running:
            motion = wait_behind(belief.me, spot, target, belief.others, self.setup, self.limits)
            return Action(PLAYS, "wait behind the ball", motion)
        if not belief.holding:
            motion = step_in(belief.me, ball.now[:2], target, self.setup, self.limits)
            return Action(PLAYS, "step in", motion, dribble=True)
        slowly = pass_speed(_RESTART_ROLLS, self.setup, arriving=0.0)
        mode, speed = KickMode.GROUND, min(pass_speed(math.dist(spot, target), self.setup), slowly)
        if belief.game.phase is TeamPhase.OUR_KICK_OFF:
            speed = pass_speed(_KICK_OFF_ROLLS, self.setup, arriving=0.0)
        if belief.game.phase is TeamPhase.OUR_PENALTY:
            mode, speed = KICK.mode, KICK.speed
        motion, kick = kick_at(belief.me, target, speed, _RESTART_ERROR, self.limits, mode)
        return self._promising(Action(PLAYS, "kick", motion, dribble=True, kick=kick), receiver)

    def _restart_target(self, belief: WorldBelief, spot: tuple[float, float]) -> tuple[tuple[float, float], str | None]:
        """Target and receiver of a restart."""
        phase = belief.game.phase
        if phase is TeamPhase.OUR_PENALTY:
            return self._points.goal, None
        if phase is TeamPhase.OUR_KICK_OFF:
            return _KICK_OFF_TO, None
        mates = {name: place for name, place in places_of(belief.mates).items() if name != self.keeper}
        self._receiver = receiver = best_receiver(spot, mates, belief.opponents, chosen=self._receiver)
        return (mates[receiver], receiver) if receiver is not None else (self._points.dribble, None)

    def _hold(self, belief: WorldBelief, spot: tuple[float, float]) -> Action:
        in_play = belief.game.phase is TeamPhase.PLAY
        waits_ahead = in_play and self.possession.ours is not False and not self.may_score
        home = self._ahead if waits_ahead else self._home
        place = home if belief.game.phase in KICK_OFFS else self._following(home, spot)
        motion = stand(belief.me, place, belief.game, spot, belief.others, self.setup, self.limits)
        return Action(HOLDS, "hold", motion)

    def _following(self, home: tuple[float, float], spot: tuple[float, float]) -> tuple[float, float]:
        """The place of a home, moved along with the ball, the more the farther ahead it is; clear of the ball."""
        pitch = self.setup.pitch
        share = max(0.0, _FOLLOWS + _BACK_FOLLOWS_LESS * self._home[0])
        front = pitch.goal_line - pitch.penalty_area_depth - self.setup.robot.reach
        x = max(-front, min(front, home[0] + share * spot[0]))
        y = home[1] + _ASIDE_FOLLOWS * spot[1]
        return keep_off(x, y, spot, _CLEAR_OF_BALL, pitch, self.setup.robot.reach, self._penalty_area)

    def _keep(self, belief: WorldBelief, ball: SeenBall, spot: tuple[float, float]) -> Action:
        if belief.game.phase is TeamPhase.DROP_BALL:
            return self._hold(belief, spot)._replace(role=KEEPS)
        in_play = belief.game.phase is TeamPhase.PLAY
        if in_play and belief.holding:
            action, self._receiver = play_out(belief, self._receiver, self.setup, self.limits)
            return self._promising(action._replace(role=KEEPS, pass_to=None), self._receiver)
        if in_play and is_keepers_ball(belief, ball.now, self.setup):
            return Action(KEEPS, CLEAR, fetch(belief, ball.now, self.setup, self.limits), dribble=True)
        motion = keep_goal(belief.me, ball.now, self.setup.pitch, self.setup.robot.reach, self.limits)
        return Action(KEEPS, "keep", motion, dribble=in_play)


def _spot(belief: WorldBelief, ball: SeenBall) -> tuple[float, float]:
    """The spot of a restart; in play, the ball's place."""
    spot = belief.game.spot
    return (spot.x, spot.y) if spot is not None else (ball.now.x, ball.now.y)
