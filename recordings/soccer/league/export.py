"""Recording → the league's log, one zip: the world states that the teams would log with perfect sensors."""

import math
from collections.abc import Mapping
from contextlib import ExitStack
from datetime import datetime
from pathlib import Path
from typing import IO, Any
from zipfile import ZIP_DEFLATED, ZipFile

from recordings.editing.atomic_output import ExportSummary, atomic_output
from recordings.reading.recording import Recording
from recordings.soccer.league import LOG_PERIOD
from recordings.soccer.league.game_log import GameLog
from schemas.config.task import GameName
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.messages.soccer.league.robot_numbers import numbers_of
from schemas.messages.soccer.league.world_state import BallSeen, RobotSeen, true_obstacles, world_state
from schemas.messages.world import RobotTruth, World
from schemas.side import Side
from schemas.topics import BELIEF, STATE, WORLD
from schemas.wire.part import encode

_TOPICS = (WORLD, STATE, BELIEF)
FILES = {Side.CYAN: "A", Side.MAGENTA: "B"}
"""Side → letter of its file."""


def export(recording: Recording, out: Path) -> ExportSummary:
    """Write the log of a match.

    Raises:
        TouchlineError: `out` already exists or cannot be written, the recording has no setup or is damaged inside, or
            another game than soccer was played.
    """
    setup = recording.setup
    if setup.game is not GameName.SOCCER:
        raise TouchlineError(f'the match is of the game "{setup.game}", and this log is of soccer')
    with atomic_output(out) as file:
        # a zip is written one file after the other, and both teams' files grow at the same time
        unzipped = {side: file.with_name(f"{letter}.msl") for side, letter in FILES.items()}
        with ExitStack() as files:
            log = _Log(
                recording, setup, {side: files.enter_context(path.open("wb")) for side, path in unzipped.items()}
            )
            for recorded, message in recording.decoded(*(topic.fill() for topic in _TOPICS)):
                log.add(recorded.topic.key, message)
            log.end()
        started = log.started.strftime("%Y%m%d_%H%M%S")
        with ZipFile(file, "w", ZIP_DEFLATED) as archive:
            archive.writestr(f"{started}.msl", "".join(f"{line}\n" for line in log.game.lines))
            for side, letter in FILES.items():
                archive.write(unzipped[side], f"{started}.{letter}.msl")
    written = {f"{started}.{letter}.msl": log.written[side] for side, letter in FILES.items()}
    written[f"{started}.msl"] = len(log.game.lines)
    return ExportSummary.of(recording, out, written, *_TOPICS)


class _Log:
    """Writes the world states of both teams and collects the lines of the referee, message by message."""

    def __init__(self, recording: Recording, setup: Setup, files: Mapping[Side, IO[bytes]]) -> None:
        """The world states of a side are written to its file."""
        self._setup, self._files = setup, files
        self._sides = recording.lineup().sides
        self._numbers = numbers_of(self._sides)
        self._intentions: dict[str, str] = {}
        self._next_time = -math.inf
        self._pending_world: World | None = None
        self.started = datetime.fromisoformat(recording.manifest.started)
        self._start_ms = round(self.started.timestamp() * 1e3)
        self.game = GameLog(self._start_ms, self._sides)
        self.written = dict.fromkeys(Side, 0)
        """Side → records."""

    def add(self, key: str, message: Any) -> None:
        """Add the next message of the recording; a world is held until its tick is complete."""
        if self._pending_world is not None and message.time > self._pending_world.time:
            self.flush()
        if key == WORLD.key:
            self._pending_world = message
        elif key == BELIEF.key:
            self._intentions[message.robot] = message.radio.intention or ""
        else:
            self.game.update(message)

    def end(self) -> None:
        """Complete the files."""
        self.flush()
        for side, file in self._files.items():
            file.write(b"]" if self.written[side] else b"[]")

    def flush(self) -> None:
        """Complete the newest tick."""
        if self._pending_world is not None:
            self._world(self._pending_world)
            self._pending_world = None

    def _world(self, world: World) -> None:
        tick = self._setup.time.tick
        if world.time < self._next_time - tick / 2:
            return
        self._next_time = world.time + max(1, round(LOG_PERIOD / tick)) * tick
        cyan_attacks = self.game.state.cyan_attacks if self.game.state is not None else 1
        for side in Side:
            record = {
                "teamName": self._setup.teams[side].name,
                "timestamp": self._start_ms + round(world.time * 1e3),
                "gametimeMs": round(self.game.game_s(world.clock) * 1e3),
                "worldstate": self._world_state(world, side, side.attack(cyan_attacks)),
            }
            self._files[side].write((b",\n" if self.written[side] else b"[") + encode(record))
            self.written[side] += 1

    def _world_state(self, world: World, side: Side, attack: int) -> dict[str, Any]:
        playing = {name: robot for name, robot in world.robots.items() if robot.off_field is None}
        ball = world.match_ball
        return world_state(
            self._setup.teams[side].name,
            attack,
            [self._robot(name, robot) for name, robot in playing.items() if self._sides.get(name) is side],
            [BallSeen(ball.x, ball.y, ball.z, ball.vx, ball.vy, ball.vz)],
            true_obstacles(side, self._setup.robot.radius, self._sides, world),
        )

    def _robot(self, name: str, robot: RobotTruth) -> RobotSeen:
        motion = (robot.x, robot.y, robot.heading, robot.vx, robot.vy, robot.omega)
        return RobotSeen(self._numbers[name], *motion, robot.holding, self._intentions.get(name, ""))
