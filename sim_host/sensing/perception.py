"""The percepts of all robots, in their team frames; reads the true state and never changes it.

A robot perceives its own motion in every tick. It sees the ball and the obstacles in the pictures of its camera, which
arrive late and not in every tick. All percepts are in the team frame as the robot believes it to lie: drift moves and
turns the whole frame, so that bodies keep their places relative to the robot.
"""

from collections import deque
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from schemas.config.sections import Sensing
from schemas.messages.percept import DIGITS, Percept
from sim_host.sensing.camera import Camera, Picture, rotated_ball
from sim_host.sensing.drift import Drift
from sim_host.sensing.own_motion import OwnMotion
from sim_host.sensing.random_streams import BatchedDraws, RandomStreams
from sim_host.sensing.shutter import Shutter
from sim_host.sensing.team_frames import TeamFrames
from sim_host.snapshot import RobotMotions, Roster, Snapshot


class LastSeen(NamedTuple):
    """When and where a robot last saw the ball: x, y, z, vx, vy in m and m/s."""

    tick: int
    place: list[float]


class Perception:
    """The sensors of all robots of a match, computed for all robots together."""

    def __init__(self, sensing: Sensing, roster: Roster, streams: RandomStreams, tick: float) -> None:
        self._roster = roster
        self._streams = streams
        self._tick_s = tick
        self._cyan_attacks: int | None = None
        self._under_way: deque[Picture] = deque()
        """Pictures that were taken and are not available to the robots yet."""
        self._undeveloped: tuple[Snapshot, RobotMotions, TeamFrames] | None = None
        """The input of the newest picture until it is developed."""
        self._known = Picture.nothing(len(roster.names))
        self._balls: list[LastSeen | None] = [None] * len(roster.names)
        self.change(sensing)

    def change(self, sensing: Sensing) -> None:
        """Use other sensors from the next tick on; earlier percepts are kept."""
        self.develop()
        roster, streams = self._roster, self._streams
        self._shutter = Shutter.of(sensing, self._tick_s)
        drift = Drift(sensing, roster, streams, self._tick_s)
        signs = {attacks: [complex(side.attack(attacks)) for side in roster.sides] for attacks in (1, -1)}
        self._frames = {
            attacks: BatchedDraws(partial(drift.frames, sign=np.array(signs_then)))
            for attacks, signs_then in signs.items()
        }
        """Sign of the x direction that cyan attacks → the team frames as the robots believe them to lie."""
        self._own = OwnMotion(sensing, roster, streams)
        self._camera = Camera(sensing, roster, streams, self._shutter)

    def with_roster(self, sensing: Sensing, roster: Roster) -> "Perception":
        """The sensors of another roster; robots that remain on their side keep their percepts."""
        self.develop()
        successor, before = Perception(sensing, roster, self._streams, self._tick_s), self._roster
        places = [
            before.names.index(name) if name in before.names and before.side_of(name) is side else None
            for name, side in zip(roster.names, roster.sides, strict=True)
        ]
        successor._cyan_attacks = self._cyan_attacks
        successor._under_way = deque(picture.for_robots(places) for picture in self._under_way)
        successor._known = self._known.for_robots(places)
        successor._balls = [None if place is None else self._balls[place] for place in places]
        return successor

    def at(self, snapshot: Snapshot, cyan_attacks: int) -> Iterator[Percept]:
        """The percepts of all robots, in the order of the roster; call once in every tick, in order.

        They are made when they are read, also in a later tick.
        """
        self.develop()
        if cyan_attacks != self._cyan_attacks:
            self._change_sides()
            self._cyan_attacks = cyan_attacks
        tick, robots = snapshot.tick, snapshot.robots.motions
        frames = self._frames[cyan_attacks].at(tick)
        if self._shutter.takes(tick):
            self._undeveloped = snapshot, robots, frames
            if self._shutter.latency == 0:
                self.develop()
        while self._under_way and self._under_way[0].tick <= tick - self._shutter.latency:
            self._receive(self._under_way.popleft())
        return self._made(tick, self._own, robots, frames, self._known, self._balls.copy())

    def _made(
        self,
        tick: int,
        own: OwnMotion,
        robots: RobotMotions,
        frames: TeamFrames,
        known: Picture,
        balls: list[LastSeen | None],
    ) -> Iterator[Percept]:
        """The percepts of this tick, from what was in force then."""
        age = self._age(known.tick, tick)
        for me, ball, obstacles in zip(own.at(tick, robots, frames), balls, known.obstacles, strict=True):
            if ball is None:
                yield Percept(me, None, 0.0, False, obstacles, age)
            else:
                yield Percept(me, ball.place, self._age(ball.tick, tick), ball.tick == known.tick, obstacles, age)

    def _age(self, since: int, now: int) -> float:
        """s between two ticks."""
        return round((now - since) * self._tick_s, DIGITS)

    def develop(self) -> None:
        """Compute a picture that was taken and is not needed before a later tick; robots can think meanwhile."""
        if self._undeveloped is not None:
            snapshot, robots, frames = self._undeveloped
            self._undeveloped = None
            self._under_way.append(self._camera.take_picture(snapshot, robots, frames))

    def _receive(self, picture: Picture) -> None:
        """Make a picture available to the robots."""
        self._known = picture
        for place, found in enumerate(picture.found):
            if found:
                self._balls[place] = LastSeen(picture.tick, picture.ball[place])

    def _change_sides(self) -> None:
        """Turn all earlier percepts into the team frames of the other direction of play."""
        self._known = self._known.rotated()
        self._under_way = deque(picture.rotated() for picture in self._under_way)
        self._balls = [None if ball is None else LastSeen(ball.tick, rotated_ball(ball.place)) for ball in self._balls]
