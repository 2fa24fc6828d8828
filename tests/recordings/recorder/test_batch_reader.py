"""Batches read from the bus: what a recorder asks for, when, and what becomes of the answers."""

from collections.abc import Callable
from dataclasses import dataclass

import pytest
from msgspec import Raw

from recordings.recorder.batch_reader import BatchReader
from recordings.timing import QUIET_S
from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import Bus, Query
from runtime.process.timing import GIVE_UP_S, REPLY_S
from schemas.messages.record_batch import RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.topics import RECORD_BATCH, RECORD_BATCHES
from support.in_process_bus import InProcessBus, SharedState
from support.stepped_clock import SteppedClock


@dataclass
class Link:
    """A fake host, and a reader whose link loses chosen batches."""

    host: InProcessBus
    bus: InProcessBus
    stream: int = 1

    def __post_init__(self) -> None:
        self.reader = BatchReader(self.bus)
        self.server = self.host.serve(RECORD_BATCHES)
        self.publisher = self.host.publisher(RECORD_BATCH)

    def batch(self, number: int) -> bytes:
        return RecordBatch(
            stream=self.stream, number=number, tick=8 * number, sent_ns=self.host.clock.unix_ns(), entries=[]
        ).encode()

    def publish(self, *numbers: int) -> None:
        for number in numbers:
            self.publisher.put_payload(self.batch(number))

    def read(self) -> list[int]:
        return [batch.number for batch in self.reader.read()]

    def wait(self, seconds: float) -> list[int]:
        """What is read in so long, looking all the while."""
        found = []
        for _ in range(round(seconds / 0.05)):
            for bus in (self.bus, self.host):
                bus.clock.sleep_until(bus.clock.now() + 0.05)
            found += self.read()
        return found

    def asked(self) -> list[tuple[int, int | None]]:
        """First and last number of each question since this was last called; none is answered."""
        return [(request.first, request.last) for request in self._requests(lambda question: None)]

    def answer(self, *numbers: int, oldest: int = 0, stream: int | None = None) -> list[tuple[int, int | None]]:
        """Answer what was asked."""
        reply = reply_of(stream or self.stream, oldest, [self.batch(number) for number in numbers])
        return [
            (request.first, request.last) for request in self._requests(lambda question: question.reply_payload(reply))
        ]

    def _requests(self, answer: Callable[[Query], None]) -> list[RecordBatchesRequest]:
        requests = []
        while (question := self.server.receive()) is not None:
            requests.append(question.message())
            answer(question)
        return requests


def reply_of(stream: int, oldest: int, batches: list[bytes]) -> bytes:
    """A reply of encoded batches."""
    return RecordBatchesReply(stream=stream, oldest=oldest, batches=[Raw(batch) for batch in batches]).encode()


@pytest.fixture
def link() -> Link:
    medium = SharedState()
    link = Link(medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock()))
    link.publish(0, 1, 2)
    assert link.read() == [0, 1, 2]
    return link


def test_a_gap_is_asked_for_at_once_and_once(link):
    link.publish(5, 6)
    assert link.read() == []
    assert link.asked() == [(3, 4)]
    assert not link.reader.is_complete
    assert link.wait(0.5) == []
    assert link.asked() == []


def test_an_answer_that_was_cut_off_is_asked_again_from_where_it_ended(link):
    link.publish(9)
    link.read()
    link.answer(3, 4, 5)
    assert link.read() == [3, 4, 5]
    assert link.answer(6, 7, 8) == [(6, 8)]
    assert link.read() == [6, 7, 8, 9]


def test_an_answer_that_never_came_is_asked_again(link):
    link.publish(5)
    link.read()
    assert link.asked() == [(3, 4)]
    link.wait(REPLY_S + 0.05)
    assert link.asked() == [(3, 4)]
    link.wait(REPLY_S + 0.05)
    assert link.answer(3, 4) == [(3, 4)]
    assert link.read() == [3, 4, 5]


def test_an_answer_that_never_came_is_asked_for_in_smaller_pieces_until_one_comes(link):
    link.publish(200)
    link.read()
    assert link.asked() == [(3, 199)]
    link.wait(REPLY_S + 0.05)
    assert link.asked() == [(3, 39)]  # 300 are kept, and an eighth of them is asked for
    link.wait(REPLY_S + 0.05)
    assert link.answer(3, 4, 5, 6) == [(3, 6)]
    assert link.read() == [3, 4, 5, 6]
    assert link.asked() == [(7, 14)]
    link.wait(REPLY_S + 0.05)
    assert link.answer(7) == [(7, 7)]
    assert link.read() == [7]


def test_an_answer_that_cannot_be_read_is_asked_again(link):
    link.publish(5)
    link.read()
    link._requests(lambda question: question.reply_payload(b"[]"))
    assert link.wait(0.3) == []
    assert link.answer(3, 4) == [(3, 4)]
    assert link.read() == [3, 4, 5]
    assert link.reader.unreadable == 1


def test_one_batch_of_an_answer_that_cannot_be_read_is_lost_alone(link):
    link.publish(6)
    link.read()
    reply = reply_of(link.stream, 0, [link.batch(3), b'{"number":4}', link.batch(5)])
    link._requests(lambda question: question.reply_payload(reply))
    assert link.read() == [3, 5, 6]
    assert (link.reader.unreadable, link.reader.lost) == (1, 1)


def test_where_nothing_comes_the_host_is_asked_for_newer_batches(link):
    assert link.wait(QUIET_S - 0.1) == []
    assert link.asked() == []
    link.wait(0.2)
    assert link.answer() == [(3, None)]
    link.wait(QUIET_S + 0.2)
    assert link.answer(3, 4) == [(3, None)]
    assert link.read() == [3, 4]


def test_without_a_link_no_question_is_asked_for_newer_batches(link):
    link.bus.connected = lambda: False
    link.wait(3.0)
    assert link.asked() == []


def test_missing_batches_are_given_up_when_no_answer_came_for_long(link):
    link.publish(5)
    assert link.wait(GIVE_UP_S - 1.0) == []
    assert link.wait(2.0) == [5]
    assert link.reader.lost == 2


def test_time_in_which_the_recorder_was_suspended_is_not_waited(link):
    link.publish(5)
    link.read()
    for bus in (link.bus, link.host):
        bus.clock.sleep_until(3600.0)
    assert link.wait(2.0) == []
    assert link.answer(3, 4)
    assert link.read() == [3, 4, 5]


def test_an_answer_of_a_host_that_has_gone_is_passed_over(link):
    link.publish(5)
    link.read()
    old, link.stream = link.stream, 2
    link.publish(0)
    assert link.read() == [5, 0]
    assert link.answer(3, 4, stream=old) == [(3, 4)]
    assert link.read() == []
    link.publish(1)
    assert link.read() == [1]


def test_another_host_is_found_by_its_answer(link):
    """Its first batches went missing, and it stands still now."""
    link.stream = 2
    link.wait(QUIET_S + 0.1)
    assert link.answer(3, 4) == [(3, None)]
    assert link.wait(0.3) == []
    assert link.answer(0, 1, 2) == [(0, 2)]
    assert link.read() == [0, 1, 2, 3, 4]


def test_a_reader_without_any_batch_requests_those_since_its_start():
    medium = SharedState()
    host = medium.open_bus("friendly", SteppedClock())
    batches = BatchPublisher(host)
    batches.send()
    bus: Bus = medium.open_bus("friendly", SteppedClock())
    for one in (bus, host):
        one.clock.sleep_until(5.0)
    reader = BatchReader(bus)
    (subscription,) = medium.subscriptions[f"friendly/{RECORD_BATCH.key}"]
    subscription.deliver = lambda *message: None
    batches.send()
    found = []
    for _ in range(30):
        bus.clock.sleep_until(bus.clock.now() + 0.05)
        batches.process()
        found += [batch.number for batch in reader.read()]
    assert found == [1]
