"""What the host tells coaches of their orders.

Reference 13, row 29: several robots receive each command, where the paper's first coach reached one alone. Row 30: each
order has a number, and each robot acknowledges it.
"""

import pytest

from schemas.bus.contract import Bus
from schemas.coach import CoachMode, CoachOrder, StandingOrder
from schemas.command import Command
from schemas.side import Side
from schemas.sight import Sight
from schemas.topics import ORDER, STANDING_ORDER


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


def test_an_order_with_a_smaller_number_does_not_stand(pitch) -> None:
    give(pitch.outside, 7)
    pitch.ticks(3)
    told = pitch.hear(STANDING_ORDER)
    give(pitch.outside, 6)
    pitch.ticks(60)
    assert {heard.order.sequence for heard in told.all()} == {7}


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
