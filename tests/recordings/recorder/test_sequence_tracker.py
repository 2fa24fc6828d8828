from recordings.recorder.sequence_tracker import SequenceTracker
from schemas.bus.contract import Stamp


def count(*messages: tuple[int, int]):
    """The counts after messages given as (sequence, wall time of sending)."""
    tracker = SequenceTracker()
    for sequence, sent in messages:
        tracker.add(Stamp(sequence, sent, 0), 10)
    return tracker.count()


def test_an_unbroken_sequence_has_no_losses():
    found = count(*((n, n) for n in range(50)))
    assert (found.messages, found.bytes, found.lost, found.missed_before_start) == (50, 500, 0, 0)


def test_a_gap_is_lost():
    assert count((0, 0), (1, 1), (5, 5)).lost == 3


def test_a_late_message_is_not_lost_after_all():
    found = count((0, 0), (2, 2), (1, 1), (3, 3))
    assert (found.lost, found.late, found.duplicates) == (0, 1, 0)


def test_a_message_that_comes_twice_is_counted_as_doubled():
    found = count((0, 0), (1, 1), (1, 1), (2, 2))
    assert (found.lost, found.duplicates, found.restarts, found.messages) == (0, 1, 0, 4)


def test_a_writer_that_begins_again_has_lost_nothing():
    found = count((0, 0), (1, 1), (2, 2), (0, 9), (1, 10))
    assert (found.lost, found.restarts, found.duplicates) == (0, 1, 0)


def test_a_first_number_above_zero_was_missed_before_the_start():
    found = count((7, 7), (8, 8))
    assert (found.lost, found.missed_before_start) == (0, 7)


def test_an_absurd_gap_costs_no_memory():
    tracker = SequenceTracker()
    tracker.add(Stamp(0, 0, 0), 1)
    tracker.add(Stamp(2**60, 1, 0), 1)
    assert tracker.count().lost == 2**60 - 1
    assert len(tracker._missing) == 0
