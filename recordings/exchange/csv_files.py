"""Recording → CSV: a folder with one file for each kind of data, one row for each observation.

Units are in the header, `x [m]`. Positions are in the field frame, times are simulated time. Numbers are written with
all their digits; unknown values are empty.
"""

import csv
from collections.abc import Callable, Iterable, Sequence
from contextlib import ExitStack
from enum import Enum
from pathlib import Path
from typing import Any, NamedTuple

from recordings.editing.atomic_output import ExportSummary, atomic_output
from recordings.reading.recording import RecordedMessage, Recording
from schemas.messages.command import Command
from schemas.messages.debug import RobotDebug
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.messages.world import World
from schemas.side import Side
from schemas.topics import COMMAND, DEBUG, EVENT, STATE, WORLD

_TOPICS = (WORLD, STATE, EVENT, COMMAND, DEBUG)
Row = tuple[Any, ...]
Sides = dict[str, Side]


class Table(NamedTuple):
    """One file: the key of its messages, its header, and the function that turns a message into rows."""

    key: str
    header: tuple[str, ...]
    rows: Callable[[RecordedMessage, Any, Sides], Iterable[Row]]


def export(recording: Recording, out: Path) -> ExportSummary:
    """Write all files of `TABLES` into a folder, and `robots_wide.csv`.

    Raises:
        TouchlineError: the folder already exists or cannot be written, or the recording is damaged inside.
    """
    sides = recording.lineup().sides
    tables = TABLES | {"robots_wide.csv": _wide([*sides])}
    written = dict.fromkeys(tables, 0)
    with atomic_output(out) as folder, ExitStack() as files:
        folder.mkdir()
        writers: dict[str, list[tuple[str, Any, Table]]] = {}
        for name, table in tables.items():
            file = files.enter_context((folder / name).open("w", newline="", encoding="utf-8"))
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(table.header)
            writers.setdefault(table.key, []).append((name, writer, table))
        for recorded, message in recording.decoded(*(topic.fill() for topic in _TOPICS)):
            for name, writer, table in writers[recorded.topic.key]:
                for row in table.rows(recorded, message, sides):
                    writer.writerow([_plain(value) for value in row])
                    written[name] += 1
    return ExportSummary.of(recording, out, written, *_TOPICS)


def _plain(value: Any) -> Any:
    if isinstance(value, bool):
        return "true" if value else "false"
    return value.value if isinstance(value, Enum) else value


def _robots(_: RecordedMessage, world: World, sides: Sides) -> Iterable[Row]:
    for name, robot in world.robots.items():
        place = (robot.x, robot.y, robot.z, robot.heading, robot.vx, robot.vy, robot.omega)
        yield world.tick, world.time, name, sides.get(name), *place, robot.holding, robot.stuck, robot.off_field


def _wide(robots: Sequence[str]) -> Table:
    """One row a tick with columns for each robot, for programs that plot columns."""

    def rows(_: RecordedMessage, world: World, __: Sides) -> Iterable[Row]:
        found = (world.robots.get(robot) for robot in robots)
        values = (tuple(getattr(one, name, None) for name in _WIDE) for one in found)
        yield world.tick, world.time, *(value for one in values for value in one)

    header = (f"{robot} {name} [{unit}]" for robot in robots for name, unit in _WIDE.items())
    return Table(WORLD.key, ("tick", "time [s]", *header), rows)


_WIDE = {"x": "m", "y": "m", "heading": "rad", "vx": "m/s", "vy": "m/s", "omega": "rad/s"}
"""Field of a robot → its unit, in `robots_wide.csv`."""


def _ball(_: RecordedMessage, world: World, __: Sides) -> Iterable[Row]:
    if (ball := world.ball) is None:
        return
    yield world.tick, world.time, ball.x, ball.y, ball.z, ball.vx, ball.vy, ball.vz, world.possession, world.kicked


def _events(_: RecordedMessage, event: GameEvent, __: Sides) -> Iterable[Row]:
    place = (event.place.x, event.place.y) if event.place is not None else (None, None)
    score = (event.score.cyan, event.score.magenta) if event.score is not None else (None, None)
    involved = (event.side, event.robot, " ".join(event.robots))
    what = (event.tick, event.time, event.clock, event.kind, event.rule)
    measured = (event.measured, event.limit, event.unit)
    yield *what, *involved, *place, *score, *measured, event.card, event.text


def _states(_: RecordedMessage, state: GameState, __: Sides) -> Iterable[Row]:
    spot = (state.spot.x, state.spot.y) if state.spot is not None else (None, None)
    phase = (state.phase, state.side, state.running, state.half, state.stage)
    counts = (state.clock, state.effective, state.score.cyan, state.score.magenta)
    yield state.tick, state.time, *phase, *counts, state.cyan_attacks, *spot, state.value


def _commands(recorded: RecordedMessage, command: Command, __: Sides) -> Iterable[Row]:
    drive, kick, radio = command.drive, command.kick, command.radio
    kicked = (kick.mode, kick.speed) if kick is not None else (None, None)
    radio_fields = (radio.role, radio.intention, radio.pass_to) if radio is not None else (None, None, None)
    moves = (drive.vx, drive.vy, drive.omega, command.dribble)
    yield recorded.time, recorded.key.split("/")[1], command.answers_tick, *moves, *kicked, *radio_fields


def _debug(_: RecordedMessage, drawing: RobotDebug, __: Sides) -> Iterable[Row]:
    for name, value in drawing.debug.values.items():
        is_number = isinstance(value, float | int) and not isinstance(value, bool)
        yield drawing.tick, drawing.time, drawing.robot, name, *((value, None) if is_number else (None, value))


TABLES: dict[str, Table] = {
    "robots.csv": Table(
        WORLD.key,
        (
            *("tick", "time [s]", "robot", "side", "x [m]", "y [m]", "z [m]", "heading [rad]"),
            *("vx [m/s]", "vy [m/s]", "omega [rad/s]", "holding", "stuck", "off_field"),
        ),
        _robots,
    ),
    "ball.csv": Table(
        WORLD.key,
        (
            *("tick", "time [s]", "x [m]", "y [m]", "z [m]", "vx [m/s]", "vy [m/s]", "vz [m/s]"),
            *("possession", "kicked"),
        ),
        _ball,
    ),
    "events.csv": Table(
        EVENT.key,
        (
            *("tick", "time [s]", "clock [s]", "kind", "rule", "side", "robot", "robots", "x [m]", "y [m]"),
            *("score_cyan", "score_magenta", "measured [unit]", "limit [unit]", "unit", "card", "text"),
        ),
        _events,
    ),
    "states.csv": Table(
        STATE.key,
        (
            *("tick", "time [s]", "phase", "side", "running", "half", "stage", "clock [s]", "effective [s]"),
            *("score_cyan", "score_magenta", "cyan_attacks", "spot_x [m]", "spot_y [m]", "value"),
        ),
        _states,
    ),
    "commands.csv": Table(
        COMMAND.key,
        (
            *("time [s]", "robot", "answers_tick", "vx [m/s]", "vy [m/s]", "omega [rad/s]", "dribble"),
            *("kick_mode", "kick_speed [m/s]", "role", "intention", "pass_to"),
        ),
        _commands,
    ),
    "debug.csv": Table(
        DEBUG.key,
        ("tick", "time [s]", "robot", "name", "number", "text"),
        _debug,
    ),
}
"""File → its table. Velocities of a command are in the robot's body frame."""
