"""What the host tells coaches of their orders.

Reference 13, row 29: several robots receive each command, where the paper's first coach reached one alone. Row 30: each
order has a number, and each robot acknowledges it.
"""

import pytest

from schemas.bus.contract import Bus
from schemas.coach import MAX_NUMBER, MAX_STEP, CoachMode, CoachOrder, StandingOrder
from schemas.command import Command
from schemas.host import SetupRequest
from schemas.side import Side
from schemas.sight import Sight
from schemas.topics import INVALID, ORDER, SETUP, STANDING_ORDER


class Obedient:
    """Acknowledges each order, unless told not to."""

    def __init__(self) -> None:
        self.deaf = False

    def act(self, sight: Sight) -> Command:
        heard = sight.order.sequence if sight.order is not None and not self.deaf else None
        return Command(answers_tick=sight.tick, acknowledges_order=heard)


@pytest.fixture
def brains(pitch_of):
    return {}


@pytest.fixture
def pitch(pitch_of, brains):
    made = pitch_of()
    for robot in ("cyan1", "cyan2", "magenta1"):
        brains[robot] = Obedient()
        made.join(robot, brains[robot])
    made.begin()
    return made


def give(bus: Bus, sequence: int, side: Side = Side.CYAN) -> None:
    bus.publisher(ORDER, side=side.value).put(CoachOrder(sequence=sequence, mode=CoachMode.HOLD))


def test_nothing_is_told_while_no_order_stands(pitch) -> None:
    told = pitch.hear(STANDING_ORDER)
    pitch.ticks(120)
    assert told.all() == []


def test_each_robot_of_the_side_gets_the_order_and_is_told_to_have_acknowledged_it(pitch) -> None:
    told = pitch.hear(STANDING_ORDER)
    give(pitch.outside, 7)
    pitch.ticks(3)
    heard: list[StandingOrder] = told.all()
    assert [(one.order.sequence, one.acknowledged) for one in heard] == [
        (7, {"cyan1": False, "cyan2": False}),
        (7, {"cyan1": True, "cyan2": True}),
    ]


def test_a_robot_that_does_not_acknowledge_is_told_by_name(pitch, brains) -> None:
    brains["cyan2"].deaf = True
    give(pitch.outside, 7)
    pitch.ticks(3)
    told = pitch.hear(STANDING_ORDER)
    brains["cyan2"].deaf = False
    pitch.ticks(2)
    (heard,) = told.all()
    assert heard.acknowledged == {"cyan1": True, "cyan2": True}


def test_a_new_order_has_been_acknowledged_by_nobody(pitch) -> None:
    give(pitch.outside, 7)
    pitch.ticks(3)
    told = pitch.hear(STANDING_ORDER)
    give(pitch.outside, 8)
    pitch.ticks(1)
    assert told.all()[0].acknowledged == {"cyan1": False, "cyan2": False}


def test_an_order_with_a_smaller_number_does_not_stand_and_its_sender_is_told_how_to_number(pitch) -> None:
    give(pitch.outside, 7)
    pitch.ticks(3)
    told, invalid = pitch.hear(STANDING_ORDER), pitch.hear(INVALID)
    give(pitch.outside, 6)
    pitch.ticks(60)
    assert {heard.order.sequence for heard in told.all()} == {7}
    (complaint,) = invalid.all()
    assert complaint.key == "team/cyan/order"
    assert complaint.reason == "sequence 6 is not after 7, which stands; number orders from 8 on"


def test_an_order_that_is_said_twice_is_no_fault(pitch) -> None:
    invalid = pitch.hear(INVALID)
    for _ in range(2):
        give(pitch.outside, 7)
        pitch.ticks(1)
    pitch.ticks(2)
    assert invalid.all() == []


@pytest.mark.parametrize("huge", [MAX_NUMBER, MAX_STEP + 8, 10**18], ids=["largest", "too far ahead", "no JSON number"])
def test_an_order_with_a_huge_number_does_not_keep_out_those_after_it(pitch, huge) -> None:
    invalid = pitch.hear(INVALID)
    give(pitch.outside, 7)
    pitch.ticks(1)
    payload = b'{"version":"1.0","sequence":%d,"mode":"park"}' % huge
    pitch.outside.publisher(ORDER, side="cyan").put_payload(payload)
    pitch.ticks(2)
    assert pitch.host.simulation.orders[Side.CYAN].sequence == 7
    (complaint,) = invalid.all()
    assert str(huge) in complaint.reason
    give(pitch.outside, 8)
    pitch.ticks(1)
    assert pitch.host.simulation.orders[Side.CYAN].sequence == 8


def test_whoever_asks_how_the_match_is_set_up_hears_which_numbers_stand(pitch) -> None:
    give(pitch.outside, 1_795_275_009_214_000)
    answer = pitch.outside.ask(SETUP, SetupRequest())
    pitch.ticks(1)
    assert answer.result(0.0).orders == {Side.CYAN: 1_795_275_009_214_000}


def test_what_has_not_changed_is_said_once_a_simulated_second(pitch) -> None:
    give(pitch.outside, 7)
    pitch.ticks(3)
    told = pitch.hear(STANDING_ORDER)
    pitch.ticks(150)
    assert len(told.all()) == 3


def test_sides_are_told_apart(pitch) -> None:
    give(pitch.outside, 7, Side.MAGENTA)
    told = pitch.hear(STANDING_ORDER)
    pitch.ticks(3)
    assert {tuple(heard.acknowledged) for heard in told.all()} == {("magenta1",)}
