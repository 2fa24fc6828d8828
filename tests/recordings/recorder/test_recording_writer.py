from pathlib import Path

import pytest

from recordings.container.manifest import EndReason, Manifest, Result
from recordings.reading.recording import open_recording
from recordings.recorder.recording_writer import RecordingWriter
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.errors import TouchlineError
from schemas.topics import WORLD
from support.stepped_clock import SteppedClock


def batch(*numbers: int):
    return [(n * 1000, ReceivedMessage(WORLD, "world", b"{}" + b" " * n, Stamp(n, n, n * 1000))) for n in numbers]


@pytest.fixture
def manifest(recorded) -> Manifest:
    return recorded.manifest


RESULT = Result(ended=EndReason.STOPPED, finished="2026-01-01T00:00:00.000+00:00")


def test_an_abandoned_file_keeps_what_was_handed_over(manifest, tmp_path):
    writer = RecordingWriter(tmp_path / "final.mcap", SteppedClock())
    writer.begin(manifest, {})
    for number in range(500):
        writer.write(batch(number))
    writer.abandon()

    recording = open_recording(writer.path)
    assert [message.sequence for message in recording.messages()] == list(range(500))


def test_messages_are_in_the_file_half_a_second_after_they_were_handed_over(manifest, tmp_path):
    clock = SteppedClock()
    writer = RecordingWriter(tmp_path / "final.mcap", clock)
    writer.begin(manifest, {})
    writer.write(batch(1))
    writer.sync()
    flushes = []
    flush = writer._mcap.flush
    writer._mcap.flush = lambda: (flushes.append(clock.now()), flush())
    for number in range(2, 102):
        clock.sleep_until(clock.now() + 0.1)
        writer.write(batch(number))
        while not writer._jobs.empty():
            pass
    writer.abandon()
    assert 15 <= len(flushes) <= 22


def test_a_full_disk_is_one_sentence_and_no_hanging(manifest, tmp_path, monkeypatch):
    def full(_):
        return Path("/dev/full").open("wb")

    monkeypatch.setattr("recordings.recorder.recording_writer.create_part", full)
    writer = RecordingWriter(tmp_path / "final.mcap", SteppedClock())
    writer.begin(manifest, {})
    with pytest.raises(TouchlineError, match=r"final\.mcap: No space left on device"):
        for number in range(1000):
            writer.write(batch(number))
        writer.finish(RESULT)
    writer.abandon()
