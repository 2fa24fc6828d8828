"""Sights: what each robot perceives, hears and is told at one tick.

Ten sights a tick are most of what a host publishes. Perceived numbers are given to 0.1 mm, which is below any sensor's
noise and half the bytes, and what a picture shows is made once for all ticks until the next.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command, Motion
from schemas.messages.sight import BallSight, Obstacle, Outcome, Sight
from schemas.side import Side
from sim_host.match.radio import RadioAir
from sim_host.referee.game.referee_state import RefereeState
from sim_host.referee.game_views import game_views
from sim_host.sensing.camera import PER_OBSTACLE
from sim_host.sensing.perception import Percept, Perception
from sim_host.snapshot import Roster, Snapshot

Send = Callable[[str, bytes], None]
"""Takes a robot's name and its sight."""

DIGITS = 4
"""Of perceived numbers, behind the point."""


class _Seen:
    """What pictures show one robot, made once for each picture."""

    def __init__(self) -> None:
        self._ball: list[float] | None = None
        self._ball_place: list[float] = []
        self._obstacles: list[float] | None = None
        self._made: list[Obstacle] = []

    def ball(self, percept: Percept) -> BallSight | None:
        """The ball; None when it was never seen."""
        if percept.ball is None:
            return None
        if percept.ball is not self._ball:
            self._ball = percept.ball
            self._ball_place = [round(number, DIGITS) for number in percept.ball]
        x, y, z, vx, vy = self._ball_place
        return BallSight(x=x, y=y, z=z, vx=vx, vy=vy, age=round(percept.ball_age, DIGITS), visible=percept.visible)

    def obstacles(self, percept: Percept) -> list[Obstacle]:
        """Robots and other bodies; the same list of numbers again is the same picture again."""
        if percept.obstacles is not self._obstacles:
            self._obstacles = percept.obstacles
            rows = np.round(percept.obstacles, DIGITS).reshape(-1, PER_OBSTACLE).tolist()
            self._made = [Obstacle(x=x, y=y, radius=radius) for x, y, radius in rows]
        return self._made


class Sights:
    """Makes the sights of all robots of a match."""

    def __init__(self, roster: Roster, perception: Perception, radio: RadioAir) -> None:
        self._roster = roster
        self._perception = perception
        self._radio = radio
        self._seen = [_Seen() for _ in roster.names]

    def at(
        self,
        snapshot: Snapshot,
        state: RefereeState,
        episode: int,
        stuck: Sequence[bool],
        orders: Mapping[Side, CoachOrder],
        commands: Mapping[str, Command],
        refusals: Mapping[str, list[str]],
        send: Send,
    ) -> dict[str, bytes]:
        """Robot → its `schemas.messages.sight.Sight`, encoded; each is sent as soon as it is written."""
        percepts = self._perception.at(snapshot, state.cyan_attacks)
        motions = np.round([percept.own for percept in percepts], DIGITS).tolist()
        heard = self._radio.receive(snapshot.tick)
        views = game_views(state, self._roster, episode)
        sights = {}
        for index, (name, side) in enumerate(zip(self._roster.names, self._roster.sides, strict=True)):
            percept, seen, command = percepts[index], self._seen[index], commands.get(name)
            x, y, heading, vx, vy, omega = motions[index]
            sight = Sight(
                tick=snapshot.tick,
                time=snapshot.time,
                robot=name,
                side=side,
                self=Motion(x=x, y=y, heading=heading, vx=vx, vy=vy, omega=omega),
                ball=seen.ball(percept),
                holding=name == snapshot.possession,
                kicker_ready=snapshot.kickers_ready[index],
                stuck=stuck[index],
                obstacles=seen.obstacles(percept),
                obstacles_age=round(percept.obstacles_age, DIGITS),
                radio=heard[index],
                game=views[side],
                order=orders.get(side),
                outcome=Outcome(
                    answers_tick=command.answers_tick if command is not None else None,
                    refused=refusals.get(name, []),
                ),
            ).encode()
            send(name, sight)
            sights[name] = sight
        self._perception.develop()
        return sights
