"""One robot of the team: finds its role, and acts by role and phase."""

import math
from collections.abc import Sequence

from robot_agent.sdk.bodies import Ball
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.world_model import Teammate, WorldBelief, places_of
from robot_agent.soccer.skills.keep_goal import keep_goal
from robot_agent.soccer.skills.kick_at import kick_at
from robot_agent.soccer.skills.pass_to import ARRIVING, best_receiver, pass_to
from robot_agent.soccer.skills.take_ball import HAS_IT
from robot_agent.teams.action import Action
from robot_agent.teams.keeper import CLEAR, fetch, is_keepers_ball, play_out
from robot_agent.teams.player import Player
from robot_agent.teams.promise import Promise, promise_after
from robot_agent.teams.set_piece import before_own_goal, legal_place, stand, step_in, wait_behind
from robot_agent.teams.simple.formation import places
from robot_agent.teams.simple.roles import Candidate, Role, share_places, striker_of
from robot_agent.teams.simple.striker import SHOT_ERROR, StrikerSituation, is_pressed, play_ball
from robot_agent.teams.zones import owner_of
from schemas.frames import Point
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Drive, Kick
from schemas.soccer.game import TeamPhase

THREAT = 0.75
"""Share of the own half, from the middle, beyond which an opponent with the ball is met by the defender, too."""
KICK_OFF_TO = (0.8, 3.0)
"""m; target of a kick-off: ahead, so that the taker waits in its own half."""
KICK_OFF_ARRIVING = 1.0
"""m/s on arrival; the ball waits there for its receiver, which stands in its own half until START."""


class Simple(Player):
    """One of up to eleven robots."""

    def __init__(self, briefing: Briefing) -> None:
        super().__init__(briefing)
        self._role: Role = Role.KEEPER if self.is_keeper else Role.DEFENDER
        self._held = self._pressed = 0.0
        self._promised: Promise | None = None
        self._receiver: str | None = None
        """The receiver of the ball that this robot holds or is about to play."""
        self._gap, self._reach = self.setup.dribble.gap, self.setup.robot.reach

    def play(self, belief: WorldBelief, order: CoachOrder | None) -> Action:
        """Find the role, then act by it."""
        del order
        self._held = self._held + belief.dt if belief.holding else 0.0
        pressed = belief.holding and is_pressed(belief.me, belief.opponents)
        self._pressed = self._pressed + belief.dt if pressed else 0.0
        self._promised = promise_after(self._promised, belief)
        if belief.ball is None:
            return Action(self._role, "wait", Drive())
        ball, phase = belief.ball.now, belief.game.phase
        spot = (belief.game.spot.x, belief.game.spot.y) if belief.game.spot is not None else (ball.x, ball.y)
        if self.is_keeper:
            return self._keep(belief, ball, spot)
        self._role, place = self._find_role(belief, ball, spot)
        if self._role is not Role.STRIKER or phase.theirs:
            return self._support(belief, place, spot)
        if phase.ours:
            return self._take_restart(belief, ball, spot)
        if phase is TeamPhase.DROP_BALL and not belief.game.running:
            return Action(Role.STRIKER, "wait for the drop", self._stand(belief, place, spot))
        if any(mate.intention == CLEAR for mate in belief.mates.values()):
            return self._support(belief, place, spot)
        return self._strike(belief, ball)

    def _find_role(self, belief: WorldBelief, ball: Ball, spot: Point) -> tuple[Role, Point]:
        """The role of this robot from all poses and present roles, and its place.

        A striker that may not play the ball stands between it and the own goal.
        """
        me = self.briefing.robot
        if silent := self.silent_field(belief):
            return self._find_role_alone(silent, spot)
        receiver = self._promised.receiver if self._promised is not None else None
        candidates = {me: Candidate(belief.me, self._role, receiver == me)}
        for name, mate in belief.mates.items():
            if name != self.keeper:
                candidates[name] = Candidate(mate.body, mate.role, receiver == name)
        if belief.game.phase is not TeamPhase.PLAY:
            ball = Ball(*spot)
        takers = [name for name, candidate in candidates.items() if candidate.role == Role.STRIKER]
        if takers and belief.game.running and belief.game.phase is TeamPhase.OUR_PENALTY:
            striker = min(takers)  # a teammate that takes its place leaves its own before the kick, which is a foul
        else:
            striker = striker_of(candidates, ball, self.rolling, self._gap, self.limits)
        if striker == me:
            return Role.STRIKER, before_own_goal(spot, self.setup.pitch)
        del candidates[striker]
        formation = places(spot, self.setup.pitch, self._reach, max(1, len(candidates)))
        role = share_places(candidates, formation).get(me, Role.DEFENDER)
        return role, dict(formation)[role]

    def _find_role_alone(self, field: list[str], spot: Point) -> tuple[Role, Point]:
        """The role without a radio: the ball in its own part of the pitch, or the place that its number has."""
        me, plays = self.briefing.robot, self.briefing.robot if self._role is Role.STRIKER else None
        owner = owner_of(spot, field, self.setup.pitch, plays)
        if owner == me:
            return Role.STRIKER, before_own_goal(spot, self.setup.pitch)
        others = [name for name in field if name != owner]
        return places(spot, self.setup.pitch, self._reach, len(others))[others.index(me)]

    def _field_mates(self, belief: WorldBelief) -> dict[str, Teammate]:
        return {name: mate for name, mate in belief.mates.items() if name != self.keeper}

    def _strike(self, belief: WorldBelief, ball: Ball) -> Action:
        """Get the ball, then play it."""
        if belief.holding:
            mates = self._field_mates(belief)
            situation = StrikerSituation(
                belief.me,
                mates,
                belief.opponents,
                self._held,
                self._pressed,
                self._receiver,
                may_score=self.may_score,
                must_pass=self.must_pass_on,
            )
            action = play_ball(situation, self.setup, self.limits)
            self._receiver = action.pass_to
            if action.kick is None:
                return action._replace(pass_to=None)
            if action.pass_to is not None:
                self._promised = Promise(action.pass_to)
            return action
        self._receiver = None
        return Action(Role.STRIKER, "get the ball", fetch(belief, ball, self.setup, self.limits), dribble=True)

    def _support(self, belief: WorldBelief, place: Point, spot: Point) -> Action:
        """Hold the role's place; the defender leaves it for an opponent with the ball."""
        if self._role is Role.DEFENDER and self._is_threat(belief, spot):
            return Action(self._role, "block", self._stand(belief, before_own_goal(spot, self.setup.pitch), spot))
        taken = []
        if self._role is not Role.STRIKER and belief.game.phase.theirs:
            taken = [legal_place(*before_own_goal(spot, self.setup.pitch), belief.game, spot, self.setup)]
        return Action(self._role, "hold", self._stand(belief, place, spot, taken))

    def _is_threat(self, belief: WorldBelief, ball: Point) -> bool:
        """Whether an opponent has the ball near our goal."""
        in_play = belief.game.phase is TeamPhase.PLAY and ball[0] < -THREAT * self.setup.pitch.goal_line
        return in_play and any(math.dist(ball, opponent) < HAS_IT for opponent in belief.opponents)

    def _stand(self, belief: WorldBelief, place: Point, spot: Point, taken: Sequence[Point] = ()) -> Drive:
        return stand(belief.me, place, belief.game, spot, belief.others, self.setup, self.limits, taken)

    def _take_restart(self, belief: WorldBelief, ball: Ball, spot: Point) -> Action:
        """Line up behind the ball, and after START kick it at once: to a teammate, or a penalty at the goal."""
        target, receiver = self._restart_kick(belief, spot)
        if not belief.game.running:
            motion = wait_behind(belief.me, spot, target, belief.others, self.setup, self.limits)
            return Action(Role.STRIKER, "wait behind the ball", motion)
        if not belief.holding:
            motion = step_in(belief.me, (ball.x, ball.y), target, self.setup, self.limits)
            return Action(Role.STRIKER, "step in", motion, dribble=True)
        motion, kick = self._restart_motion(belief, target)
        if kick is not None and receiver is not None:
            self._promised = Promise(receiver)
        return Action(Role.STRIKER, "kick", motion, True, kick, receiver if kick is not None else None)

    def _restart_kick(self, belief: WorldBelief, spot: Point) -> tuple[Point, str | None]:
        """Target and receiver of a restart of our own."""
        pitch, mates = self.setup.pitch, self._field_mates(belief)
        if belief.game.phase is TeamPhase.OUR_PENALTY:
            return (pitch.goal_line, 0.35 * pitch.goal_width), None
        if belief.game.phase is TeamPhase.OUR_KICK_OFF:
            return KICK_OFF_TO, next((name for name, mate in mates.items() if mate.role == Role.LEFT), None)
        self._receiver = receiver = best_receiver(spot, places_of(mates), belief.opponents, chosen=self._receiver)
        if receiver is None:
            return (pitch.goal_line - pitch.penalty_mark, 0.0), None
        return mates[receiver].body[:2], receiver

    def _restart_motion(self, belief: WorldBelief, target: Point) -> tuple[Drive, Kick | None]:
        if belief.game.phase is TeamPhase.OUR_PENALTY:
            return kick_at(belief.me, target, self.setup.kicker.max_ground_speed, SHOT_ERROR, self.limits)
        arriving = KICK_OFF_ARRIVING if belief.game.phase is TeamPhase.OUR_KICK_OFF else ARRIVING
        return pass_to(belief.me, target, self.setup, self.limits, arriving)

    def _keep(self, belief: WorldBelief, ball: Ball, spot: Point) -> Action:
        """Guard the goal; take a slow ball near it, and play it out."""
        in_play = belief.game.phase is TeamPhase.PLAY
        if belief.holding and in_play:
            action, self._receiver = play_out(belief, self._receiver, self.setup, self.limits)
            return action._replace(role=Role.KEEPER)
        if in_play and is_keepers_ball(belief, ball, self.setup):
            return Action(Role.KEEPER, CLEAR, fetch(belief, ball, self.setup, self.limits), dribble=True)
        if belief.game.phase is TeamPhase.DROP_BALL:
            place = (-self.setup.pitch.goal_line + self._reach + 0.1, 0.0)
            return Action(Role.KEEPER, "guard", self._stand(belief, place, spot))
        motion = keep_goal(belief.me, ball, self.setup.pitch, self._reach, self.limits)
        return Action(Role.KEEPER, "guard", motion, dribble=in_play)
