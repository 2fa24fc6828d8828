"""The host's messages about the orders of coaches.

Several robots receive each order; in the paper, the coach's socket reached one robot only. Each
order has a number, and each robot acknowledges it.
"""

import pytest

from runtime.bus.contract import Bus
from schemas.messages.coach import MAX_SEQUENCE_STEP, ActiveOrder, CoachMode, CoachOrder, CoachTest
from schemas.messages.command import Command
from schemas.messages.setup import SetupRequest
from schemas.messages.sight import Sight
from schemas.side import Side
from schemas.soccer.game import Point
from schemas.topics import ACTIVE_ORDER, INVALID, ORDER, SETUP
from schemas.wire.units import MAX_WHOLE


class Obedient:
    """Acknowledges each order, unless disabled."""

    def __init__(self) -> None:
        self.deaf = False
        self.refuses = ""

    def act(self, sight: Sight) -> Command:
        heard = sight.order.sequence if sight.order is not None and not self.deaf else None
        return Command(answers_tick=sight.tick, acknowledges_order=heard, refuses_order=self.refuses)


@pytest.fixture
def brains(rig_of):
    return {}


@pytest.fixture
def rig(rig_of, brains):
    made = rig_of()
    for robot in ("cyan1", "cyan2", "magenta1"):
        brains[robot] = Obedient()
        made.join(robot, brains[robot])
    made.begin()
    return made


def give(bus: Bus, sequence: int, side: Side = Side.CYAN) -> None:
    bus.publisher(ORDER, side=side.value).put(CoachOrder(sequence=sequence, mode=CoachMode.HOLD))


def test_nothing_is_published_while_no_order_is_in_force(rig) -> None:
    told = rig.listen(ACTIVE_ORDER)
    rig.ticks(120)
    assert told.all() == []


def test_each_robot_of_the_side_gets_the_order_and_its_acknowledgement_is_published(rig) -> None:
    told = rig.listen(ACTIVE_ORDER)
    give(rig.outside, 7)
    rig.ticks(3)
    heard: list[ActiveOrder] = told.all()
    assert [(one.order.sequence, one.acknowledged) for one in heard] == [
        (7, {"cyan1": False, "cyan2": False}),
        (7, {"cyan1": True, "cyan2": True}),
    ]


def test_a_robot_that_does_not_acknowledge_is_reported_by_name(rig, brains) -> None:
    told = rig.listen(ACTIVE_ORDER)
    brains["cyan2"].deaf = True
    give(rig.outside, 7)
    rig.ticks(3)
    assert told.all()[-1].acknowledged == {"cyan1": True, "cyan2": False}


def test_a_new_order_is_not_acknowledged_by_any_robot(rig) -> None:
    give(rig.outside, 7)
    rig.ticks(3)
    told = rig.listen(ACTIVE_ORDER)
    give(rig.outside, 8)
    rig.ticks(1)
    assert told.all()[0].acknowledged == {"cyan1": False, "cyan2": False}


def test_an_order_with_a_smaller_number_is_refused_with_the_remedy(rig) -> None:
    give(rig.outside, 7)
    rig.ticks(3)
    told, invalid = rig.listen(ACTIVE_ORDER), rig.listen(INVALID)
    give(rig.outside, 6)
    rig.ticks(60)
    assert {heard.order.sequence for heard in told.all()} == {7}
    (complaint,) = invalid.all()
    assert complaint.key == "team/cyan/order"
    assert complaint.reason == "sequence 6 is not above 7, which is in force; number orders from 8 on"


def test_an_order_that_is_sent_twice_is_no_fault(rig) -> None:
    invalid = rig.listen(INVALID)
    for _ in range(2):
        give(rig.outside, 7)
        rig.ticks(1)
    rig.ticks(2)
    assert invalid.all() == []


@pytest.mark.parametrize(
    "huge", [MAX_WHOLE, MAX_SEQUENCE_STEP + 8, 10**18], ids=["largest", "too far ahead", "no JSON number"]
)
def test_an_order_with_a_huge_number_does_not_keep_out_those_after_it(rig, huge) -> None:
    invalid = rig.listen(INVALID)
    give(rig.outside, 7)
    rig.ticks(1)
    payload = b'{"version":"2.0","sequence":%d,"mode":"park"}' % huge
    rig.outside.publisher(ORDER, side="cyan").put_payload(payload)
    rig.ticks(2)
    assert rig.host.simulation.orders[Side.CYAN].sequence == 7
    (complaint,) = invalid.all()
    assert str(huge) in complaint.reason
    give(rig.outside, 8)
    rig.ticks(1)
    assert rig.host.simulation.orders[Side.CYAN].sequence == 8


def test_whoever_asks_how_the_match_is_set_up_hears_which_numbers_stand(rig) -> None:
    give(rig.outside, 1_795_275_009_214_000)
    answer = rig.outside.query(SETUP, SetupRequest())
    rig.ticks(1)
    assert answer.result(0.0).orders == {Side.CYAN: 1_795_275_009_214_000}


def test_an_unchanged_order_is_published_once_a_simulated_second(rig) -> None:
    give(rig.outside, 7)
    rig.ticks(3)
    told = rig.listen(ACTIVE_ORDER)
    rig.ticks(150)
    assert len(told.all()) == 3


def test_each_side_has_its_own_order(rig) -> None:
    give(rig.outside, 7, Side.MAGENTA)
    told = rig.listen(ACTIVE_ORDER)
    rig.ticks(3)
    assert {tuple(heard.acknowledged) for heard in told.all()} == {("magenta1",)}


def test_a_robot_that_refuses_an_order_is_published_with_its_reason(rig, brains) -> None:
    told = rig.listen(ACTIVE_ORDER)
    brains["cyan2"].refuses = "unknown test: machine"
    give(rig.outside, 7)
    rig.ticks(4)
    active: ActiveOrder = told.all()[-1]
    assert active.acknowledged == {"cyan1": True, "cyan2": True}
    assert active.refused == {"cyan2": "unknown test: machine"}


def test_an_order_to_a_point_outside_the_field_is_refused_with_the_reason(rig) -> None:
    told, refused = rig.listen(ACTIVE_ORDER), rig.listen(INVALID)
    order = CoachOrder(
        sequence=7, mode=CoachMode.TEST, test=CoachTest.MOVE, robot_a="cyan1", point_a=Point(x=0.0, y=-50.0)
    )
    rig.outside.publisher(ORDER, side="cyan").put(order)
    rig.ticks(20)
    assert told.all() == []
    assert "point_a at (0, -50) is outside the field and its border" in refused.all()[0].reason
