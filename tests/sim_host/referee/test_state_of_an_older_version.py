"""The recorded state of a referee that remembered less is compared in what it remembered."""

import json

import pytest

from schemas.game import Phase
from schemas.side import Side
from sim_host.referee.evidence import NO_EVIDENCE
from sim_host.referee.game.participation import CardCount, Participation
from sim_host.referee.game.referee_state import RefereeState
from sim_host.referee.game.state_json import state_from_json, state_json, without_newer_fields
from sim_host.referee.game.timing import Timing

STATE = RefereeState(
    Phase.PLAY,
    Timing(limit=900.0),
    Side.CYAN,
    participation=Participation(cards={"cyan2": CardCount()}),
    evidence=NO_EVIDENCE._replace(outside=((3, 1.5),)),
    offender="cyan2",
)
EVIDENCE = RefereeState._fields.index("evidence")
OUTSIDE = NO_EVIDENCE._fields.index("outside")


def compared(state: RefereeState, text: str) -> RefereeState:
    return without_newer_fields(state, state_from_json(text), text)


def without_last_fields() -> str:
    """The state of a version that had neither the offender nor robots outside the lines."""
    fields = json.loads(state_json(STATE))
    del fields[EVIDENCE][OUTSIDE:]
    del fields[RefereeState._fields.index("offender") :]
    return json.dumps(fields)


def test_what_it_did_not_remember_is_not_compared() -> None:
    text = without_last_fields()
    assert state_from_json(text) != STATE
    assert compared(STATE, text) == state_from_json(text)


@pytest.mark.parametrize(
    "other",
    [
        STATE._replace(phase=Phase.FULL_TIME),
        STATE._replace(half=2),
        STATE._replace(evidence=STATE.evidence._replace(play=STATE.evidence.play._replace(robots=("cyan1",)))),
        STATE._replace(participation=Participation()),
    ],
)
def test_what_it_remembered_is_compared(other: RefereeState) -> None:
    text = without_last_fields()
    assert compared(other, text) != state_from_json(text)


def test_a_state_of_this_version_is_compared_as_a_whole() -> None:
    text = state_json(STATE)
    other = STATE._replace(offender="magenta1")
    assert compared(STATE, text) == STATE
    assert compared(other, text) == other
