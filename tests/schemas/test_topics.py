"""The topic table: keys, and what is derived from them."""

import pytest

from schemas.errors import TouchlineError
from schemas.topic import Delivery, Party
from schemas.topics import BELIEF, COMMAND, TOPICS, WORLD


def test_a_key_is_filled_and_read_back() -> None:
    """Names of match, side and robot are chunks of the key."""
    assert BELIEF.fill(side="cyan", robot="cyan1") == "team/cyan/belief/cyan1"
    assert BELIEF.fill(side="cyan") == "team/cyan/belief/*"
    assert BELIEF.match("team/cyan/belief/cyan1") == {"side": "cyan", "robot": "cyan1"}
    assert BELIEF.match("team/cyan/order") is None


def test_a_chunk_that_a_key_does_not_have_is_named() -> None:
    with pytest.raises(TouchlineError, match=r"no chunk \{robt\}; did you mean \"robot\""):
        COMMAND.fill(robt="cyan1")


def test_all_but_sights_questions_and_single_bodies_is_recorded() -> None:
    kept = {name for name, topic in TOPICS.items() if topic.recorded}
    orders = {"order", "standing_order"}
    assert kept == {"world", "command", "belief", "debug", *orders, "state", "event", "applied", "health", "invalid"}


def test_the_truth_is_for_everyone_but_robots() -> None:
    assert Party.ROBOT not in WORLD.readers


def test_nothing_that_robots_read_every_tick_makes_the_host_wait() -> None:
    """A frozen agent must not stop the field: what it reads may be dropped."""
    assert TOPICS["sight"].delivery is Delivery.NEWEST


def test_every_topic_has_a_purpose_and_readers() -> None:
    for topic in TOPICS.values():
        assert topic.description and topic.readers and topic.rate
        assert (topic.delivery is Delivery.QUERY) == (topic.reply is not None)
