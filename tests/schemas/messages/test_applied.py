"""What the hash chain takes in of a tick: its fields, in one form."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from message_examples import examples
from schemas.messages.applied import Applied, AppliedInput, chained_part, chained_part_of
from schemas.messages.command import Drive
from schemas.wire.message import BadMessageError
from schemas.wire.part import encode

PAYLOAD = examples()[Applied].encode()


def test_it_is_the_message_up_to_the_operators_changes_and_the_chain() -> None:
    part = chained_part_of(PAYLOAD)
    assert part + b',"changes":[],"chain":"%b"}' % json.loads(PAYLOAD)["chain"].encode() == PAYLOAD


def test_the_sentences_of_operators_are_not_part_of_it() -> None:
    content = json.loads(PAYLOAD) | {
        "changes": [{"kind": "scene", "rule": "place", "text": "somebody places the ball"}]
    }
    assert chained_part_of(encode(content)) == chained_part_of(PAYLOAD)


@pytest.mark.parametrize("indent", [None, 2])
def test_spaces_and_the_place_of_the_chain_change_nothing(indent: int | None) -> None:
    content = json.loads(PAYLOAD)
    assert chained_part_of(json.dumps(content, indent=indent).encode()) == chained_part_of(PAYLOAD)
    first = {"chain": content.pop("chain"), **content}
    assert chained_part_of(json.dumps(first, indent=indent).encode()) == chained_part_of(PAYLOAD)


def test_a_chain_inside_an_input_belongs_to_the_fields() -> None:
    content = json.loads(PAYLOAD)
    content["parameters"] = {"chain": 1.0}
    assert b'"parameters":{"chain":1.0}' in chained_part_of(encode(content))


@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), st.booleans())
def test_a_reader_comes_to_the_bytes_that_the_host_hashed(vx: float, vy: float, dribble: bool) -> None:
    inputs = {"cyan1": AppliedInput(Drive(vx=vx, vy=vy), dribble)}
    fields = {"version": "1.0", "tick": 1, "time": 0.1, "placements": [], "inputs": inputs}
    assert chained_part_of(encode({**fields, "chain": "00"})) == chained_part(fields)


@pytest.mark.parametrize("payload", [b"", b"[]", b"\xff", b'{"tick":1'])
def test_what_is_no_object_is_no_message(payload: bytes) -> None:
    with pytest.raises(BadMessageError):
        chained_part_of(payload)
