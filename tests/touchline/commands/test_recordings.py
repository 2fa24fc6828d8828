"""`touchline diff`, `filter`, `merge`, `recover` and `info` on recordings made by hand."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from recordings.container.manifest import EndReason, make_manifest
from recordings.container.manifest import Result as Ending
from recordings.recorder.recording_writer import RecordingWriter
from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.config.match_config import load_match
from schemas.game import Phase
from schemas.messages.game import GameState
from schemas.process.clock import SteppedClock
from schemas.topics import STATE
from touchline.__main__ import app


def touchline(*words: str | Path) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words], prog_name="touchline")


def write(path: Path, *, changed_at: int = -1, count: int = 50, missing: int = 0) -> Path:
    """Game states, one in each tick; one of them differs, and some numbers are missing at the end."""
    clock = SteppedClock()
    writer = RecordingWriter(path, clock, "friendly")
    writer.begin(make_manifest("friendly", "test", clock, None, load_match(None), sights=False), {})
    batch = []
    for tick in range(count):
        state = GameState(tick=tick, time=tick * 0.02, phase=Phase.PLAY, clock=9.5 if tick == changed_at else 1.0)
        stamp = Stamp(tick + (missing if tick == count - 1 else 0), tick, tick * 20_000_000)
        batch.append((stamp.sim_ns, ReceivedMessage(STATE, STATE.key, state.encode(), stamp)))
    writer.write(batch)
    writer.finish(Ending(ended=EndReason.STOPPED, finished=""))
    return path


def test_recordings_that_say_the_same_are_identical(tmp_path: Path) -> None:
    result = touchline("diff", write(tmp_path / "a.mcap"), write(tmp_path / "b.mcap"))
    assert (result.exit_code, result.stdout) == (0, "identical: 50 messages on 1 keys\n")


def test_the_first_difference_is_a_failure_with_place_field_and_amount(tmp_path: Path) -> None:
    one, other = write(tmp_path / "a.mcap"), write(tmp_path / "b.mcap", changed_at=20)
    result = touchline("diff", one, other)
    assert result.exit_code == 1
    first, *fields = result.stdout.splitlines()
    assert first.startswith("different: game/state, message 20 at 0.400 s; ")
    assert fields == ["  clock: 1.0 – 9.5  (by 8.5)"]
    said = json.loads(touchline("diff", one, other, "--json").stdout)
    assert said["first"]["fields"] == [{"path": "clock", "first": 1.0, "second": 9.5, "by": 8.5}]
    assert (said["identical"], said["first"]["number"]) == (False, 20)


def test_what_one_of_the_two_lacks_is_a_difference(tmp_path: Path) -> None:
    result = touchline("diff", write(tmp_path / "a.mcap"), write(tmp_path / "b.mcap", count=30))
    assert result.exit_code == 1
    assert f"message 30 at 0.600 s is missing in {tmp_path / 'b.mcap'}" in result.stdout


def test_seconds_of_a_recording_are_copied_and_pieces_are_put_together_again(tmp_path: Path) -> None:
    whole = write(tmp_path / "a.mcap")
    assert touchline("filter", whole, "--out", tmp_path / "b.mcap", "--to", "0.5").stdout.endswith("25 messages\n")
    assert touchline("filter", whole, "--out", tmp_path / "c.mcap", "--from", "0.5").stdout.endswith("26 messages\n")
    merged = touchline("merge", tmp_path / "b.mcap", tmp_path / "c.mcap", "--out", tmp_path / "d.mcap")
    assert merged.stdout == f"{tmp_path / 'd.mcap'}: 50 messages; 1 duplicates dropped\n"
    assert touchline("diff", whole, tmp_path / "d.mcap").exit_code == 0


def test_a_recovered_file_and_one_that_was_whole(tmp_path: Path) -> None:
    path = write(tmp_path / "a.mcap")
    assert touchline("recover", path).stdout == f"{path}: intact, 50 messages\n"
    path.write_bytes(path.read_bytes()[:-40])
    (said,) = json.loads(touchline("recover", path, "--json").stdout)
    assert (said["repaired"], said["messages"], said["path"]) == (True, 50, str(path))


def test_info_names_losses_by_key(tmp_path: Path) -> None:
    path = write(tmp_path / "a.mcap", missing=3)
    data = path.read_bytes()
    path.write_bytes(data[: data.index(b"\x06\0\0\0result")])
    assert "game/state 3" in touchline("info", path).stdout
    assert json.loads(touchline("info", path, "--json").stdout)["lost"] == 3


@pytest.mark.parametrize("command", ["info", "recover"])
def test_what_is_no_recording_is_one_line(tmp_path: Path, command: str) -> None:
    path = tmp_path / "a.mcap"
    path.write_text("tick,x,y")
    result = touchline(command, path)
    assert (result.exit_code, result.stderr.count("\n")) == (2, 1)
    assert "not a recording" in result.stderr
