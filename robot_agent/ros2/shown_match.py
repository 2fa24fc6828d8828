"""A match or a replay as a ROS 2 graph, with the true places of all bodies, for viewers and tools of ROS."""

from collections.abc import Callable

from runtime.bus.contract import Bus
from runtime.bus.host_watch import HostWatch
from runtime.process.timing import SLICE_S
from runtime.ros2.graph import Graph, GraphPublisher
from runtime.ros2.match_messages import MatchMessages
from runtime.ros2.topic_type import TopicType
from schemas.messages.setup import Setup
from schemas.side import Side
from schemas.topics import EVENT, STATE, WORLD


def show_match(bus: Bus, graph: Graph, setup: Setup, patience: float) -> int:
    """Publish the match until its host has been gone for `patience` s of wall time; returns 0."""
    worlds = bus.subscribe(WORLD)
    others = [bus.subscribe(topic, history=True) for topic in (STATE, EVENT)]
    host, writers = HostWatch(bus), dict[str, GraphPublisher]()

    def write(topic: str, topic_type: TopicType, log_ns: int, encode: Callable[[], memoryview]) -> None:
        del log_ns
        if topic not in writers:
            writers[topic] = graph.publisher(topic, topic_type)
        if writers[topic].is_read:
            writers[topic].put(encode())

    scoring = list(Side) if setup.free is None else []
    messages = MatchMessages(write, setup.sides, scoring)
    while True:
        received = worlds.receive(SLICE_S)
        host.update()
        if received is None and not host.is_reachable() and host.is_given_up(patience):
            return 0
        for subscription in others:
            while (other := subscription.receive()) is not None:
                message = other.message()
                messages.write(round(message.time * 1e9), other.key, message, other.payload)
        if received is not None:
            world = received.message()
            messages.write(round(world.time * 1e9), received.key, world, received.payload)
