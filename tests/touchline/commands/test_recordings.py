"""`touchline diff`, `filter`, `recover` and `info` on recordings made by hand."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from recordings.container.manifest import EndReason, make_manifest
from recordings.container.manifest import Result as Ending
from recordings.recorder.recording_writer import RecordingWriter
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.config.match_config import load_match
from schemas.messages.soccer.game import GameState
from schemas.soccer.game import Phase
from schemas.topics import STATE
from support.stepped_clock import SteppedClock
from touchline.commands.cli.command_line import app


def touchline(*words: str | Path) -> Result:
    return CliRunner().invoke(app, [str(word) for word in words], prog_name="touchline")


def write(
    path: Path,
    *,
    changed_at: int = -1,
    changed: float = 9.5,
    usual: float = 1.0,
    count: int = 50,
    missing: int = 0,
    removed: int = -1,
) -> Path:
    """Game states, one in each tick; one of them differs in its clock, and some numbers are missing at the end."""
    clock = SteppedClock()
    writer = RecordingWriter(path, clock)
    writer.begin(make_manifest("friendly", "test", clock, None, load_match(None), sights=False), {})
    batch = []
    for tick in range(count):
        state = GameState(tick=tick, time=tick * 0.02, phase=Phase.PLAY, clock=changed if tick == changed_at else usual)
        stamp = Stamp(tick + (missing if tick == count - 1 else 0), tick, tick * 20_000_000)
        if tick != removed:
            batch.append((stamp.sim_ns, ReceivedMessage(STATE, STATE.key, state.encode(), stamp)))
    writer.write(batch)
    writer.finish(Ending(ended=EndReason.STOPPED, finished=""))
    return path


def test_the_sign_of_a_zero_is_a_difference(tmp_path):
    """Equal chains need equal bytes, and −0.0 has others than 0.0."""
    one = write(tmp_path / "one.mcap", usual=0.0)
    other = write(tmp_path / "other.mcap", usual=0.0, changed_at=7, changed=-0.0)
    differs = touchline("diff", one, other)
    assert differs.exit_code == 1
    assert "clock" in differs.output and "-0.0" in differs.output


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


def test_seconds_of_a_recording_are_copied(tmp_path: Path) -> None:
    whole = write(tmp_path / "a.mcap")
    assert touchline("filter", whole, "--out", tmp_path / "b.mcap", "--to", "0.5").stdout.endswith("25 messages\n")
    assert touchline("filter", whole, "--out", tmp_path / "c.mcap", "--from", "0.5").stdout.endswith("26 messages\n")


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


def test_the_duration_of_a_filtered_recording_is_its_own(tmp_path: Path) -> None:
    path = write(tmp_path / "a.mcap", count=200)
    touchline("filter", path, "--out", tmp_path / "part.mcap", "--from", "1", "--to", "3")
    facts = json.loads(touchline("info", tmp_path / "part.mcap", "--json").stdout)
    assert (facts["start"], facts["end"]) == (1.0, 2.98)
    assert round(facts["duration"], 6) == 1.98
    assert "1.98 s simulated, from 1.00 to 2.98 s" in touchline("info", tmp_path / "part.mcap").stdout


@pytest.mark.parametrize("removed", [0, 17, 49])
def test_a_missing_message_is_called_missing(tmp_path: Path, removed: int) -> None:
    one, other = write(tmp_path / "a.mcap"), write(tmp_path / "b.mcap", removed=removed)
    for first, second in ((one, other), (other, one)):
        done = touchline("diff", first, second)
        assert done.exit_code == 1
        assert f"game/state, message {removed} at {removed * 0.02:.3f} s is missing in {other}" in done.stdout


def test_only_a_span_of_two_recordings_is_compared(tmp_path: Path) -> None:
    one, other = write(tmp_path / "a.mcap"), write(tmp_path / "b.mcap", changed_at=30)
    assert touchline("diff", one, other, "--from", "0.2", "--to", "0.6").stdout.startswith("identical: 20 messages")
    assert touchline("diff", one, other, "--from", "0.2").exit_code == 1


WRONG_SPANS = {
    ("filter", "--include", "nothing/here"): "none of its keys is selected; `touchline info` lists them",
    ("filter", "--from", "20"): "has no message of the selected keys and times; it lasts from 0.00 to 0.98 s",
    ("filter", "--from", "20", "--to", "10"): "--from is 20 and --to is 10; give a --to that is greater",
    ("diff", "--include", "nothing/here"): "no message is selected; change --include, --exclude, --from or --to",
    ("diff", "--from", "0.5", "--to", "0.5"): "--from is 0.5 and --to is 0.5; give a --to that is greater",
}


@pytest.mark.parametrize("words", WRONG_SPANS)
def test_a_selection_of_nothing_is_refused_in_one_line(tmp_path: Path, words: tuple[str, ...]) -> None:
    path, out = write(tmp_path / "a.mcap"), tmp_path / "out.mcap"
    command, *options = words
    done = touchline(command, path, *(("--out", out) if command == "filter" else (path,)), *options)
    assert done.exit_code == 2
    assert WRONG_SPANS[words] in done.output
    assert done.output.count("\n") == 1
    assert not out.exists()
    assert [file.name for file in tmp_path.iterdir()] == ["a.mcap"]


@pytest.mark.parametrize("time", ["nan", "inf", "-1", "1e300"])
@pytest.mark.parametrize("command", ["replay", "health", "filter", "diff"])
def test_a_time_that_no_recording_has_is_one_line(tmp_path, command, time):
    path = str(write(tmp_path / "a.mcap"))
    more = {"filter": ["--out", str(tmp_path / "out.mcap")], "diff": [path]}.get(command, [])
    result = touchline(command, path, *more, "--from", time)
    assert result.exit_code == 2
    said = " ".join(result.output.split())
    assert "no recording has; give seconds from 0 on" in said and "Traceback" not in said
