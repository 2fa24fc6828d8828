"""What a tick changes for good is read, however its JSON is written."""

import json

import pytest

from message_examples import examples
from recordings.container.applied_changes import changes_in
from schemas.config.roster import RosterEntry
from schemas.messages.applied import Applied
from schemas.side import Side

QUIET = examples()[Applied]
ROSTER = [RosterEntry(name="cyan1", side=Side.CYAN)]


@pytest.mark.parametrize("indent", [None, 1])
@pytest.mark.parametrize(
    "change", [{"robots": ROSTER}, {"obstacles": []}, {"parameters": {"ball.rolling_deceleration": 1.0}}], ids=list
)
def test_a_change_is_found(change, indent) -> None:
    payload = json.dumps(json.loads(QUIET.replace(**change).encode()), indent=indent).encode()
    assert changes_in(payload)
    assert (changes_in(payload).robots is not None) == ("robots" in change)


@pytest.mark.parametrize("payload", [QUIET.encode(), b"", b"[]", b'{"robots":3}', b"\xff"])
def test_nothing_changes_in_a_quiet_tick_and_in_what_is_no_message(payload) -> None:
    assert not changes_in(payload)
