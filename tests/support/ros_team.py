"""Robots played by ROS 2 nodes that this project did not write: pyzeros, or the SDK of ROBOTIS. A process of its own.

`python ros_team.py [--twist] [--dribble] {pyzeros,sdk} ENDPOINT ROBOT...` drives the robots in circles, a command each
`/clock`, until it is ended; with `--dribble` the SDK switches their dribblers on. `python ros_team.py list ENDPOINT`
prints the topics and services of the graph as JSON.
"""

import argparse
import asyncio
import json
import os
import sys
import tempfile
import threading
from typing import Any

os.environ.setdefault("CYDR_CACHE_DIR", f"{tempfile.gettempdir()}/touchline-tests-cydr")
"""Where pyzeros keeps the types that it has compiled."""
os.environ["CFLAGS"] = "-O0"
"""They are compiled in a third of the time."""
SPEED, TURN = 1.0, 0.5
"""m/s and rad/s of each command."""
CLOCK_HASH = "RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"
TWIST_HASH = "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"
STAMPED_HASH = "RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"
FLAG_HASH = "RIHS01_feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9"
TEXTS = {
    "std_msgs/msg/Bool": "bool data\n",
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "geometry_msgs/msg/Vector3": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Twist": "Vector3 linear\nVector3 angular\n",
    "geometry_msgs/msg/TwistStamped": "std_msgs/Header header\nTwist twist\n",
    "rosgraph_msgs/msg/Clock": "builtin_interfaces/Time clock\n",
}


async def play_pyzeros(endpoint: str, robots: list[str], is_stamped: bool) -> None:
    import pyzeros
    import zenoh
    from ros2_pyterfaces.cydr import all_msgs as messages

    config = zenoh.Config()
    for key, value in {"connect/endpoints": [endpoint], "scouting/multicast/enabled": False}.items():
        config.insert_json5(key, json.dumps(value))
    with zenoh.open(config) as session, pyzeros.auto_context("team", zenoh_session=session, namespace="/foreign"):
        clock = pyzeros.Sub(messages.Clock, "/clock")
        message_type = messages.TwistStamped if is_stamped else messages.Twist
        messages.Clock.deserialize(messages.Clock().serialize())
        # compiles message and attachment, which takes seconds, before a robot is driven
        pyzeros.Pub(message_type, "compiled").publish(message_type())
        publishers = [pyzeros.Pub(message_type, f"/{robot}/cmd_vel") for robot in robots]
        async for told in clock.listen_reliable():
            twist = messages.Twist(linear=messages.Vector3(x=SPEED), angular=messages.Vector3(z=TURN))
            command: Any = twist
            if is_stamped:
                command = messages.TwistStamped(header=messages.Header(stamp=told.clock), twist=twist)
            for publisher in publishers:
                publisher.publish(command)


def play_sdk(endpoint: str, robots: list[str], is_stamped: bool, dribbles: bool) -> None:
    from zenoh_ros2_sdk import ROS2Publisher, ROS2Subscriber
    from zenoh_ros2_sdk.session import ZenohSession

    ip, port = endpoint.removeprefix("tcp/").split(":")
    at: dict[str, Any] = {"router_ip": ip, "router_port": int(port)}
    manager = ZenohSession.get_instance(ip, int(port))
    types = {name: manager.register_message_type(text, name) for name, text in TEXTS.items()}
    name, type_hash = ("TwistStamped", STAMPED_HASH) if is_stamped else ("Twist", TWIST_HASH)
    name = f"geometry_msgs/msg/{name}"
    publishers = [
        ROS2Publisher(f"/{robot}/cmd_vel", name, TEXTS[name], node_name=f"driver_{robot}", type_hash=type_hash, **at)
        for robot in robots
    ]
    flag = "std_msgs/msg/Bool"
    dribblers = [
        ROS2Publisher(f"/{robot}/dribble", flag, TEXTS[flag], node_name=f"holder_{robot}", type_hash=FLAG_HASH, **at)
        for robot in robots
        if dribbles
    ]
    vector, twist = types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Twist"]

    def on_clock(told: Any) -> None:
        fields: dict[str, Any] = {"linear": vector(x=SPEED, y=0.0, z=0.0), "angular": vector(x=0.0, y=0.0, z=TURN)}
        if is_stamped:
            header = types["std_msgs/msg/Header"](stamp=told.clock, frame_id="")
            fields = {"header": header, "twist": twist(**fields)}
        for dribbler in dribblers:
            dribbler.publish(data=True)
        for publisher in publishers:
            publisher.publish(**fields)

    clock = "rosgraph_msgs/msg/Clock"
    ROS2Subscriber("/clock", clock, on_clock, TEXTS[clock], node_name="listener", type_hash=CLOCK_HASH, **at)
    threading.Event().wait()


def list_graph(endpoint: str) -> None:
    from zenoh_ros2_sdk import get_service_names_and_types, get_topic_info, get_topic_names_and_types
    from zenoh_ros2_sdk.session import ZenohSession

    ip, port = endpoint.removeprefix("tcp/").split(":")
    at: dict[str, Any] = {"router_ip": ip, "router_port": int(port), "timeout": 3.0}
    clock = get_topic_info("/clock", verbose=True, **at)
    found = {
        "topics": dict(get_topic_names_and_types(**at)),
        "services": dict(get_service_names_and_types(**at)),
        "clock": [vars(one) for one in clock.publishers] if clock is not None else [],
    }
    sys.stdout.write(json.dumps(found))
    ZenohSession.get_instance().close()


if __name__ == "__main__":
    options = argparse.ArgumentParser()
    options.add_argument("library", choices=["pyzeros", "sdk", "list"])
    options.add_argument("endpoint")
    options.add_argument("--twist", action="store_true")
    options.add_argument("--dribble", action="store_true")
    options.add_argument("robots", nargs="*")
    given = options.parse_args()
    if given.library == "list":
        list_graph(given.endpoint)
    elif given.library == "sdk":
        play_sdk(given.endpoint, given.robots, not given.twist, given.dribble)
    else:
        asyncio.run(play_pyzeros(given.endpoint, given.robots, not given.twist))
