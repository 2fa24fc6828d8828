"""What brains draw, in a recording: as sent, drawn for viewers, exported as curves, and without effect on the match."""

import csv
from collections.abc import Callable
from pathlib import Path

import pytest
from foxglove_schemas_protobuf.SceneUpdate_pb2 import SceneUpdate
from mcap.reader import make_reader

from recordings.exchange.csv_files import export
from recordings.reading.recording import open_recording
from recordings.viz.drawing import DRAWINGS
from schemas.config.match_config import load_match
from schemas.topics import COMMAND, DEBUG
from touchline.verify.resimulate import verify

TICKS = 60


@pytest.fixture(scope="module")
def drawn(match_recorder: Callable[..., None], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """1.2 s of a match of one a side, in which both robots draw."""
    path = tmp_path_factory.mktemp("drawn") / "match.mcap"
    teams = {
        f"teams.{side}.{key}": value
        for side in ("cyan", "magenta")
        for key, value in (("size", 1), ("brain", "support.drawing_brain:DrawingBrain"))
    }
    match_recorder(path, load_match(None, {"seed": 4, "duration": 20.0, **teams}), until=TICKS * 0.02)
    return path


def test_drawings_are_recorded_with_the_tick_of_their_sight_in_the_field_frame(drawn: Path) -> None:
    messages = [(recorded, drawing) for recorded, drawing in open_recording(drawn).decoded(DEBUG.fill())]
    assert [drawing.tick for _, drawing in messages if drawing.robot == "cyan1"] == list(range(TICKS))
    for recorded, drawing in messages:
        sign = 1 if drawing.robot == "cyan1" else -1
        assert recorded.log_ns == drawing.tick * 20_000_000
        assert recorded.key == f"team/{drawing.robot[:-1]}/debug/{drawing.robot}"
        assert drawing.debug.values == {"tick": drawing.tick, "gap": 0.25, "plan": "wait"}
        assert (drawing.debug.points[0].x, drawing.debug.points[0].y) == (2.0 * sign, 5.0 * sign)


def test_a_recorded_command_has_its_drawing_as_the_brain_made_it(drawn: Path) -> None:
    commands = [command for _, command in open_recording(drawn).decoded(COMMAND.fill(robot="magenta1"))]
    assert {(command.debug.points[0].x, command.debug.points[0].y) for command in commands} == {(2.0, 5.0)}


def test_a_recording_with_drawings_is_verified(drawn: Path) -> None:
    assert verify(drawn).identical


def test_viewers_draw_every_shape_of_a_robot_until_its_next_drawing(drawn: Path) -> None:
    with drawn.open("rb") as file:
        messages = [message for _, _, message in make_reader(file).iter_messages(topics=[DRAWINGS])]
    assert len(messages) == 2 * TICKS
    entities = [entity for message in messages[-2:] for entity in SceneUpdate.FromString(message.data).entities]
    found = {entity.id: entity for entity in entities}
    assert set(found) == {"debug cyan1", "debug magenta1"}
    for name, sign in (("debug cyan1", 1.0), ("debug magenta1", -1.0)):
        entity = found[name]
        assert entity.frame_id == "map"
        assert entity.lifetime.nanos == 500_000_000
        assert {(one.key, one.value) for one in entity.metadata} >= {("gap", "0.25"), ("plan", "wait")}
        assert (entity.cylinders[0].pose.position.x, entity.cylinders[0].pose.position.y) == (2.0 * sign, 5.0 * sign)
        polygon, circle, line = entity.lines
        assert [point.x for point in polygon.points] == [1.0 * sign, 3.0 * sign, 3.0 * sign]
        assert {round(((p.x - 6 * sign) ** 2 + (p.y - 2 * sign) ** 2) ** 0.5, 6) for p in circle.points} == {1.5}
        assert [point.x for point in line.points] == [4.0 * sign, 8.0 * sign]
        assert entity.texts[0].text == f"drawn by {name.removeprefix('debug ')}"
        assert (round(line.color.r * 255), round(line.color.g * 255), round(line.color.b * 255)) == (0xFE, 1, 2)


def test_values_are_exported_as_curves(drawn: Path, tmp_path: Path) -> None:
    summary = export(open_recording(drawn), tmp_path / "tables")
    assert summary.written["debug.csv"] == 2 * 3 * TICKS
    with (summary.out / "debug.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    curve = [(row["time [s]"], row["number"]) for row in rows if (row["robot"], row["name"]) == ("cyan1", "tick")]
    assert [(float(time), int(number)) for time, number in curve] == [
        (pytest.approx(tick * 0.02), tick) for tick in range(TICKS)
    ]
    assert {(row["number"], row["text"]) for row in rows if row["name"] == "plan"} == {("", "wait")}
    assert DEBUG.fill() not in summary.omitted
