from typing import Any

from recordings.recorder.match_progress import MatchProgress
from runtime.bus.contract import ReceivedMessage, Stamp
from schemas.config.roster import RosterEntry
from schemas.messages.applied import Applied
from schemas.side import Side
from schemas.topics import APPLIED

GUEST = RosterEntry(name="magenta3", side=Side.MAGENTA)


def applied(tick: int, **fields: Any) -> ReceivedMessage:
    payload = Applied(tick=tick, time=tick / 50, inputs={}, chain="00", **fields).encode()
    return ReceivedMessage(APPLIED, APPLIED.key, payload, Stamp(tick, 0, 0))


def test_a_change_of_the_roster_is_reported_with_all_robots_that_take_part_from_then_on() -> None:
    progress, rosters = MatchProgress(), []
    progress.roster_changed = rosters.append
    for message in (applied(1), applied(2, robots=[GUEST]), applied(3)):
        progress.update(message)
    assert rosters == [[GUEST]]
    progress.catch_up()
    assert progress.applied is not None
    assert progress.applied.tick == 3


def test_an_input_that_cannot_be_read_is_counted() -> None:
    progress = MatchProgress()
    progress.update(ReceivedMessage(APPLIED, APPLIED.key, b"{", Stamp(1, 0, 0)))
    progress.catch_up()
    assert progress.unreadable == {APPLIED.key: 1}
    assert progress.applied is None
