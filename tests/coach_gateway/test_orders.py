"""Which order stands, and who has taken it in. Reference 13, row 30: orders are numbered and acknowledged."""

import pytest

from coach_gateway.orders import Fate, OrderBook, OrderWatch
from schemas.bus.in_process import Medium
from schemas.clock import SteppedClock
from schemas.coach import CoachOrder, StandingOrder
from schemas.side import Side
from schemas.topics import STANDING_ORDER


def standing(sequence: int, tick: int = 5, **acknowledged: bool) -> StandingOrder:
    return StandingOrder(
        tick=tick, time=tick * 0.02, order=CoachOrder(sequence=sequence), acknowledged=acknowledged or {"cyan1": False}
    )


def test_an_order_is_unheard_then_stands_then_is_replaced() -> None:
    book = OrderBook()
    assert book.receipt(Side.CYAN, 7).fate is Fate.UNHEARD
    book.take(Side.CYAN, standing(6))
    assert book.receipt(Side.CYAN, 7).fate is Fate.UNHEARD
    book.take(Side.CYAN, standing(7))
    assert book.receipt(Side.CYAN, 7).fate is Fate.STANDS
    assert book.receipt(Side.CYAN, 6).fate is Fate.REPLACED


def test_a_receipt_names_who_has_acknowledged_and_who_has_not() -> None:
    book = OrderBook()
    book.take(Side.CYAN, standing(7, cyan1=True, cyan2=False, cyan3=True))
    receipt = book.receipt(Side.CYAN, 7)
    assert (receipt.acknowledged, receipt.missing) == (("cyan1", "cyan3"), ("cyan2",))
    assert not receipt.is_final
    assert str(receipt) == "acknowledged by cyan1, cyan3; not yet by cyan2"
    book.take(Side.CYAN, standing(7, cyan1=True, cyan2=True, cyan3=True))
    assert book.receipt(Side.CYAN, 7).is_final


def test_each_side_has_its_own_order() -> None:
    book = OrderBook()
    book.take(Side.CYAN, standing(7))
    assert book.standing(Side.MAGENTA) is None
    assert book.receipt(Side.MAGENTA, 7).fate is Fate.UNHEARD


def test_what_is_only_said_again_is_no_news() -> None:
    book = OrderBook()
    assert book.take(Side.CYAN, standing(7, tick=5))
    assert not book.take(Side.CYAN, standing(7, tick=55))
    assert book.take(Side.CYAN, standing(7, tick=60, cyan1=True))
    assert book.take(Side.CYAN, standing(8, tick=61, cyan1=True))


def test_with_another_host_no_order_stands() -> None:
    book = OrderBook()
    book.take(Side.CYAN, standing(7))
    book.forget()
    assert book.standing(Side.CYAN) is None


@pytest.mark.parametrize("payload", [b"{", b"[]", b"\xff"])
def test_the_watch_tells_which_side_there_is_news_of_and_counts_what_it_cannot_read(payload: bytes) -> None:
    medium = Medium()
    host = medium.seat("friendly", SteppedClock())
    watch = OrderWatch(medium.seat("friendly", SteppedClock()))
    assert watch.update() == []
    writer = host.publisher(STANDING_ORDER, side="magenta")
    writer.put(standing(7))
    writer.put_payload(payload)
    host.publisher(STANDING_ORDER, side="lilac").put(standing(7))
    writer.put(standing(7))
    assert watch.update() == [Side.MAGENTA]
    assert watch.unreadable == 2
