"""A recording of version 1.0 of the protocol is read, measured, copied, replayed and verified.

`data/version_1.mcap` has two robots on each side, one of them driven manually, a parameter changed while the match
runs, a ball placed by an operator, and a goal given by a coach.
"""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from recordings.editing.filtering import filter_recording
from recordings.reading.cursor import Cursor
from recordings.reading.recording import Recording, open_recording
from recordings.replay.host import ReplayHost
from recordings.replay.replay import Replay, ReplaySettings
from recordings.viz.drawing import READS, Drawing
from schemas.bus.in_process_bus import InProcessBus, SharedState
from schemas.messages.setup import Setup, SetupRequest
from schemas.process.clock import SteppedClock
from schemas.topics import BELIEF, COMMAND, EVENT, SETUP, STATE, WORLD
from schemas.wire.message import VERSION, BadMessageError
from touchline.command_line import app
from touchline.verify.resimulate import verify

FILE = Path(__file__).parent / "data" / "version_1.mcap"


@pytest.fixture(scope="module")
def recording() -> Recording:
    return open_recording(FILE)


def run(*arguments: str | Path) -> str:
    result = CliRunner().invoke(app, [*map(str, arguments)], prog_name="touchline")
    assert result.exit_code == 0, result.output
    return result.stdout


def test_info_has_its_facts() -> None:
    lines = run("info", FILE).splitlines()
    facts = {line[:13].strip(): line[13:].strip() for line in lines if line}
    assert facts["match"] == "version_one"
    assert facts["score"] == "1 : 0"
    assert facts["duration"] == "16.18 s simulated, from 0.00 to 16.18 s"
    assert facts["last tick"] == "809 at 16.18 s"
    assert facts["messages"] == "5553, 0 lost, 0 sent before it began"


def test_every_message_in_it_is_readable(recording: Recording) -> None:
    versions = {message.version for _, message in recording.decoded()}
    assert versions == {VERSION}
    assert not recording.unreadable


def test_a_cursor_reads_the_same_messages(recording: Recording) -> None:
    cursor, world = Cursor(FILE, keep=lambda key: key == WORLD.key), next(recording.messages(WORLD.key))
    assert cursor.peek() == world
    assert world.version == "1.0" and world.message().version == VERSION


def test_its_messages_are_refused_without_the_conversion(recording: Recording) -> None:
    world = next(recording.messages(WORLD.key))
    with pytest.raises(BadMessageError, match=rf"version 1\.0 is not supported, this side has {VERSION}"):
        WORLD.message.decode(world.payload)


def test_stats_measures_it() -> None:
    assert run("stats", FILE).startswith("cyan 1 : 0 magenta   16.2 s recorded")


def test_it_is_exported(tmp_path: Path) -> None:
    run("export", FILE, "--to", "csv", "--out", tmp_path / "csv")
    assert len((tmp_path / "csv" / "ball.csv").read_text().splitlines()) == 811


def test_viewers_get_its_drawings(recording: Recording) -> None:
    drawing = Drawing(recording.manifest.setup)
    drawn = {
        drawing_of.topic
        for recorded in recording.messages()
        if recorded.topic.key in READS
        for drawing_of in drawing.draw(recorded.received(), recorded.log_ns)
    }
    assert drawn == set(recording.drawn)


def test_it_is_verified() -> None:
    verdict = verify(FILE)
    assert verdict.identical and verdict.ticks == 810


def test_a_copy_keeps_its_bytes_and_its_version(recording: Recording, tmp_path: Path) -> None:
    filter_recording(recording, tmp_path / "copy.mcap", start=5.0)
    copy = open_recording(tmp_path / "copy.mcap")
    originals = {recorded.payload for recorded in recording.messages()}
    copied = list(copy.messages())
    assert copied and {recorded.payload for recorded in copied} <= originals
    assert copy.manifest.contract == "1.0"
    assert copied[-1].message().version == VERSION


def test_a_recording_that_was_cut_off_is_summarized(recording: Recording, tmp_path: Path) -> None:
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(FILE.read_bytes()[:500_000])
    assert "score        1 : 0" in run("info", cut)


@pytest.fixture
def replayed(recording: Recording) -> tuple[InProcessBus, ReplayHost]:
    """A reader on the bus, and the host of a replay as fast as possible."""
    medium, clock = SharedState(), SteppedClock()
    opened = Replay(ReplaySettings(FILE, rate=None))
    host = ReplayHost(
        medium.open_bus("again", clock), recording.manifest.setup, lambda **more: opened.player(clock, **more)
    )
    return medium.open_bus("again", SteppedClock()), host


@pytest.mark.parametrize("topic", [WORLD, STATE, EVENT, COMMAND, BELIEF], ids=lambda topic: topic.key)
def test_a_replay_publishes_messages_of_the_current_version(replayed, recording: Recording, topic) -> None:
    reader, host = replayed
    subscription = reader.subscribe(topic)
    host.run()
    for recorded in recording.messages(topic.fill()):
        received = subscription.receive()
        assert received is not None and received.key == recorded.key
        assert received.message() == recorded.message()
        assert received.message().version == VERSION
    assert subscription.receive() is None


def test_a_replay_replies_with_a_setup_of_the_current_version(replayed) -> None:
    reader, host = replayed
    pending = reader.query(SETUP, SetupRequest())
    host.pump()
    setup: Setup = pending.result(timeout=0.0)
    assert (setup.version, setup.match, setup.teams["cyan"].robots) == (VERSION, "again", ["cyan1", "cyan2"])
