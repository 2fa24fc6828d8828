"""A match of eleven a side drawn in a terminal: every robot has its row and its number."""

import re

import pytest

from coach_gateway.match.follower import MatchFollower
from schemas.bus.in_process_bus import SharedState
from schemas.messages.setup import Setup
from schemas.process.clock import SteppedClock
from schemas.side import Side
from schemas.topics import WORLD
from support.messages import make_robot, make_setup, make_world
from touchline.watch.drawing import draw_match
from touchline.watch.panel import robots
from touchline.watch.pitch import field

WORLD_NOW = make_world(
    5,
    robots={
        f"{side.value}{place + 1}": make_robot(sign * (2.0 + 2.2 * (place % 4)), 3.0 * (place // 4) - 3.0)
        for side, sign in ((Side.CYAN, -1), (Side.MAGENTA, 1))
        for place in range(11)
    },
)


@pytest.fixture(scope="module")
def setup() -> Setup:
    return make_setup(size=11, rules="eleven")


@pytest.fixture
def follower() -> MatchFollower:
    medium, clock = SharedState(), SteppedClock()
    follower = MatchFollower(medium.open_bus("friendly", clock), details=True)
    medium.open_bus("friendly", clock).publisher(WORLD).put(WORLD_NOW)
    follower.update()
    return follower


def test_rows_are_in_the_order_of_the_numbers_and_their_columns_stand_below_each_other(setup: Setup) -> None:
    rows = [row.plain for row in robots(setup, WORLD_NOW, {}, None, None)]
    assert [row.split("→")[0].strip() for row in rows] == [str(number) for _ in Side for number in range(1, 12)]
    assert len({row.index(" m/s") for row in rows}) == 1


def test_numbers_are_those_of_the_names(setup: Setup) -> None:
    """As on the page: a robot that is added to a running match, or left of a larger team, keeps its own."""
    teams = {
        side: team.model_copy(update={"robots": [f"{side.value}{n}" for n in (1, 7, 10)]})
        for side, team in setup.teams.items()
    }
    few = setup.model_copy(update={"teams": teams})
    rows = [row.plain for row in robots(few, WORLD_NOW, {}, None, None)]
    assert [row.split("→")[0].strip() for row in rows] == ["1", "7", "10"] * 2


def test_all_twenty_two_are_on_the_pitch(setup: Setup) -> None:
    drawn = "\n".join(row.plain for row in field(setup, WORLD_NOW, None, 120, 40))
    assert sorted(map(int, re.findall(r"(\d+)→", drawn))) == sorted(2 * list(range(1, 12)))


@pytest.mark.parametrize("height", [24, 30, 50])
def test_beside_the_pitch_is_a_row_for_every_robot_or_how_many_are_left_out(
    setup: Setup, follower: MatchFollower, height: int
) -> None:
    rows = [row.plain for row in draw_match(follower, setup, 180, height)]
    shown = sum(" m/s" in row for row in rows)
    left_out = [row for row in rows if "more robots: make the terminal higher" in row]
    assert len(rows) <= height
    assert (shown == 22 and not left_out) or f"{22 - shown} more robots" in left_out[0]
    assert (shown == 22) == (height > 27)
