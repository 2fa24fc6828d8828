"""The order of a key whose messages went missing on the way."""

import pytest

from schemas.bus.contract import ReceivedMessage, Stamp
from schemas.bus.gap_recovery import LOOKBACK, RETRY_S, Gap, GapRecovery
from schemas.recovery_window import GIVE_UP_S
from schemas.topics import WORLD

SUBSCRIBED_NS = 5
"""Wall time of the reader's beginning; message n is sent at time n."""


def message(number: int, key: str = "world") -> ReceivedMessage:
    return ReceivedMessage(WORLD, key, b"%d" % number, Stamp(number, number, 0))


class Reader:
    """Takes in what comes, and keeps what it was given."""

    def __init__(self, since_ns: int = SUBSCRIBED_NS) -> None:
        self.recovery = GapRecovery(since_ns)
        self.given: list[int] = []

    def hear(self, *numbers: int, writer: str = "a", now: float = 0.0, key: str = "world") -> list[int]:
        """What can be given out when these have come."""
        given = []
        for number in numbers:
            received = message(number, key)
            if self.recovery.accept_if_next(received):
                given.append(number)
            else:
                self.recovery.insert(received, writer, now)
                given += self.ready()
        return given

    def answer(self, gap: Gap, *numbers: int, now: float = 1.0) -> list[int]:
        """What can be given out when a question was answered with these."""
        self.recovery.insert_reply(gap, [message(number, gap.key) for number in numbers], now)
        return self.ready()

    def ready(self) -> list[int]:
        ready = [received.stamp.sequence for received in self.recovery.ready]
        self.recovery.ready.clear()
        return ready


@pytest.fixture
def reader() -> Reader:
    """A reader that began before message 5 and has received all since."""
    reader = Reader()
    assert reader.hear(4, 5, 6, 7) == [4, 5, 6, 7]
    return reader


def test_before_the_first_message_of_a_key_is_asked_for_what_was_sent_since_the_reader_began():
    reader = Reader()
    assert reader.hear(8, 9) == []
    (gap,) = reader.recovery.due_requests(0.0)
    assert gap == Gap("world", "a", 0, 8)
    assert reader.answer(gap, *range(9)) == [5, 6, 7, 8, 9]
    assert not reader.recovery.has_gaps


def test_a_first_message_before_which_all_is_older_than_the_reader_is_given_at_once():
    reader = Reader()
    assert reader.hear(4) == [4]
    assert not reader.recovery.has_gaps


def test_who_joins_late_is_brought_no_more_than_some_messages_from_before():
    reader = Reader()
    assert reader.hear(1000) == []
    (gap,) = reader.recovery.due_requests(0.0)
    assert gap == Gap("world", "a", 1000 - LOOKBACK, 1000)
    assert reader.answer(gap, 1000) == [1000]


def test_nothing_is_before_the_message_with_number_0():
    assert Reader(since_ns=0).hear(0, 1) == [0, 1]


def test_what_comes_in_order_passes_and_nothing_is_asked(reader):
    assert reader.recovery.accept_if_next(message(8))
    assert not reader.recovery.has_gaps
    assert reader.recovery.due_requests(100.0) == []


def test_what_comes_behind_a_gap_waits_until_the_gap_is_filled(reader):
    assert reader.hear(10, 11) == []
    assert reader.recovery.due_requests(0.0) == [Gap("world", "a", 8, 10)]
    assert reader.hear(12) == []
    gap = Gap("world", "a", 8, 10)
    assert reader.answer(gap, 8, 9, 10) == [8, 9, 10, 11, 12]
    assert not reader.recovery.has_gaps
    assert reader.recovery.accept_if_next(message(13))


def test_an_answer_that_was_cut_off_is_asked_for_again_from_where_it_ended(reader):
    reader.hear(20, now=1.0)
    (gap,) = reader.recovery.due_requests(1.0)
    assert reader.recovery.due_requests(1.0) == []  # it is on its way
    assert reader.answer(gap, 8, 9, 10, now=2.0) == [8, 9, 10]
    assert reader.recovery.due_requests(2.0) == []
    assert reader.recovery.due_at() == 2.0 + RETRY_S
    assert reader.recovery.due_requests(2.0 + RETRY_S) == [Gap("world", "a", 11, 20)]


def test_a_link_that_stays_away_is_asked_again_and_again(reader):
    reader.hear(20)
    for question in range(10):
        (gap,) = reader.recovery.due_requests(question * RETRY_S)
        assert reader.answer(gap, now=question * RETRY_S) == []
    (gap,) = reader.recovery.due_requests(10 * RETRY_S)
    assert reader.answer(gap, *range(8, 21)) == list(range(8, 21))


def test_what_its_writer_keeps_no_more_is_missing_for_good(reader):
    """The answer reaches to its end, and begins late: the cache has forgotten the rest."""
    reader.hear(20)
    (gap,) = reader.recovery.due_requests(0.0)
    assert reader.answer(gap, 15, 16, 17, 18, 19, 20) == [15, 16, 17, 18, 19, 20]
    assert not reader.recovery.has_gaps


def test_a_second_gap_is_asked_for_when_the_first_is_filled(reader):
    reader.hear(10, 15)
    (gap,) = reader.recovery.due_requests(0.0)
    assert gap == Gap("world", "a", 8, 10)
    assert reader.answer(gap, 8, 9, 10, now=1.0) == [8, 9, 10]
    assert reader.recovery.due_requests(1.0 + RETRY_S) == [Gap("world", "a", 11, 15)]


def test_what_never_comes_is_waited_for_for_a_while_and_given_up(reader):
    assert reader.hear(10, 11, now=3.0) == []
    assert reader.recovery.due_requests(3.0)
    assert reader.recovery.due_at() == 3.0 + GIVE_UP_S
    assert reader.recovery.due_requests(3.0 + GIVE_UP_S) == []
    assert reader.ready() == [10, 11]
    assert reader.recovery.accept_if_next(message(12))


def test_a_gap_that_becomes_smaller_is_waited_for_anew(reader):
    reader.hear(20)
    (gap,) = reader.recovery.due_requests(0.0)
    assert reader.answer(gap, 8, now=GIVE_UP_S - 1.0) == [8]
    (gap,) = reader.recovery.due_requests(GIVE_UP_S + 1.0)
    assert gap == Gap("world", "a", 9, 20)
    assert reader.recovery.due_requests(2 * GIVE_UP_S - 1.0) == []
    assert reader.ready() == [20]


def test_a_gap_in_one_key_holds_no_other_back(reader):
    assert reader.hear(0, key="host/applied") == [0]
    reader.hear(10)
    assert reader.hear(1, 2, key="host/applied") == [1, 2]


def test_a_restarted_publisher_is_not_queried_for_messages_of_its_predecessor(reader):
    reader.hear(10, 11)
    (gap,) = reader.recovery.due_requests(0.0)
    assert reader.hear(0, writer="b") == [10, 11, 0]
    assert reader.answer(gap, 8, 9, 10) == []
    assert reader.hear(1, writer="b") == [1]
    assert not reader.recovery.has_gaps


def test_doubles_and_messages_without_a_number_or_a_known_writer_pass_through(reader):
    assert reader.hear(6) == [6]
    reader.recovery.insert(message(10), None, 0.0)
    reader.recovery.insert(ReceivedMessage(WORLD, "world", b"", None), "a", 0.0)
    assert len(reader.recovery.ready) == 2
    assert not reader.recovery.has_gaps
