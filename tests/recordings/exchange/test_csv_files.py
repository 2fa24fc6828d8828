import csv
from pathlib import Path

import pytest
from mcap.reader import make_reader

from recordings.exchange.csv_files import TABLES, export
from recordings.reading.recording import Recording, open_recording
from schemas.errors import TouchlineError
from schemas.topics import COMMAND, EVENT, STATE, WORLD


def table(file: Path) -> list[dict[str, str]]:
    with file.open(newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


@pytest.fixture
def folder(recorded: Recording, tmp_path: Path) -> Path:
    return export(recorded, tmp_path / "tables").out


def test_every_file_has_units_in_its_header(folder: Path) -> None:
    assert {file.name for file in folder.iterdir()} == {*TABLES, "robots_wide.csv"}
    for name, kind in TABLES.items():
        header = (folder / name).read_text("utf-8").splitlines()[0].split(",")
        assert header == list(kind.header)
        assert {column for column in header if column in ("x", "time", "heading", "vx", "clock")} == set()


def test_positions_read_back_are_those_recorded_to_the_last_bit(folder: Path, recorded: Recording) -> None:
    robots = {(row["tick"], row["robot"]): row for row in table(folder / "robots.csv")}
    ball = {row["tick"]: row for row in table(folder / "ball.csv")}
    worlds = [world for _, world in recorded.decoded(WORLD.key)]
    assert len(worlds) == len(ball) == 200
    assert len(robots) == sum(len(world.robots) for world in worlds)
    for world in worlds:
        for name, robot in world.robots.items():
            row = robots[str(world.tick), name]
            assert [float(row[column]) for column in ("x [m]", "y [m]", "heading [rad]")] == [
                robot.x,
                robot.y,
                robot.heading,
            ]
            assert row["side"] == ("cyan" if name.startswith("cyan") else "magenta")
        assert float(ball[str(world.tick)]["y [m]"]) == world.ball.y


def test_a_robot_has_columns_of_its_own_in_the_wide_table(folder: Path, recorded: Recording) -> None:
    rows = table(folder / "robots_wide.csv")
    worlds = [world for _, world in recorded.decoded(WORLD.key)]
    assert [int(row["tick"]) for row in rows] == [world.tick for world in worlds]
    for row, world in zip(rows, worlds, strict=True):
        for name, robot in world.robots.items():
            columns = [float(row[f"{name} {column}"]) for column in ("x [m]", "heading [rad]", "vy [m/s]")]
            assert columns == [robot.x, robot.heading, robot.vy]


def test_events_states_and_commands_have_a_row_each(folder: Path, recorded: Recording) -> None:
    events, states, commands = (table(folder / name) for name in ("events.csv", "states.csv", "commands.csv"))
    assert [(row["kind"], row["text"]) for row in events] == [("goal", "goal by cyan2")]
    assert [(row["phase"], row["score_cyan"]) for row in states] == [("play", "0"), ("full_time", "1")]
    assert len(commands) == sum(1 for _ in recorded.messages(COMMAND.fill()))
    assert {(row["vx [m/s]"], row["dribble"], row["kick_mode"]) for row in commands} == {("1.0", "false", "")}
    assert len(events) + len(states) == sum(1 for _ in recorded.messages(EVENT.key, STATE.key))


def test_what_is_there_already_is_not_overwritten(folder: Path, recorded: Recording) -> None:
    with pytest.raises(TouchlineError, match="already exists; remove it"):
        export(recorded, folder)


def test_a_failed_export_leaves_nothing_behind(recorded: Recording, tmp_path: Path) -> None:
    broken = tmp_path / "broken.mcap"
    content = bytearray(recorded.path.read_bytes())
    with recorded.path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    chunk = summary.chunk_indexes[0]
    content[chunk.chunk_start_offset + chunk.chunk_length // 2] ^= 1
    broken.write_bytes(content)
    with pytest.raises(TouchlineError, match=r"broken\.mcap: damaged inside"):
        export(open_recording(broken), tmp_path / "half")
    assert [file.name for file in tmp_path.iterdir() if "half" in file.name] == []


def test_of_a_recording_that_was_cut_off_what_is_before_the_cut_is_exported(
    recorded: Recording, tmp_path: Path
) -> None:
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(recorded.path.read_bytes()[:-40])
    exported = export(open_recording(cut), tmp_path / "cut")
    assert exported.written["ball.csv"] == 200
