"""One conformance suite over both buses: what holds on Zenoh holds within a process, and the other way round."""

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import pytest

from runtime.bus.contract import Bus, BusError, NoReplyError, Subscription
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_client, open_host
from runtime.process.clock import WallClock
from schemas.messages.coach import CoachOrder
from schemas.messages.command import Command
from schemas.messages.soccer.game import ActionReply, GameState, RefereeAction
from schemas.soccer.game import ActionName, Phase
from schemas.topic import Topic
from schemas.topics import ACTION, COMMAND, ORDER, SETUP, SIGHT, STATE, WORLD_BALL, WORLD_ROBOT
from schemas.wire.message import BadMessageError
from support.in_process_bus import SharedState

SOON = 30.0
"""s; more than anything on loopback takes, so that only what never comes fails a test."""
MOMENT = 0.3
"""s; how long a wait lasts that has an end."""


@dataclass
class Buses:
    """A host's bus, and a way to open further ones."""

    host: Bus
    join: Callable[..., Bus]


@pytest.fixture(params=["in_process", "zenoh"])
def buses(request: pytest.FixtureRequest) -> Iterator[Buses]:
    taken: list[Bus] = []
    if request.param == "in_process":
        medium = SharedState()
        host: Bus = medium.open_bus("test", WallClock())

        def join(match: str = "test") -> Bus:
            taken.append(medium.open_bus(match, WallClock()))
            return taken[-1]
    else:
        endpoint = with_free_port("tcp/127.0.0.1:0")
        host = open_host("test", WallClock(), endpoint)

        def join(match: str = "test") -> Bus:
            taken.append(open_client(match, WallClock(), endpoint))
            return taken[-1]

    yield Buses(host, join)
    for bus in [*taken, host]:
        bus.close()


def put_until_heard(put: Callable[[], None], subscription: Subscription) -> Any:
    """A subscription spreads in its own time: put a writer's first messages until one arrives, then take in all."""
    deadline = time.monotonic() + SOON
    first, count = None, 0
    while first is None:
        assert time.monotonic() < deadline, "nothing was heard"
        put()
        count += 1
        first = subscription.receive(0.1)
    last = first
    while last.stamp.sequence < count - 1:  # after the first, all arrive in order
        received = subscription.receive(SOON)
        assert received is not None
        last = received
    return first


def wait_for_all(buses: Buses, reader: Bus) -> None:
    """Until a reader has all that the host sent before: one link brings it in order."""
    last = buses.host.publisher(WORLD_BALL)
    put_until_heard(lambda: last.put_payload(b"that was all"), reader.subscribe(WORLD_BALL))


def state(tick: int) -> GameState:
    return GameState(tick=tick, time=tick * 0.02, phase=Phase.PLAY)


def test_a_message_arrives_as_it_was_sent(buses: Buses) -> None:
    commands = buses.host.subscribe(COMMAND)
    agent = buses.join()
    agent.clock.sim_ns = 840_000_000
    writer = agent.publisher(COMMAND, robot="cyan1")
    received = put_until_heard(lambda: writer.put(Command(answers_tick=42)), commands)
    assert received.message() == Command(answers_tick=42)
    assert received.key == "robot/cyan1/command"
    assert received.chunks == {"robot": "cyan1"}
    assert received.stamp.sim_ns == 840_000_000


def test_a_topic_of_every_message_keeps_all_of_them_in_order_and_without_gaps_in_their_numbers(buses: Buses) -> None:
    reader = buses.join().subscribe(STATE)
    writer = buses.host.publisher(STATE)
    put_until_heard(lambda: writer.put(state(0)), reader)
    for tick in range(1, 201):
        writer.put(state(tick))
    received = [reader.receive(SOON) for _ in range(200)]
    assert [one.message().tick for one in received] == list(range(1, 201))  # type: ignore[union-attr]
    numbers = [one.stamp.sequence for one in received]  # type: ignore[union-attr]
    assert numbers == list(range(numbers[0], numbers[0] + 200))


@pytest.mark.parametrize("topic", [SIGHT, STATE], ids=["newest", "recovered"])
def test_a_late_reader_of_the_newest_message_is_given_it_alone(buses: Buses, topic: Topic) -> None:
    bus, chunks = buses.join(), dict.fromkeys(topic.chunks, "cyan1")
    reader = bus.subscribe(topic, newest=True, **chunks)
    writer = buses.host.publisher(topic, **chunks)
    put_until_heard(lambda: writer.put_payload(b"0"), reader)
    for number in range(1, 6):
        writer.put_payload(str(number).encode())
    wait_for_all(buses, bus)
    assert reader.receive(SOON).payload == b"5"  # type: ignore[union-attr]
    assert reader.receive() is None


def test_a_reader_of_the_past_is_given_what_was_sent_before_it_came(buses: Buses) -> None:
    writer = buses.host.publisher(STATE)
    for tick in range(40):
        writer.put(state(tick))
    late = buses.join()
    knows, does_not = late.subscribe(STATE, history=True), late.subscribe(STATE)
    assert [knows.receive(SOON).message().tick for _ in range(40)] == list(range(40))  # type: ignore[union-attr]
    writer.put(state(40))
    assert knows.receive(SOON).message().tick == 40  # type: ignore[union-attr]
    heard = does_not.receive(MOMENT)
    assert heard is None or heard.message().tick == 40


def test_the_past_of_a_writer_that_comes_later_is_given_too(buses: Buses) -> None:
    bus = buses.join()
    reader = bus.subscribe(STATE, history=True)
    wait_for_all(buses, bus)  # the host knows the subscription then
    writer = buses.host.publisher(STATE)
    for tick in range(5):
        writer.put(state(tick))
    assert [reader.receive(SOON).message().tick for _ in range(5)] == list(range(5))  # type: ignore[union-attr]


def test_the_newest_is_kept_for_each_key_apart(buses: Buses) -> None:
    bus = buses.join()
    reader = bus.subscribe(SIGHT)
    writers = {name: buses.host.publisher(SIGHT, robot=name) for name in ("cyan1", "cyan2")}
    for name, writer in writers.items():
        put_until_heard(lambda w=writer, n=name: w.put_payload(n.encode()), reader)  # type: ignore[misc]
    for round_ in range(3):
        for name, writer in writers.items():
            writer.put_payload(f"{name} {round_}".encode())
    wait_for_all(buses, bus)
    assert sorted(reader.receive(SOON).payload for _ in range(2)) == [b"cyan1 2", b"cyan2 2"]  # type: ignore[union-attr]
    assert reader.receive() is None


def test_one_reader_of_several_keys_yields_the_newest_message_of_each_and_nothing_of_others(buses: Buses) -> None:
    bus = buses.join()
    reader = bus.subscribe_each(SIGHT, robot=["cyan1", "cyan3"])
    writers = {name: buses.host.publisher(SIGHT, robot=name) for name in ("cyan1", "cyan2", "cyan3")}
    for name in ("cyan1", "cyan3"):
        put_until_heard(lambda name=name: writers[name].put_payload(b"first"), reader)  # type: ignore[misc]
    for round_ in range(3):
        for name, writer in writers.items():
            writer.put_payload(f"{name} {round_}".encode())
    wait_for_all(buses, bus)
    found = [reader.receive(SOON) for _ in range(2)]
    assert [(one.key, one.payload) for one in found] == [  # type: ignore[union-attr]
        ("robot/cyan1/sight", b"cyan1 2"),
        ("robot/cyan3/sight", b"cyan3 2"),
    ]
    assert reader.receive() is None


@pytest.mark.parametrize("how", ["bus", "reader"])
def test_a_wait_for_several_keys_has_an_end_and_is_ended_with_its_reader_and_its_bus(buses: Buses, how: str) -> None:
    bus = buses.join()
    reader = bus.subscribe_each(SIGHT, robot=["cyan1", "cyan2"])
    assert bus.subscribe(SIGHT, robot="cyan1").receive(MOMENT) is None
    assert reader.receive(MOMENT) is None
    ending = threading.Timer(MOMENT, bus.close if how == "bus" else reader.close)
    ending.start()
    began = time.monotonic()
    assert reader.receive(SOON) is None
    assert time.monotonic() - began < SOON / 2
    ending.join()
    assert reader.receive(None) is None


def test_a_reader_of_several_keys_needs_each_chunk_of_each_key(buses: Buses) -> None:
    with pytest.raises(BusError, match="needs robot"):
        buses.join().subscribe_each(SIGHT, side=["cyan"])


@pytest.mark.parametrize("other", ["robot", "ball", "match"])
def test_a_reader_of_one_robot_hears_nothing_of_another_of_the_ball_and_of_another_match(
    buses: Buses, other: str
) -> None:
    reader, agent = buses.host.subscribe(WORLD_ROBOT, robot="cyan1"), buses.join()
    mine = agent.publisher(WORLD_ROBOT, robot="cyan1")
    if other == "ball":
        foreign = agent.publisher(WORLD_BALL)
    else:
        bus, robot = (agent, "cyan2") if other == "robot" else (buses.join("another"), "cyan1")
        foreign = bus.publisher(WORLD_ROBOT, robot=robot)
    put_until_heard(lambda: mine.put_payload(b"1"), reader)
    foreign.put_payload(b"2")
    mine.put_payload(b"3")
    assert reader.receive(SOON).payload == b"3"  # type: ignore[union-attr]


def test_who_asks_for_payloads_alone_gets_those_of_the_same_messages(buses: Buses) -> None:
    bus = buses.join()
    sights, states = bus.subscribe(SIGHT, robot="cyan1"), bus.subscribe(STATE)
    writers = buses.host.publisher(SIGHT, robot="cyan1"), buses.host.publisher(STATE)
    for reader, writer in zip((sights, states), writers, strict=True):
        put_until_heard(lambda writer=writer: writer.put_payload(b"0"), reader)  # type: ignore[misc]
        writer.put_payload(b"1")
        assert reader.receive_payload(SOON) == b"1"
        assert reader.receive_payload() is None


def test_an_empty_payload_is_a_message_like_others(buses: Buses) -> None:
    bus = buses.join()
    for topic in (SIGHT, COMMAND):
        reader, writer = bus.subscribe(topic, robot="cyan1"), buses.host.publisher(topic, robot="cyan1")
        put_until_heard(lambda writer=writer: writer.put_payload(b"0"), reader)  # type: ignore[misc]
        writer.put_payload(b"")
        received = reader.receive(SOON)
        assert received is not None and received.payload == b"" and received.stamp is not None


@pytest.mark.parametrize("topic", [COMMAND, SIGHT], ids=["every", "newest"])
def test_a_wait_ends_when_its_time_is_up(buses: Buses, topic: Topic) -> None:
    reader = buses.host.subscribe(topic, robot="cyan1")
    for timeout in (MOMENT, MOMENT / 10):
        began = time.monotonic()
        assert reader.receive(timeout) is None
        assert time.monotonic() - began >= timeout * 0.9


def test_a_wait_that_ends_soon_begins_while_another_lasts(buses: Buses) -> None:
    bus = buses.join()
    long, short = bus.subscribe(STATE), bus.subscribe(SIGHT, robot="cyan1")
    waiter = threading.Thread(target=lambda: long.receive(10 * SOON))
    waiter.start()
    assert short.receive(MOMENT) is None
    assert waiter.is_alive()
    bus.close()
    waiter.join(SOON)
    assert not waiter.is_alive()


@pytest.mark.parametrize("topic", [STATE, SIGHT], ids=["every", "newest"])
def test_a_waiting_reader_is_woken_when_its_bus_is_closed(buses: Buses, topic: Topic) -> None:
    bus = buses.join()
    reader = bus.subscribe(topic, **dict.fromkeys(topic.chunks, "cyan1"))
    done = threading.Event()
    waiter = threading.Thread(target=lambda: (reader.receive(None), done.set()))
    waiter.start()
    bus.close()
    waiter.join(SOON)
    assert done.is_set()
    reader.close()


def test_a_question_is_answered_or_fails_with_a_reason(buses: Buses) -> None:
    server, client = buses.host.serve(ACTION), buses.join()
    answers = [client.query(ACTION, RefereeAction(action=ActionName.STOP), SOON) for _ in range(2)]
    first, second = server.receive(SOON), server.receive(SOON)
    assert first is not None and second is not None
    assert first.message().action is ActionName.STOP
    first.reply(ActionReply(accepted=False, reason="the match is over"))
    second.fail("no referee here")
    assert answers[0].result(SOON).reason == "the match is over"
    with pytest.raises(NoReplyError, match="no referee here"):
        answers[1].result(SOON)


def test_a_query_without_a_server_fails_at_once(buses: Buses) -> None:
    with pytest.raises(NoReplyError, match="no process answers host/setup"):
        buses.join().query(SETUP, RefereeAction(action=ActionName.STOP)).result(SOON)


def test_a_process_is_seen_to_come_and_go(buses: Buses) -> None:
    watch = buses.host.watch_alive()
    assert watch.is_empty()
    bus = buses.join()
    bus.declare_alive("agent", "cyan1")
    came = watch.receive(SOON)
    assert came is not None and (came.kind, came.name, came.alive) == ("agent", "cyan1", True)
    assert watch.is_empty()
    bus.close()
    went = watch.receive(SOON)
    assert went is not None and (went.name, went.alive) == ("cyan1", False)


def test_who_withdraws_its_token_is_seen_to_go_and_may_come_again(buses: Buses) -> None:
    watch = buses.host.watch_alive()
    bus = buses.join()
    bus.withdraw_alive("refbox", "cyan")
    for alive in (True, False, True):
        (bus.declare_alive if alive else bus.withdraw_alive)("refbox", "cyan")
        seen = watch.receive(SOON)
        assert seen is not None and (seen.kind, seen.name, seen.alive) == ("refbox", "cyan", alive)


def test_a_token_that_is_declared_twice_is_one_token(buses: Buses) -> None:
    watch = buses.host.watch_alive()
    bus = buses.join()
    for _ in range(2):
        bus.declare_alive("referee", "gateway_a")
    bus.withdraw_alive("referee", "gateway_a")
    seen = [watch.receive(SOON) for _ in range(2)]
    assert [one.alive for one in seen if one is not None] == [True, False]
    assert watch.is_empty()


def test_connections_have_different_names(buses: Buses) -> None:
    assert len({buses.host.name, buses.join().name, buses.join().name}) == 3


def test_a_watch_begins_with_the_processes_that_are_present(buses: Buses) -> None:
    bus = buses.join()
    bus.declare_alive("recorder", "main")
    first = buses.host.watch_alive().receive(SOON)
    assert first is not None and (first.kind, first.name, first.alive) == ("recorder", "main", True)


def test_rubbish_arrives_as_it_is_and_fails_only_when_read(buses: Buses) -> None:
    commands = buses.host.subscribe(COMMAND)
    writer = buses.join().publisher(COMMAND, robot="cyan1")
    received = put_until_heard(lambda: writer.put_payload(b"\xff" * 20_000), commands)
    with pytest.raises(BadMessageError, match="20000 bytes, at most 12288"):
        received.message()


def test_a_closed_bus_refuses_to_write_and_may_be_closed_again(buses: Buses) -> None:
    bus = buses.join()
    writer = bus.publisher(STATE)
    bus.close()
    bus.close()
    with pytest.raises(BusError, match="closed"):
        writer.put(state(1))
    with pytest.raises(BusError, match="closed"):
        bus.subscribe(STATE)


def test_a_writer_knows_whether_anybody_listens(buses: Buses) -> None:
    writer = buses.host.publisher(WORLD_BALL)
    assert not writer.has_subscribers()
    reader = buses.join().subscribe(WORLD_BALL)
    put_until_heard(lambda: writer.put_payload(b"0"), reader)
    assert writer.has_subscribers()


def test_questions_and_tokens_are_not_published(buses: Buses) -> None:
    with pytest.raises(BusError, match="game/action is not published"):
        buses.host.publisher(ACTION)


def test_a_key_with_a_chunk_left_open_cannot_be_written(buses: Buses) -> None:
    with pytest.raises(BusError, match="needs side"):
        buses.host.publisher(ORDER)


def test_fields_arrive_as_the_message_they_are_laid_out_as(buses: Buses) -> None:
    orders = buses.host.subscribe(ORDER)
    writer = buses.join().publisher(ORDER, side="cyan")
    received = put_until_heard(lambda: writer.put_fields({"sequence": 3, "tactic": "press"}), orders)  # type: ignore[arg-type,return-value]
    assert received.message() == CoachOrder(sequence=3, tactic="press")
