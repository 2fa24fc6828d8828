"""Sessions of coach programs, datagram by datagram, without a socket."""

import json
from typing import Any

import pytest

from coach_gateway.access.roles import TokenRole
from coach_gateway.timing import SILENCE_S
from coach_gateway.udp.coach_programs import MOST_OF_A_ROLE, MOST_WAITING, CoachPrograms, DatagramResult
from coach_gateway.udp.protocol import MAX_BYTES, Ack
from coach_gateway.udp.session import KEPT
from schemas.messages.coach import CoachMode, CoachTest
from schemas.side import Side
from schemas.soccer.game import REFBOX, ActionName

TOKENS = {
    "": TokenRole.SPECTATOR,
    "cyan-token": TokenRole.CYAN,
    "magenta-token": TokenRole.MAGENTA,
    "referee-token": TokenRole.REFEREE,
}
ROBOTS = {"cyan1": Side.CYAN, "cyan2": Side.CYAN, "magenta1": Side.MAGENTA}


class Program:
    """One coach program without a socket."""

    def __init__(self, coaches: CoachPrograms, role: str = "cyan", port: int = 1) -> None:
        self.coaches = coaches
        self.address = ("127.0.0.1", port)
        self.now = 0.0
        self.sequence = 0
        self.session = ""
        ack = self.say("hello", token=f"{role}-token").ack
        assert ack is not None
        self.hello = ack
        self.session = ack.session or ""

    def say(self, kind: str, *, sequence: int | None = None, **words: Any) -> DatagramResult:
        self.sequence = self.sequence + 1 if sequence is None else sequence
        said = {"kind": kind, "sequence": self.sequence, **words}
        if self.session and "session" not in said and kind != "hello":
            said["session"] = self.session
        return self.hear(json.dumps(said).encode())

    def hear(self, data: bytes) -> DatagramResult:
        return self.coaches.handle(data, self.address, self.now, ROBOTS)

    def refusal(self, kind: str, **words: Any) -> str:
        heard = self.say(kind, **words)
        assert heard.request is None and heard.ack is not None and not heard.ack.accepted
        assert heard.ack.sequence == self.sequence
        return heard.ack.reason


@pytest.fixture
def coaches() -> CoachPrograms:
    return CoachPrograms(TOKENS.get)


@pytest.fixture
def cyan(coaches: CoachPrograms) -> Program:
    return Program(coaches)


@pytest.fixture
def referee(coaches: CoachPrograms) -> Program:
    return Program(coaches, "referee", port=2)


@pytest.mark.parametrize("token", ["", "guessed", "cyan-token ", "é"])
def test_an_unknown_token_is_refused(coaches: CoachPrograms, token: str) -> None:
    said = json.dumps({"kind": "hello", "sequence": 1, "token": token}).encode()
    ack = coaches.handle(said, ("127.0.0.1", 9), 0.0, ROBOTS).ack
    assert ack is not None and not ack.accepted and "token" in ack.reason
    assert coaches.sessions == {}


def test_a_hello_that_comes_again_is_answered_with_the_session_that_it_began(cyan: Program) -> None:
    again = cyan.say("hello", token="cyan-token", sequence=1).ack
    assert again is not None and again.duplicate and again.session == cyan.session
    anew = cyan.say("hello", token="cyan-token", sequence=2).ack
    assert anew is not None and not anew.duplicate and anew.session != cyan.session


def test_a_program_that_was_started_again_at_its_old_address_begins_anew(cyan: Program) -> None:
    """It counts from 1 again, and has to be answered at once, not after its earlier session has ended."""
    for _ in range(20):
        cyan.say("alive")
    anew = cyan.say("hello", token="cyan-token", sequence=1).ack
    assert anew is not None and anew.accepted and not anew.duplicate and anew.session != cyan.session
    cyan.session, cyan.sequence = anew.session or "", 1
    assert cyan.say("order", order={"mode": "hold"}).request is not None


def test_a_program_waits_for_its_acknowledgements_before_it_asks_more_but_a_stop_is_always_accepted(
    coaches: CoachPrograms, referee: Program
) -> None:
    deeds = [referee.say("action", action={"action": "goal", "side": "cyan"}).request for _ in range(MOST_WAITING)]
    assert None not in deeds
    assert "8 datagrams of this program still wait" in referee.refusal("action", action={"action": "undo"})
    assert referee.say("action", action={"action": "stop"}).request is not None
    assert referee.say("match_mode", mode="stop").request is not None
    for deed in deeds:
        assert deed is not None
        coaches.finish(deed, Ack(sequence=deed.sequence, of="action", accepted=True))
    assert referee.say("action", action={"action": "undo"}).request is not None


@pytest.mark.parametrize("session", ["", "guessed", "é"])
def test_without_its_session_nothing_is_done(cyan: Program, session: str) -> None:
    assert "unknown session" in cyan.refusal("order", order={"mode": "hold"}, session=session)


def test_another_address_has_no_part_in_a_session(coaches: CoachPrograms, cyan: Program) -> None:
    cyan.address = ("127.0.0.1", 77)
    assert "unknown session" in cyan.refusal("order", order={"mode": "hold"})


def test_an_order_is_for_the_coachs_own_side(cyan: Program) -> None:
    deed = cyan.say("order", order={"mode": "hold", "max_speed": 1.5}).request
    assert deed is not None and deed.order is not None
    assert (deed.sides, deed.order["mode"], deed.order["max_speed"]) == ((Side.CYAN,), CoachMode.HOLD, 1.5)


def test_a_coach_orders_no_robots_of_the_other_side_and_is_no_referee(cyan: Program) -> None:
    assert "not for cyan's coach" in cyan.refusal("order", side="magenta", order={"mode": "hold"})
    assert "referee's token" in cyan.refusal("action", action={"action": "stop"})
    assert "referee's token" in cyan.refusal("match_mode", mode="our_corner")
    assert "not for cyan's coach" in cyan.refusal("match_mode", mode="stop", side="magenta")
    assert "magenta1 is not for cyan's coach" in cyan.refusal(
        "action", action={"action": "repair", "robot": "magenta1"}
    )
    assert cyan.say("action", action={"action": "repair", "robot": "cyan2"}).request is not None


def test_the_whole_coach_record_of_the_paper_goes_through(referee: Program) -> None:
    """Mode, test mode, points, angles, robots, kick, limits, in SI units."""
    order = {
        "tactic": "static pass 2",
        "point_a": {"x": -2.0, "y": 1.0},
        "point_b": {"x": 3.0, "y": -1.5},
        "angle_a": 0.5,
        "angle_b": -0.5,
        "robot_a": "magenta1",
        "robot_b": "magenta2",
        "kick_speed": 8.0,
        "max_speed": 4.5,
        "max_turn_rate": 10.0,
    }
    deed = referee.say("order", side="magenta", order=order, test_mode=13).request
    assert deed is not None and deed.order is not None
    assert deed.sides == (Side.MAGENTA,)
    given = {name: getattr(value, "plain", lambda value=value: value)() for name, value in deed.order.items()}
    assert order.items() <= given.items()
    assert (given["mode"], given["test"]) == (CoachMode.TEST, CoachTest.MOVE)
    assert given["with_ball"] and given["avoid"]
    assert "test_mode is 7; known: 0, 2" in referee.refusal("order", side="magenta", order={}, test_mode=7)
    assert "name its side" in referee.refusal("order", order={})


@pytest.mark.parametrize(
    ("mode", "action", "side"),
    [
        ("their_corner", ActionName.CORNER, Side.CYAN),
        (9, ActionName.CORNER, Side.MAGENTA),
        (0, ActionName.STOP, None),
        (15, ActionName.START, None),
        ("drop_ball", ActionName.DROP_BALL, None),
    ],
)
def test_a_match_mode_of_the_referee_is_an_action(
    referee: Program, mode: str | int, action: ActionName, side: Side | None
) -> None:
    deed = referee.say("match_mode", mode=mode, side="magenta").request
    assert deed is not None and deed.action is not None
    assert (deed.action.action, deed.action.side) == (action, side)


def test_a_match_mode_of_a_coach_is_an_order_to_its_robots(cyan: Program) -> None:
    deed = cyan.say("match_mode", mode="stop").request
    assert deed is not None and (deed.sides, deed.order) == ((Side.CYAN,), {"mode": CoachMode.HOLD})
    assert "names the test" in cyan.refusal("match_mode", mode="test")
    assert "mode is 14; known: 0, 1" in cyan.refusal("match_mode", mode=14)


def test_the_referee_parks_both_sides(referee: Program) -> None:
    deed = referee.say("match_mode", mode="park").request
    assert deed is not None and deed.sides == tuple(Side)


def test_no_program_can_pass_for_the_referee_box_or_another_referee(referee: Program) -> None:
    deed = referee.say("action", action={"action": "start", "source": REFBOX, "referee": "gateway_other"}).request
    assert deed is not None and deed.action is not None
    assert (deed.action.source, deed.action.referee) == ("coach program coach", None)


def test_a_datagram_that_comes_again_is_done_once_and_answered_again(coaches: CoachPrograms, cyan: Program) -> None:
    deed = cyan.say("order", order={"mode": "hold"}).request
    assert deed is not None
    assert cyan.say("order", order={"mode": "hold"}, sequence=2) == DatagramResult()  # it is in progress
    coaches.finish(deed, Ack(sequence=2, of="order", accepted=True, order=77))
    again = cyan.say("order", order={"mode": "hold"}, sequence=2)
    assert again.request is None and again.ack is not None
    assert (again.ack.duplicate, again.ack.order) == (True, 77)


def test_a_late_datagram_is_refused(cyan: Program) -> None:
    cyan.say("order", order={"mode": "hold"}, sequence=5)
    late = cyan.say("order", order={"mode": "play"}, sequence=4)
    assert late.request is None and late.ack is not None and late.ack.reason.startswith("late")


def test_answers_are_kept_for_a_while_and_no_longer(cyan: Program) -> None:
    for _ in range(KEPT + 1):
        cyan.say("alive")
    heard = cyan.say("alive", sequence=2)
    assert heard.ack is not None and "late" in heard.ack.reason
    kept = cyan.say("alive", sequence=KEPT + 1)
    assert kept.ack is not None and kept.ack.duplicate


@pytest.mark.parametrize(
    ("data", "reason", "sequence"),
    [
        (b"", "JSON", None),
        (b"\xff\xfe", "JSON", None),
        (b"[]", "", None),
        (b'{"kind": "order"}', "", None),
        (b'{"kind": "dance", "sequence": 4}', "dance", 4),
        (b'{"kind": "alive", "sequence": 0, "session": ""}', "sequence", 0),
        (b'{"kind": "alive", "sequence": true, "session": ""}', "sequence", None),
        (b'{"kind": "order", "sequence": 6, "session": "", "order": {"mode": "fly"}}', "mode", 6),
        (b'{"kind": "order", "sequence": 6, "session": "", "order": {"max_speed": -1}}', "max_speed", 6),
        (b'{"kind": "order", "sequence": 6, "session": "", "order": {"mode": "test"}}', "needs a test", 6),
        (b'{"kind": "alive", "sequence": 6, "session": "", "more": 1}', "more", 6),
        (b'{"a":' * 1500, "JSON", None),
        (b'{"kind": "hello", "sequence": 6, "token": "", "name": "\\u001b[2J"}', "name", 6),
        (b"x" * (MAX_BYTES + 1), "8193 bytes, at most 8192", None),
    ],
)
def test_what_is_no_datagram_of_the_protocol_is_counted_and_answered(
    coaches: CoachPrograms, data: bytes, reason: str, sequence: int | None
) -> None:
    ack = coaches.handle(data, ("127.0.0.1", 5), 0.0, ROBOTS).ack
    assert ack is not None and not ack.accepted and ack.sequence == sequence
    assert reason in ack.reason and "\n" not in ack.reason
    assert coaches.refusals.counts == {"unreadable datagram": 1}


def test_there_is_room_for_so_many_programs_of_each_role(coaches: CoachPrograms) -> None:
    programs = [Program(coaches, port=port) for port in range(MOST_OF_A_ROLE + 1)]
    assert [program.hello.accepted for program in programs] == [True] * MOST_OF_A_ROLE + [False]
    assert "20 programs with cyan's token are connected" in programs[-1].hello.reason
    assert Program(coaches, "magenta", port=100).hello.accepted
    assert Program(coaches, "referee", port=101).hello.accepted
    programs[0].say("bye")
    assert Program(coaches, port=102).hello.accepted


def test_what_was_captured_is_not_done_again_in_the_next_session(cyan: Program) -> None:
    captured = json.dumps({"kind": "order", "sequence": 2, "session": cyan.session, "order": {"mode": "hold"}}).encode()
    assert cyan.hear(captured).request is not None
    cyan.say("bye", sequence=3)
    cyan.say("hello", sequence=1, token="cyan-token")
    assert cyan.hear(captured).request is None


def test_a_silent_session_ends_and_any_datagram_keeps_it(coaches: CoachPrograms, cyan: Program) -> None:
    session = coaches.sessions[cyan.address]
    cyan.now = SILENCE_S - 0.1
    cyan.say("alive")
    assert not session.is_over(SILENCE_S + 1.0)
    assert session.is_over(2 * SILENCE_S)
