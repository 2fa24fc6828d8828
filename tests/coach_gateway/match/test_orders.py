"""Which order is in force, and which robots have acknowledged it: orders are numbered."""

import pytest

from coach_gateway.match.orders import OrderBook, OrderFollower, OrderStatus
from schemas.messages.coach import ActiveOrder, CoachOrder
from schemas.side import Side
from schemas.topics import ACTIVE_ORDER
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock


def standing(sequence: int, tick: int = 5, **acknowledged: bool) -> ActiveOrder:
    return ActiveOrder(
        tick=tick, time=tick * 0.02, order=CoachOrder(sequence=sequence), acknowledged=acknowledged or {"cyan1": False}
    )


def test_an_order_is_pending_then_active_then_replaced() -> None:
    book = OrderBook()
    assert book.receipt(Side.CYAN, 7).status is OrderStatus.PENDING
    book.update(Side.CYAN, standing(6))
    assert book.receipt(Side.CYAN, 7).status is OrderStatus.PENDING
    book.update(Side.CYAN, standing(7))
    assert book.receipt(Side.CYAN, 7).status is OrderStatus.ACTIVE
    assert book.receipt(Side.CYAN, 6).status is OrderStatus.REPLACED


def test_a_receipt_names_the_robots_that_have_acknowledged_and_those_that_have_not() -> None:
    book = OrderBook()
    book.update(Side.CYAN, standing(7, cyan1=True, cyan2=False, cyan3=True))
    receipt = book.receipt(Side.CYAN, 7)
    assert (receipt.acknowledged, receipt.missing) == (("cyan1", "cyan3"), ("cyan2",))
    assert not receipt.is_final
    assert str(receipt) == "acknowledged by cyan1, cyan3; not yet by cyan2"
    book.update(Side.CYAN, standing(7, cyan1=True, cyan2=True, cyan3=True))
    assert book.receipt(Side.CYAN, 7).is_final


def test_each_side_has_its_own_order() -> None:
    book = OrderBook()
    book.update(Side.CYAN, standing(7))
    assert book.active(Side.MAGENTA) is None
    assert book.receipt(Side.MAGENTA, 7).status is OrderStatus.PENDING


def test_a_repeated_order_is_not_news() -> None:
    book = OrderBook()
    assert book.update(Side.CYAN, standing(7, tick=5))
    assert not book.update(Side.CYAN, standing(7, tick=55))
    assert book.update(Side.CYAN, standing(7, tick=60, cyan1=True))
    assert book.update(Side.CYAN, standing(8, tick=61, cyan1=True))


def test_with_another_host_no_order_is_active() -> None:
    book = OrderBook()
    book.update(Side.CYAN, standing(7))
    book.clear()
    assert book.active(Side.CYAN) is None


@pytest.mark.parametrize("payload", [b"{", b"[]", b"\xff"])
def test_the_follower_returns_the_sides_with_news_and_counts_unreadable_messages(payload: bytes) -> None:
    medium = SharedState()
    host = medium.open_bus("friendly", SteppedClock())
    watch = OrderFollower(medium.open_bus("friendly", SteppedClock()))
    assert watch.update() == []
    writer = host.publisher(ACTIVE_ORDER, side="magenta")
    writer.put(standing(7))
    writer.put_payload(payload)
    host.publisher(ACTIVE_ORDER, side="lilac").put(standing(7))
    writer.put(standing(7))
    assert watch.update() == [Side.MAGENTA]
