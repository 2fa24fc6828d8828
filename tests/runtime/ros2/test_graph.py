"""What arrives at a node of a graph: the thread on which it is handled, its order, faults of callbacks, and floods."""

import threading
from collections.abc import Iterator

import pytest

pytest.importorskip("xxhash")

from runtime.process.clock import WallClock
from runtime.ros2 import graph as graph_module
from runtime.ros2 import topic_type as types
from runtime.ros2.graph import Arrived, Graph, open_graph
from support.process_story import wait_for


@pytest.fixture
def graphs() -> Iterator[tuple[Graph, Graph]]:
    """The node that listens, and another one."""
    with (
        open_graph("touchline", WallClock(), 0, "tcp/127.0.0.1:0", None, 10.0) as graph,
        open_graph("other", WallClock(), 0, None, graph.endpoint, 10.0) as other,
    ):
        yield graph, other


def test_what_one_node_sends_on_several_topics_is_handled_in_its_order_on_one_thread(
    graphs: tuple[Graph, Graph],
) -> None:
    graph, other = graphs
    heard: list[tuple[str, bytes]] = []
    threads: set[int] = set()

    def hear(topic: str) -> None:
        def receive(arrived: Arrived) -> None:
            threads.add(threading.get_ident())
            heard.append((topic, arrived.payload))

        graph.subscribe(topic, types.FLAG, receive)

    for topic in ("/a", "/b", "/c"):
        hear(topic)
    writers = {topic: other.publisher(topic, types.FLAG) for topic in ("/a", "/b", "/c")}
    wait_for(lambda: all(writer.is_read for writer in writers.values()))
    sent = [(topic, f"{number}".encode()) for number in range(30) for topic in writers]
    for topic, payload in sent:
        writers[topic].put(payload)
    wait_for(lambda: len(heard) == len(sent))
    assert heard == sent
    assert len(threads) == 1


def test_each_of_two_subscriptions_to_a_topic_gets_each_message_once(graphs: tuple[Graph, Graph]) -> None:
    graph, other = graphs
    heard: list[int] = []
    for number in (1, 2):
        graph.subscribe("/a", types.FLAG, lambda _, number=number: heard.append(number))  # type: ignore[misc]
    writer = other.publisher("/a", types.FLAG)
    wait_for(lambda: writer.is_read)
    for _ in range(2):
        writer.put(b"1")
    wait_for(lambda: len(heard) >= 4)
    assert heard == [1, 2, 1, 2]


def test_a_callback_that_raises_is_logged_and_later_messages_are_handled(
    graphs: tuple[Graph, Graph], capfd: pytest.CaptureFixture[str]
) -> None:
    graph, other = graphs
    heard: list[bytes] = []

    def receive(arrived: Arrived) -> None:
        if arrived.payload == b"bad":
            raise ZeroDivisionError("a fault of this callback")
        heard.append(arrived.payload)

    graph.subscribe("/a", types.FLAG, receive)
    writer = other.publisher("/a", types.FLAG)
    wait_for(lambda: writer.is_read)
    for payload in (b"bad", b"good"):
        writer.put(payload)
    wait_for(lambda: heard == [b"good"])
    assert "a fault of this callback" in capfd.readouterr().err


def test_of_more_messages_than_may_wait_the_newest_are_handled(
    graphs: tuple[Graph, Graph], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(graph_module, "_BACKLOG", 20)
    graph, other = graphs
    heard: list[int] = []
    may_go_on = threading.Event()

    def receive(arrived: Arrived) -> None:
        may_go_on.wait(30.0)
        heard.append(int(arrived.payload))

    graph.subscribe("/a", types.FLAG, receive)
    last = threading.Event()
    graph.subscribe("/last", types.FLAG, lambda _: last.set())
    writer, ending = other.publisher("/a", types.FLAG), other.publisher("/last", types.FLAG)
    wait_for(lambda: writer.is_read and ending.is_read)
    for number in range(500):
        writer.put(str(number).encode())
    threading.Event().wait(0.5)  # they have arrived, and wait
    may_go_on.set()
    ending.put(b"")
    assert last.wait(30.0)
    assert heard[-1] == 499
    assert len(heard) < 100
