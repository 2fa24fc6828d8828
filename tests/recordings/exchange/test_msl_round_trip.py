"""A match exported to the league's log and imported again is the same match, as far as the log records it."""

import json
import math
import re
import tracemalloc
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from zipfile import ZipFile

import pytest
from typer.testing import CliRunner

from recordings.exchange.formats import EXPORTERS, import_log
from recordings.reading.recording import Recording, open_recording
from recordings.soccer.league import LOG_PERIOD
from recordings.soccer.stats.match_statistics import figures_of_recording
from schemas.messages.soccer.game import GameState
from schemas.messages.world import World
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase
from schemas.topics import EVENT, STATE, WORLD
from support.recorder_rig import RecorderRig
from touchline.commands.cli.command_line import app

PRECISION = 0.5e-3 + 1e-9
"""Three digits after the point."""


@pytest.fixture(scope="module")
def log(real: Recording, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return EXPORTERS["msl-log"].export(real, tmp_path_factory.mktemp("log") / "short.msl.zip").out


@pytest.fixture(scope="module")
def back(log: Path) -> Recording:
    imported = import_log([log], log.with_name("back.mcap"), "msl", None)
    assert imported.lost == []
    assert [one.what for one in imported.left_out] == ["obstacles that a team sees"]
    placed = [finding.what for finding in imported.coped]
    assert all(re.match(r"jump of (robot \d|the ball) of [AB]?", what) for what in placed), placed
    return open_recording(imported.out)


def test_the_files_of_a_log_are_named_by_the_time_at_which_the_match_began(real: Recording, log: Path) -> None:
    began = datetime.fromisoformat(real.manifest.started).strftime("%Y%m%d_%H%M%S")
    with ZipFile(log) as archive:
        assert sorted(archive.namelist()) == [f"{began}.A.msl", f"{began}.B.msl", f"{began}.msl"]


def worlds(recording: Recording) -> dict[int, World]:
    """By time in ms."""
    return {round(world.time * 1e3): world for _, world in recording.decoded(WORLD.key)}


def states(recording: Recording) -> list[GameState]:
    return [state for _, state in recording.decoded(STATE.key)]


def records(log: Path, letter: str) -> list[dict]:  # type: ignore[type-arg]
    with ZipFile(log) as archive:
        (name,) = [name for name in archive.namelist() if name.endswith(f".{letter}.msl")]
        return json.loads(archive.read(name))  # type: ignore[no-any-return]


def test_poses_and_velocities_come_back_within_the_precision_of_the_log(real: Recording, back: Recording) -> None:
    """Positions in mm, both halves, that is both directions of play."""
    before, after = worlds(real), worlds(back)
    halves = {state.half for state in states(real)}
    assert halves == {1, 2}
    assert len(after) > 200
    for time, world in after.items():
        for name, robot in world.robots.items():
            true = before[time].robots[name]
            assert abs(robot.x - true.x) <= PRECISION and abs(robot.y - true.y) <= PRECISION, (time, name)
            assert abs(math.remainder(robot.heading - true.heading, math.tau)) <= PRECISION, (time, name)
            assert abs(robot.vx - true.vx) <= PRECISION and abs(robot.omega - true.omega) <= PRECISION
            assert robot.holding == true.holding
        ball, true_ball = world.ball, before[time].ball
        offs = (ball.x - true_ball.x, ball.y - true_ball.y, ball.z - true_ball.z, ball.vx - true_ball.vx)
        assert max(map(abs, offs)) <= PRECISION, time
        assert world.possession == before[time].possession


def test_every_log_period_has_its_world_with_every_robot(real: Recording, back: Recording) -> None:
    after = worlds(back)
    period = round(LOG_PERIOD * 1e3)
    assert sorted(after) == list(range(min(after), max(after) + 1, period))
    setup = real.manifest.setup
    assert setup is not None
    assert {name for world in after.values() for name in world.robots} == {
        name for team in setup.teams.values() for name in team.robots
    }


def test_score_restarts_and_halves_come_back(real: Recording, back: Recording) -> None:
    def story(recording: Recording) -> list[tuple[Phase, Side | None, int, int, int, int]]:
        told = []
        for state in {state.time: state for state in states(recording)}.values():  # the last word of each moment
            if state.phase in (Phase.PRE_GAME, Phase.PARKING):
                continue
            phase = Phase.PLAY if state.running else state.phase  # a log does not tell when the ball is in play
            side = None if phase is Phase.PLAY else state.side
            entry = (phase, side, state.half, state.cyan_attacks, state.score.cyan, state.score.magenta)
            if not told or told[-1] != entry:
                told.append(entry)
        return told

    assert story(back) == story(real)
    assert len(story(real)) >= 6
    last, true = states(back)[-1], states(real)[-1]
    assert last.phase is Phase.FULL_TIME and last.score == true.score
    assert last.clock == pytest.approx(true.clock, abs=2 * LOG_PERIOD)


def test_a_signal_is_an_event_at_its_time(real: Recording, back: Recording) -> None:
    def starts(recording: Recording) -> list[float]:
        return [event.time for _, event in recording.decoded(EVENT.key) if event.kind is EventKind.START]

    assert starts(back) == pytest.approx(starts(real), abs=1e-3)


def test_the_log_has_the_leagues_axes_for_each_team(real: Recording, log: Path) -> None:
    """+y toward the opponents' goal, +x to the right of it, heading 0 toward it (schema MSLWMD of RefBox)."""
    world = worlds(real)[min(worlds(real))]
    first, second = records(log, "A")[0]["worldstate"], records(log, "B")[0]["worldstate"]
    cyan, magenta = world.robots["cyan1"], world.robots["magenta1"]
    assert first["robots"][0]["pose"] == pytest.approx([-cyan.y, cyan.x, cyan.heading], abs=PRECISION)
    assert second["robots"][0]["pose"][:2] == pytest.approx([magenta.y, -magenta.x], abs=PRECISION)
    assert first["robots"][0]["pose"][1] < -5 and second["robots"][0]["pose"][1] < -5
    assert {one["id"] for one in first["robots"]} == {1, 2}


def test_every_record_has_what_the_leagues_schema_requires(log: Path) -> None:
    """The required fields and their types, from MSLWMD of RefBox."""
    for letter in "AB":
        for record in records(log, letter):
            assert set(record) == {"teamName", "timestamp", "gametimeMs", "worldstate"}
            state = record["worldstate"]
            assert set(state) == {"type", "teamName", "intention", "robots", "balls", "obstacles", "ageMs"}
            assert state["type"] == "worldstate"
            for robot in state["robots"]:
                assert [len(robot[key]) for key in ("pose", "targetPose", "velocity")] == [3, 3, 3]
                assert robot["ballEngaged"] in (0, 1)
            assert [len(ball["position"]) for ball in state["balls"]] == [3]
            assert [len(obstacle["position"]) for obstacle in state["obstacles"]] == [2] * len(state["obstacles"])


def test_the_commands_say_what_they_wrote_and_read(real: Recording, tmp_path: Path) -> None:
    out, back = tmp_path / "short.zip", tmp_path / "back.mcap"
    run = CliRunner()
    exported = run.invoke(app, ["export", str(real.path), "--format", "msl-log", "--out", str(out), "--json"])
    assert exported.exit_code == 0
    assert sum(count for name, count in json.loads(exported.stdout)["written"].items() if ".A." in name) > 200
    imported = run.invoke(app, ["import", str(out), "--out", str(back), "--json"])
    assert imported.exit_code == 0
    said = json.loads(imported.stdout)
    assert said["teams"]["cyan"]["records"] == said["teams"]["cyan"]["read"] > 200
    assert said["not_read"] == []
    assert said["score"] == open_recording(back).result.score.plain()  # type: ignore[union-attr]
    again = run.invoke(app, ["import", str(out), "--out", str(back)])
    assert again.exit_code == 2 and "already exists" in again.stderr


def test_figures_of_an_imported_match_are_those_of_the_match(real: Recording, back: Recording) -> None:
    """The content of a log: score, and the distance each robot drove, here within 2 %."""
    mine, theirs = figures_of_recording(real), figures_of_recording(back)
    assert {side: figures.goals for side, figures in theirs.sides.items()} == {
        side: figures.goals for side, figures in mine.sides.items()
    }
    for robot, true in zip(theirs.robots, mine.robots, strict=True):
        assert robot.name == true.name
        assert robot.distance == pytest.approx(true.distance, rel=0.02, abs=0.05)


def test_a_long_match_takes_no_more_memory_than_a_short_one(
    make_rig: Callable[..., RecorderRig], tmp_path: Path
) -> None:
    """Peak of the export of two recordings, of which one is five times as long."""
    peaks = []
    for ticks in (400, 2000):
        rig = make_rig(path=tmp_path / f"{ticks}.mcap")
        rig.begin()
        rig.play(range(ticks), pump_every=20)
        rig.leave()
        recording = rig.read()
        tracemalloc.start()
        EXPORTERS["msl-log"].export(recording, tmp_path / f"{ticks}.zip")
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < peaks[0] + 300_000  # all records are 3 MB


@pytest.mark.parametrize("to", ["csv", "msl-log", "ros2"])
def test_an_export_lists_what_it_omits(real: Recording, tmp_path: Path, to: str) -> None:
    omitted = {
        "csv": {"host/applied": 1},
        "msl-log": {"game/event": 1, "host/applied": 1, "robot/*/command": 1},
        "ros2": {"host/applied": 1},
    }[to]
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["export", str(real.path), "--format", to, "--out", str(out)])
    assert done.exit_code == 0, done.output
    counts = {channel.key: channel.messages for channel in real.channels}
    commands = sum(count for key, count in counts.items() if key.endswith("/command"))
    listed = [line.split() for line in done.stdout.splitlines() if "have no place in this format" in line]
    assert {words[3] for words in listed} == omitted.keys()
    for words in listed:
        assert int(words[0]) == (commands if words[3] == "robot/*/command" else counts[words[3]])
