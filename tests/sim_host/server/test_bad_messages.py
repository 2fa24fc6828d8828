"""What robots, coaches and strangers may send without stopping the host."""

import pytest

from runtime.bus.batch_publisher import BatchPublisher
from runtime.bus.contract import ReceivedMessage
from schemas.config.match_config import MatchConfig
from schemas.config.profile import load_profile
from schemas.messages.coach import CoachMode, CoachOrder
from schemas.messages.command import Command
from schemas.side import Side
from schemas.topics import COMMAND, INVALID, ORDER, WORLD
from sim_host.server import inbox
from sim_host.server.admission.door import Admission
from sim_host.server.admission.invalid_log import InvalidLog
from sim_host.snapshot import Roster
from support.in_process_bus import InProcessBus, SharedState
from support.stepped_clock import SteppedClock

RUBBISH = {
    "a number that is none": (b'{"answers_tick":1,"drive":{"vx":NaN}}', "drive.vx is nan"),
    "an absurd speed": (b'{"version":"2.0","answers_tick":1,"drive":{"vx":1e9}}', "drive.vx is 1000000000.0"),
    "a truncated payload": (Command(answers_tick=1).encode()[:-7], " is not JSON: "),
    "words": (b"drive ahead!", "b'drive ahead!' is not JSON"),
    "twenty thousand bytes": (b"x" * 20_000, "20000 bytes, at most 12288"),
    "nothing": (b"", "b'' is not JSON"),
    "bytes that are no text": (b"\xff\xfe\x00", " is not JSON: "),
    "an answer to a tick to come": (Command(answers_tick=500).encode(), "answers_tick is 500, the newest sight is 5"),
    "an answer to a tick before the first": (b'{"answers_tick":-1}', "answers_tick is -1"),
    "another major version": (b'{"version":"1.0","answers_tick":1}', "version 1.0 is not supported"),
    "an unknown field": (b'{"version":"2.0","answers_tick":1,"jump":true}', "jump is not known"),
}


@pytest.mark.parametrize("case", RUBBISH)
@pytest.mark.parametrize("pace", ["lockstep", "realtime"])
def test_a_bad_command_is_counted_published_with_its_reason_and_ignored(rig_of, pace, case):
    payload, reason = RUBBISH[case]
    rig = rig_of(pace=pace)
    rig.join_all()
    told, worlds = rig.listen(INVALID), rig.listen(WORLD)
    rig.begin()
    rig.ticks(5)
    rig.outside.publisher(COMMAND, robot="cyan2").put_payload(payload)
    rig.ticks(5)
    (invalid,) = told.all()
    assert (invalid.key, invalid.size) == ("robot/cyan2/command", len(payload))
    assert reason in invalid.reason
    health = rig.health()
    assert {name: robot.invalid for name, robot in health.robots.items()} == {"cyan1": 0, "cyan2": 1, "magenta1": 0}
    assert all(robot.answering and robot.missed == 0 for robot in health.robots.values())
    assert [world.tick for world in worlds.all()] == list(range(12))


def test_a_command_to_a_robot_that_does_not_play_is_counted_as_a_strangers(rig):
    told = rig.listen(INVALID)
    for robot in ("cyan9", "cyan9", "ball"):
        rig.outside.publisher(COMMAND, robot=robot).put(Command(answers_tick=0))
    rig.ticks(4)
    assert rig.health().strangers == {"robot/cyan9/command": 2, "robot/ball/command": 1}
    first = told.all()[0]
    assert (first.key, first.reason) == ("robot/cyan9/command", "no robot of this match has that name")


def test_invented_names_do_not_fill_the_memory(rig):
    for number in range(250):
        rig.outside.publisher(COMMAND, robot=f"ghost{number}").put(Command(answers_tick=0))
    rig.ticks(1)
    strangers = rig.health().strangers
    assert len(strangers) == 101
    assert sum(strangers.values()) == 250


def test_of_many_bad_messages_one_a_tick_is_published(rig):
    told = rig.listen(INVALID)
    writer = rig.outside.publisher(COMMAND, robot="cyan1")
    for _ in range(50):
        writer.put_payload(b"?")
    rig.ticks(10)
    assert [invalid.tick for invalid in told.all()] == list(range(1, 11))


def test_of_more_invalid_payloads_than_can_be_published_the_newest_are_kept():
    invalid_log = InvalidLog()
    for number in range(1000):
        invalid_log.add(f"key{number}", "odd", b"")
    kept = [invalid.key for invalid in iter(lambda: invalid_log.pop(1, 0.02), None)]
    assert kept == [f"key{number}" for number in range(900, 1000)]


class FloodedBus(InProcessBus):
    """Its subscriptions never run dry: one useless command comes after another."""

    received = 0

    def subscribe(self, topic, **_):
        self._flood = ReceivedMessage(topic, "robot/cyan1/command", b"?", None)
        return self

    def receive(self, timeout=0.0):
        self.received += 1
        return self._flood


def test_a_flood_does_not_hold_the_host():
    bus = FloodedBus("friendly", SteppedClock(), SharedState())
    box = inbox.Inbox(
        bus, Roster.of(MatchConfig(), load_profile("msl")), BatchPublisher(bus), Admission(MatchConfig(), {})
    )
    for _ in range(5):
        assert box.receive_command(0, 0.0) is None
    assert 500 < bus.received < 10_000
    assert 0 < box.agent_stats["cyan1"].invalid < bus.received  # beyond its limit they are not even read


@pytest.mark.parametrize(
    ("side", "payload", "reason"),
    [
        ("cyan", b'{"sequence":0}', "sequence is 0"),
        ("cyan", b"go!", "b'go!' is not JSON"),
        ("blue", CoachOrder(sequence=9).encode(), "no side is named blue"),
    ],
)
def test_a_bad_order_is_published_with_its_reason_and_the_one_in_force_stays(rig, side, payload, reason):
    told = rig.listen(INVALID)
    rig.outside.publisher(ORDER, side="cyan").put(CoachOrder(sequence=3, mode=CoachMode.HOLD))
    rig.ticks(1)
    rig.outside.publisher(ORDER, side=side).put_payload(payload)
    rig.ticks(2)
    (invalid,) = told.all()
    assert invalid.key == f"team/{side}/order"
    assert reason in invalid.reason
    assert rig.host.simulation.orders == {Side.CYAN: CoachOrder(sequence=3, mode=CoachMode.HOLD)}
