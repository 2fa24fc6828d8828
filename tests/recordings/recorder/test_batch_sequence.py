"""Batches in the order of their numbers, and which of them are missing."""

import pytest

from recordings.recorder.batch_reader import BatchSequence
from schemas.messages.record_batch import RecordBatch, RecordBatchesRequest

BEGAN_NS = 5
"""Wall time at which the recorder began; batch n is published at time n."""
HOST, ANOTHER = 100, 200


def batch(number: int, stream: int = HOST) -> RecordBatch:
    return RecordBatch(stream=stream, number=number, tick=8 * number, sent_ns=number, entries=[])


class Recorder:
    """Takes in what comes, and keeps what is ready."""

    def __init__(self) -> None:
        self.sequence = BatchSequence(BEGAN_NS)

    def hear(self, *numbers: int, stream: int = HOST) -> list[int]:
        for number in numbers:
            self.sequence.add(batch(number, stream))
        return self.ready()

    def answer(self, *numbers: int, oldest: int = 0) -> list[int]:
        self.sequence.add_requested([(number, batch(number)) for number in numbers], oldest)
        return self.ready()

    def ready(self) -> list[int]:
        ready = [batch.number for batch in self.sequence.ready]
        self.sequence.ready.clear()
        return ready


@pytest.fixture
def recorder() -> Recorder:
    """One that joined late, and has read all since."""
    recorder = Recorder()
    assert recorder.hear(4, 5, 6, 7) == [4, 5, 6, 7]
    return recorder


def missing(first: int, last: int, since_ns: int = 0) -> RecordBatchesRequest:
    return RecordBatchesRequest(first=first, last=last, since_ns=since_ns)


def test_before_the_first_batch_those_since_the_recorder_began_are_missing():
    recorder = Recorder()
    assert recorder.hear(8, 9) == []
    assert recorder.sequence.missing() == missing(0, 7, since_ns=BEGAN_NS)
    assert recorder.answer(5, 6, 7, oldest=5) == [5, 6, 7, 8, 9]
    assert recorder.sequence.lost == 0


def test_a_recorder_whose_clock_is_ahead_misses_nothing_before_its_first_batch():
    assert Recorder().hear(4) == [4]


def test_a_missing_batch_may_come_late_or_twice(recorder):
    assert recorder.hear(9) == []
    assert recorder.hear(8) == [8, 9]
    assert recorder.answer(8, 9) == []
    assert recorder.hear(9) == []


def test_what_the_host_keeps_no_more_is_lost(recorder):
    recorder.hear(20)
    assert recorder.answer(15, 16, 17, 18, 19, oldest=15) == [15, 16, 17, 18, 19, 20]
    assert recorder.sequence.lost == 7


def test_where_the_host_keeps_nothing_of_a_gap_only_the_gap_is_lost(recorder):
    recorder.hear(10, 11)
    assert recorder.answer(oldest=30) == [10, 11]
    assert recorder.sequence.lost == 2
    assert recorder.sequence.missing() is None


def test_what_is_missing_is_given_up_on_demand(recorder):
    recorder.hear(10, 11, 15)
    recorder.sequence.skip_missing()
    assert recorder.ready() == [10, 11, 15]
    assert recorder.sequence.lost == 5
    assert recorder.hear(16) == [16]
