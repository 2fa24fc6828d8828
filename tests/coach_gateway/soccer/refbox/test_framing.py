"""From bytes to messages, however the stream is cut."""

import json
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from coach_gateway.soccer.refbox.framing import Framer
from schemas.messages.soccer.league.box_protocol import BoxProtocol

START = {"command": "START", "targetTeam": ""}
KICKOFF = {"command": "KICKOFF", "targetTeam": "224.16.32.44"}


def wire(*objects: dict[str, Any]) -> bytes:
    return b"".join(json.dumps(one).encode() + b"\x00" for one in objects)


def fed(pieces: list[bytes], **settings: Any) -> tuple[list[Any], int, BoxProtocol]:
    framer = Framer(**settings)
    messages = [message for piece in pieces for message in framer.feed(piece)]
    return messages, framer.garbage, framer.protocol


@pytest.mark.parametrize(
    ("data", "messages", "garbage"),
    [
        (wire(START), [START], 0),
        (wire(START, KICKOFF), [START, KICKOFF], 0),
        (b"\x00\x00" + wire(START), [START], 0),
        (b"\r\n" + wire(START), [START], 0),
        (wire(START)[:-1] + wire(KICKOFF), [START, KICKOFF], 0),
        (wire(START)[:9] + b"\x00" + wire(KICKOFF), [KICKOFF], 1),
        (b'{"broken": {"command": "START"}\x00' + wire(KICKOFF), [KICKOFF], 1),
        (wire(START) + b"noise " + wire(KICKOFF), [START, KICKOFF], 1),
        (wire(START) + b"[1,2]\x00" + wire(KICKOFF), [START, KICKOFF], 1),
        (wire(START) + b'{"a":' * 5000 + b"\x00" + wire(KICKOFF), [START, KICKOFF], 1),
        (b'{"a": "\xff\xfe"}\x00' + wire(KICKOFF), [{"a": "��"}, KICKOFF], 0),
        (wire({"fill": "x" * 2000}) + wire(KICKOFF), [{"fill": "x" * 2000}, KICKOFF], 0),
    ],
)
def test_json_ends_with_a_zero_byte_and_garbage_is_counted(data: bytes, messages: list[Any], garbage: int) -> None:
    assert fed([data]) == (messages, garbage, BoxProtocol.JSON)
    assert fed([data[at : at + 1] for at in range(len(data))]) == (messages, garbage, BoxProtocol.JSON)


@pytest.mark.parametrize(
    ("data", "messages", "garbage"),
    [
        (b"WSKs", ["W", "S", "K", "s"], 0),
        (b"S\x00\r\nk\n", ["S", "k"], 0),
        (b"S?~k\xff", ["S", "k"], 3),
        (b"S K", ["S", " ", "K"], 0),
        (b" \x00S", ["S"], 0),
    ],
)
def test_characters_are_messages_each(data: bytes, messages: list[Any], garbage: int) -> None:
    assert fed([data]) == (messages, garbage, BoxProtocol.CHARACTERS)


def test_a_message_that_is_too_long_is_passed_over_up_to_its_zero_byte() -> None:
    long = wire({"fill": "x" * 500})
    for pieces in ([long + wire(START)], [long[:300], long[300:], wire(START)]):
        assert fed(pieces, limit=100) == ([START], 1, BoxProtocol.JSON)


def test_a_sender_that_never_ends_a_message_fills_no_memory() -> None:
    framer = Framer(limit=1000)
    framer.feed(b"{")
    for _ in range(100):
        framer.feed(b"x" * 500)
    assert framer.garbage == 1
    assert framer.held <= 1000


def test_json_after_a_character_is_not_read_letter_by_letter() -> None:
    """The letters of "command" would be kick-offs, free kicks and goals."""
    assert fed([b"S" + wire(KICKOFF)]) == (["S", KICKOFF], 0, BoxProtocol.JSON)
    assert fed([b"S" + wire(KICKOFF) + b"s"], protocol=BoxProtocol.CHARACTERS) == (
        ["S", "s"],
        1,
        BoxProtocol.CHARACTERS,
    )


def test_characters_where_json_was_announced_are_garbage() -> None:
    assert fed([b"SsK\x00" + wire(START)], protocol=BoxProtocol.JSON) == ([START], 1, BoxProtocol.JSON)


_PARTS = st.one_of(
    st.sampled_from([wire(START), wire(KICKOFF), b"\x00", b"s", b"K", b"{", b"}", b"noise", wire({"fill": "x" * 90})]),
    st.binary(max_size=12),
)


@given(
    parts=st.lists(_PARTS, max_size=12),
    cuts=st.lists(st.integers(0, 400), max_size=12),
    protocol=st.sampled_from(list(BoxProtocol)),
)
def test_any_cut_of_a_stream_gives_the_same_messages(
    parts: list[bytes], cuts: list[int], protocol: BoxProtocol
) -> None:
    data = b"".join(parts)
    edges = [0, *sorted(min(cut, len(data)) for cut in cuts), len(data)]
    pieces = [data[begin:end] for begin, end in pairwise(edges)]
    assert fed(pieces, protocol=protocol, limit=80) == fed([data], protocol=protocol, limit=80)
