"""Where a robot without the ball stands: at its place until another is clearly better, or at the end of a run."""

import math

from robot_agent.sdk.world_model import WorldBelief
from robot_agent.teams.reference.give_and_go import Run, run_after
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.passing import chance
from robot_agent.teams.reference.roles import Role
from schemas.frames import Point
from schemas.soccer.game import TeamPhase

DEFENDS = (Role.BLOCKER, Role.MARKER)
"""Roles that follow their place closely, at full speed."""


class HeldPlace:
    """The place that a robot has taken, and the run that it is on."""

    def __init__(self, parameters: Parameters) -> None:
        self._parameters = parameters
        self.at: Point | None = None
        """m; None before the first place."""
        self.run: Run | None = None
        """The run after a pass of this robot."""
        self._taken: tuple[Role, Point] | None = None
        """The role for which the place was taken, and where the ball was."""

    def choose(self, belief: WorldBelief, role: Role, place: Point, spot: Point, *, holds: bool, passed: bool) -> Point:
        """Where to stand now.

        Args:
            place: the place that the formation has for this robot.
            spot: the ball, or its place before START of a restart.
            holds: whether a robot of the team holds the ball.
            passed: whether a pass of the team is under way.
        """
        in_play = belief.game.phase is TeamPhase.PLAY
        self.run = run_after(self.run, belief.me, belief.dt, ours=in_play and (holds or passed))
        if self.run is not None and role not in DEFENDS:
            self.at = self.run.to
            return self.at
        serves = (
            role is Role.SUPPORTER and self.at is not None and self._still_serves(belief, self.at, spot, holds=holds)
        )
        if (
            self.at is None
            or self._is_taken(belief, self.at)
            or (math.dist(self.at, place) > self._settles(role) and not serves)
        ):
            self.at, self._taken = place, (role, spot)
        return self.at

    def _is_taken(self, belief: WorldBelief, at: Point) -> bool:
        """Whether a teammate is there: two robots that changed roles may hold the same place."""
        mine = math.dist(at, belief.me[:2])
        return any(
            math.dist(at, mate.body[:2]) < min(mine, self._parameters.taken_within) for mate in belief.mates.values()
        )

    def _settles(self, role: Role) -> float:
        """m by which the place of a role has to move before the robot follows it."""
        if role in DEFENDS:
            return self._parameters.settles_close
        return self._parameters.settles_guard if role is Role.GUARD else self._parameters.settles

    def _still_serves(self, belief: WorldBelief, at: Point, ball: Point, *, holds: bool) -> bool:
        """Whether a supporter need not follow the ball: it can be passed to where it stands, or nobody could pass."""
        parameters, phase = self._parameters, belief.game.phase
        if phase.ours or phase.theirs:
            if self._taken != (Role.SUPPORTER, ball):
                return False
            return phase.theirs or chance(ball, at, belief.opponents, parameters) > parameters.serves_chance
        if phase is not TeamPhase.PLAY:
            return False
        is_near = parameters.serves_near < math.dist(at, ball) < parameters.serves_far
        if not is_near or any(math.dist(at, mate.body[:2]) <= parameters.serves_near for mate in belief.mates.values()):
            return False
        is_ahead = at[0] > ball[0] - parameters.serves_behind
        return not holds or (is_ahead and chance(ball, at, belief.opponents, parameters) > parameters.serves_chance)
