"""What a page costs its network: frames are rounded, compressed, and sent 25 times a second."""

import math
from collections.abc import Callable, Iterator

import pytest

from coach_gateway.web.pages.rounding import rounded_json
from schemas.config.match_config import load_match
from schemas.messages.radio import BallBelief, Radio
from schemas.messages.world import BallTruth
from schemas.side import Side
from support.fake_host import FakeHost
from support.messages import make_robot
from support.page_gateway import Gateway
from support.visitor import Visitor

FRAMES = 50
MOST_BYTES_PER_FRAME = 60_000 / 25
"""60 kB/s at 25 frames a second."""


@pytest.fixture
def visitor(medium, gateway_of: Callable[..., Gateway]) -> Iterator[tuple[FakeHost, Visitor]]:
    host = FakeHost(medium, load_match(None, {f"teams.{side}.size": 5 for side in Side}), in_threads=True)
    visitor = Visitor(gateway_of().origin)
    visitor.hear_what_is_played()
    yield host, visitor
    visitor.close()
    host.close()


def test_a_spectator_of_ten_robots_costs_at_most_60_kb_a_second(visitor: tuple[FakeHost, Visitor]) -> None:
    host, page = visitor
    received = [0]
    receive = page.socket.protocol.receive_data

    def counted(data: bytes) -> None:
        received[0] += len(data)
        receive(data)

    page.socket.protocol.receive_data = counted  # type: ignore[method-assign]
    for tick in range(1, FRAMES + 1):
        host.say()
        for number, robot in enumerate(name for side in Side for name in host.config.robots(side)):
            ball = BallBelief(x=math.sin(tick + number) * 9, y=math.cos(tick * number) * 6, age=0.02 * number)
            host.believe(robot, Radio(role="left supporter", intention="wait behind the ball", ball=ball))
        robots = {
            name: make_robot(
                9 * math.sin(0.02 * tick + number), 6 * math.cos(0.03 * tick + number), math.sin(tick),
                vx=math.cos(tick), vy=math.sin(number + tick), omega=math.sin(3 * tick + number),
            )
            for number, name in enumerate(name for side in Side for name in host.config.robots(side))
        }  # fmt: skip
        host.show(robots=robots, ball=BallTruth(x=math.sin(tick), y=math.pi, z=0.11, vx=math.e, vy=1 / 3, vz=0.0))
        page.hear("frame", tick=host.state.tick)
    assert received[0] / FRAMES < MOST_BYTES_PER_FRAME


def test_numbers_of_a_frame_are_rounded_to_a_millimetre() -> None:
    assert rounded_json(b'{"x":1.23456789,"list":[-0.0001,2],"name":"1.23456789","none":null,"on":true}') == (
        '{"x":1.235,"list":[0.0,2],"name":"1.23456789","none":null,"on":true}'
    )
