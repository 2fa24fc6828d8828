"""Who is who: the robots of the team as all of them know each other, and from these the role and place of one."""

import math
from collections.abc import Callable

from robot_agent.sdk.bodies import Ball, Body
from robot_agent.sdk.contract import Briefing
from robot_agent.sdk.world_model import WorldBelief
from robot_agent.teams.reference.estimate import HOLDS, Words
from robot_agent.teams.reference.formation import places
from robot_agent.teams.reference.parameters import Parameters
from robot_agent.teams.reference.recovery import home
from robot_agent.teams.reference.roles import Candidate, Place, Role, attacker_of, share_places
from robot_agent.teams.set_piece import before_own_goal
from robot_agent.teams.zones import owner_of
from schemas.config.rolling import Rolling
from schemas.frames import Point
from schemas.soccer.game import TeamPhase


class RoleFinder:
    """Finds the role of one robot; its memory is for how long the places of an attack stay."""

    def __init__(self, briefing: Briefing, rolling: Rolling, parameters: Parameters) -> None:
        self._me, self._setup, self._side = briefing.robot, briefing.setup, briefing.side
        self._rolling, self._parameters = rolling, parameters
        self._attack_left = 0.0
        """s for which the places of an attack stay."""
        self.holder: str | None = None
        """The robot of the team that holds the ball, by its own words."""

    def candidates(
        self,
        belief: WorldBelief,
        mine: Candidate,
        words: dict[str, Words],
        keeper: str | None,
        receiver: str | None,
        arrival_of: Callable[[Body], float],
    ) -> dict[str, Candidate]:
        """All field robots of the team; those without radio messages at their homes.

        Args:
            mine: this robot, with its arrival as it was sent last.
            words: what teammates sent.
            receiver: the robot that was promised a pass.
            arrival_of: s until a robot at a place could be at the ball.
        """
        found = {self._me: mine}
        for number, name in enumerate(self._setup.teams[self._side].robots, 1):
            if name in (self._me, keeper) or _is_away(belief, name):
                continue
            mate = belief.mates.get(name)
            if mate is None:
                body = Body(*home(number, self._setup.pitch), 0.0)
                found[name] = Candidate(body, arrival_of(body) + self._parameters.silent_delay, "")
                continue
            arrival = words[name].arrival if name in words else math.inf
            cannot_hold = belief.ball is None or math.dist(mate.body[:2], belief.ball.now[:2]) > self._parameters.has_it
            if not math.isfinite(arrival) or (arrival < 0.5 * HOLDS and cannot_hold):
                arrival = arrival_of(mate.body)
            found[name] = Candidate(mate.body, arrival, mate.role, receiver == name)
        return found

    def find(
        self, belief: WorldBelief, candidates: dict[str, Candidate], ball: Ball, spot: Point, *, promised: bool
    ) -> tuple[Role, Point]:
        """The role of this robot, and its place; a robot that may not play the ball stands before the own goal.

        Args:
            ball: where it is, or its spot before START of a restart.
            promised: whether a pass of the team is under way.
        """
        self.holder = holder = self._holder(belief, candidates)
        first = holder if holder is not None else attacker_of(candidates, self._parameters)
        theirs = min((math.dist(place, ball[:2]) for place in belief.opponents), default=math.inf)
        is_first = (
            theirs > self._parameters.has_it and candidates[first].arrival < theirs / self._parameters.comes_speed
        )
        attacks = self._still_attacks(belief, holder is not None or belief.game.phase.ours or is_first or promised)
        if first == self._me:
            return Role.ATTACKER, before_own_goal(spot, self._setup.pitch)
        others = {name: one for name, one in candidates.items() if name != first}
        shared = share_places(others, self._places(belief, ball, spot, others, attacks=attacks), self._parameters)
        place = shared.get(self._me, Place(Role.GUARD, belief.me[:2]))
        return place.role, place.at

    def find_alone(
        self, belief: WorldBelief, field: list[str], ball: Ball, spot: Point, role: Role
    ) -> tuple[Role, Point]:
        """The same for a robot that receives none of its teammates, so that all find the same.

        Each plays the ball in its own part of the pitch. The places of the others are shared as if all were at home.

        Args:
            field: all field robots of the team, in its order.
            role: the role of this robot until now.
        """
        self.holder = None
        owner = owner_of(spot, field, self._setup.pitch, self._me if role is Role.ATTACKER else None)
        attacks = self._still_attacks(belief, belief.game.phase.ours)
        if owner == self._me:
            return Role.ATTACKER, before_own_goal(spot, self._setup.pitch)
        numbers = {name: number for number, name in enumerate(self._setup.teams[self._side].robots, 1)}
        others = {
            name: Candidate(Body(*home(numbers[name], self._setup.pitch), 0.0), math.inf, "")
            for name in field
            if name != owner
        }
        place = share_places(others, self._places(belief, ball, spot, others, attacks=attacks), self._parameters)[
            self._me
        ]
        return place.role, place.at

    def _holder(self, belief: WorldBelief, candidates: dict[str, Candidate]) -> str | None:
        """The robot of the team that holds the ball, by its own words."""
        if belief.holding:
            return self._me
        return min((name for name, one in candidates.items() if one.arrival < 0.5 * HOLDS), default=None)

    def _still_attacks(self, belief: WorldBelief, attacks: bool) -> bool:
        """Whether the places of an attack are taken: they stay for a moment, unless the opponents have a set piece."""
        lasts = self._parameters.attack_lasts if attacks else self._attack_left - belief.dt
        self._attack_left = 0.0 if belief.game.phase.theirs else max(0.0, lasts)
        return self._attack_left > 0.0

    def _places(
        self, belief: WorldBelief, ball: Ball, spot: Point, others: dict[str, Candidate], *, attacks: bool
    ) -> list[Place]:
        in_play = belief.game.phase is TeamPhase.PLAY
        return places(
            ball.after(self._parameters.looks_ahead, self._rolling)[:2] if in_play else spot,
            attacks=attacks,
            blocks=not belief.game.phase.theirs,  # the first robot stands there until the ball is in play
            opponents=belief.opponents,
            robots=[others[name].body[:2] for name in sorted(others)],
            pitch=self._setup.pitch,
            inset=self._setup.robot.reach,
            parameters=self._parameters,
        )


def _is_away(belief: WorldBelief, name: str) -> bool:
    record = belief.game.robots.get(name)
    return record is not None and record.off_field is not None
