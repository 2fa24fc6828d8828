"""`touchline stats` on a recording made by hand."""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from recordings.container.manifest import EndReason, make_manifest
from recordings.container.manifest import Result as Ending
from recordings.recorder.recording_writer import RecordingWriter
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameState
from schemas.messages.world import BallTruth, RobotTruth, World
from schemas.soccer.game import Phase, Score
from schemas.topics import STATE, WORLD
from support.stepped_clock import SteppedClock
from touchline.commands.cli.command_line import app

ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
"""How the compressed records of a chunk begin."""


def write(path: Path, *, setup: bool = True, worlds: int = 50, **said: Any) -> Path:
    """A robot that drives 0.02 m in each tick of 0.02 s."""
    clock, config = SteppedClock(), load_match(None, said)
    known = Setup.of(config, load_profile("msl"), load_rule_book("friendly")) if setup else None
    writer = RecordingWriter(path, clock)
    writer.begin(make_manifest("friendly", "test", clock, known, config, sights=False), {})
    batch = []
    for tick in range(worlds):
        robot = RobotTruth(x=0.02 * tick, y=0.0, z=0.4, heading=0.0, vx=1.0, vy=0.0, omega=0.0, holding=False)
        ball = BallTruth(x=0.0, y=3.0, z=0.11, vx=0.0, vy=0.0, vz=0.0)
        world = World(tick=tick, time=tick * 0.02, robots={"cyan2": robot}, ball=ball)
        state = GameState(tick=tick, time=tick * 0.02, phase=Phase.PLAY, running=True, score=Score(magenta=3))
        stamp = Stamp(tick, 0, tick * 20_000_000)
        batch += [
            (stamp.sim_ns, ReceivedMessage(topic, topic.key, message.encode(), stamp))
            for topic, message in ((STATE, state), (WORLD, world))
        ]
    writer.write(batch)
    writer.finish(Ending(ended=EndReason.STOPPED, finished=""))
    return path


def stats(*words: str | Path) -> Result:
    return CliRunner().invoke(app, ["stats", *map(str, words)], prog_name="touchline")


def test_a_team_is_called_as_it_calls_itself(tmp_path: Path) -> None:
    """A closing bracket would be markup, and end the command."""
    recording = write(tmp_path / "a.mcap", **{"teams.cyan.name": "[/b]", "teams.magenta.name": ":cat:"})
    assert stats(recording).stdout.startswith("[/b] 0 : 3 :cat:   ")
    about = CliRunner().invoke(app, ["info", str(recording)], prog_name="touchline")
    assert about.exit_code == 0


def test_the_tables_stand_on_the_terminal(tmp_path: Path) -> None:
    result = stats(write(tmp_path / "a.mcap"))
    assert result.exit_code == 0
    assert result.stdout.startswith("Simple 0 : 3 NuBot   1.0 s recorded, ball in play 1.0 s (100 %)")
    (row,) = [line.split() for line in result.stdout.splitlines() if line.startswith("cyan2")]
    assert row[:4] == ["cyan2", "1.0", "1.0", "1.0"]
    assert "no touches recorded" in result.stdout
    assert all(len(line) <= 80 for line in result.stdout.splitlines())


def test_the_figures_are_one_json_object(tmp_path: Path) -> None:
    result = stats(write(tmp_path / "a.mcap"), "--json")
    figures = json.loads(result.stdout)
    assert figures["sides"]["magenta"]["goals"] == 3
    assert figures["robots"][0]["distance"] == 0.98
    assert figures["sides"]["cyan"]["kicks"] is None


def test_the_page_is_written_beside_them(tmp_path: Path) -> None:
    page = tmp_path / "pages" / "a.html"
    result = stats(write(tmp_path / "a.mcap"), "--html", page)
    assert result.exit_code == 0
    assert f"page  {page}" in result.stdout.replace("\n", "")
    assert page.read_text("utf-8").startswith("<!doctype html>")


@pytest.mark.parametrize(
    ("made", "said"), [({"setup": False}, "its manifest has no setup"), ({"worlds": 0}, "has no world")]
)
def test_a_recording_that_cannot_be_measured_is_reported_in_one_line(tmp_path: Path, made, said: str) -> None:
    result = stats(write(tmp_path / "a.mcap", **made), "--html", tmp_path / "a.html")
    assert (result.exit_code, result.stdout) == (2, "")
    assert said in result.stderr and len(result.stderr.splitlines()) == 1
    assert not (tmp_path / "a.html").exists()


def test_a_recording_that_was_cut_off_is_measured_up_to_the_cut(tmp_path: Path) -> None:
    data = write(tmp_path / "a.mcap", worlds=5000).read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(data[: len(data) * 3 // 4])
    result = stats(cut, "--json")
    assert result.exit_code == 0
    assert 1.0 < json.loads(result.stdout)["duration"] < 4999 * 0.02


def test_damage_inside_a_recording_is_reported_and_leaves_no_page(tmp_path: Path) -> None:
    path = write(tmp_path / "a.mcap", worlds=5000)
    data = bytearray(path.read_bytes())
    frame = data.rindex(ZSTD_MAGIC, 0, len(data) // 2)
    data[frame + 100] ^= 0x10
    path.write_bytes(data)
    result = stats(path, "--html", tmp_path / "a.html")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "damaged" in result.stderr and len(result.stderr.splitlines()) == 1
    assert not (tmp_path / "a.html").exists()
