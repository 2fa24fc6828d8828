"""The world state of a base station of ours: the league's schema, its axes, the robots' own beliefs."""

import math
from collections.abc import Callable
from typing import Any

import pytest

from coach_gateway.soccer.refbox.own_world_state import own_world_state
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.messages.radio import BallBelief, Belief, Motion, Radio
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameState
from schemas.messages.world import BallTruth, ObstacleTruth, PushedTruth, RobotTruth, World
from schemas.side import Side
from schemas.soccer.game import OffField, Phase, Point
from support.messages import make_setup

SETUP = Setup.of(
    load_match(None, {f"teams.{side}.size": 2 for side in Side}), load_profile("msl"), load_rule_book("friendly")
)
SIDES = {name: side for side, team in SETUP.teams.items() for name in team.robots}


def truth(x: float, y: float, heading: float = 0.0, **more: Any) -> RobotTruth:
    return RobotTruth(**{"x": x, "y": y, "z": 0.4, "heading": heading, "vx": 1.0, "vy": 0.5, "omega": 0.2} | more)


WORLD = World(
    tick=500,
    time=10.0,
    robots={
        "cyan1": truth(-8.0, 1.0, holding=False),
        "cyan2": truth(3.0, 2.0, math.pi / 2, holding=True),
        "magenta1": truth(8.0, -1.0, math.pi, holding=False),
        "magenta2": truth(0.0, 9.0, holding=False, off_field=OffField.REPAIR),
    },
    ball=BallTruth(x=3.4, y=2.0, z=0.2, vx=1.0, vy=2.0, vz=0.5),
)


def state(cyan_attacks: int = 1) -> GameState:
    return GameState(tick=500, time=10.0, phase=Phase.PLAY, running=True, cyan_attacks=cyan_attacks)


View = Callable[..., dict[str, Any]]


@pytest.fixture
def view(check_world_state: Callable[[Any], None]) -> View:
    """Makes a side's view, as valid as the league wants it."""

    def make(side: Side, cyan_attacks: int = 1, world: World = WORLD, **words: Belief) -> dict[str, Any]:
        seen = own_world_state(side, SETUP, SIDES, state(cyan_attacks), world, words)
        check_world_state(seen)
        return seen

    return make


def word(robot: str, time: float = 9.9, **said: Any) -> Belief:
    return Belief(tick=1, time=time, robot=robot, radio=Radio(**said))


def test_the_view_has_the_schema_and_the_axes_of_the_league(view: View) -> None:
    """+y toward the opponents' goal, +x to the right of it, as in the schema MSLWMD of RefBox."""
    cyan = view(Side.CYAN)
    assert cyan["teamName"] == SETUP.teams[Side.CYAN].name
    assert [robot["id"] for robot in cyan["robots"]] == [1, 2]
    assert cyan["robots"][0]["pose"] == [-1.0, -8.0, 0.0]
    assert cyan["robots"][1]["pose"] == [-2.0, 3.0, 1.571]
    assert cyan["robots"][1]["velocity"] == [-0.5, 1.0, 0.2]
    assert [robot["ballEngaged"] for robot in cyan["robots"]] == [0, 1]
    assert cyan["balls"] == [{"position": [-2.0, 3.4, 0.2], "velocity": [-2.0, 1.0, 0.5], "confidence": 1.0}]
    assert cyan["obstacles"][0]["position"] == [1.0, 8.0]
    magenta = view(Side.MAGENTA)
    assert magenta["robots"][0]["pose"] == [-1.0, -8.0, 0.0]
    assert magenta["balls"][0]["position"] == [2.0, -3.4, 0.2]


def test_after_the_teams_have_changed_ends_each_still_looks_ahead(view: View) -> None:
    assert view(Side.CYAN, cyan_attacks=-1)["robots"][0]["pose"] == [1.0, 8.0, 3.142]
    assert view(Side.MAGENTA, cyan_attacks=-1)["robots"][0]["pose"] == [1.0, 8.0, 3.142]


def test_a_robot_off_the_field_is_neither_a_robot_nor_an_obstacle(view: View) -> None:
    assert [robot["id"] for robot in view(Side.MAGENTA)["robots"]] == [1]
    assert len(view(Side.CYAN)["obstacles"]) == 1


def test_robots_have_the_poses_that_they_send(view: View) -> None:
    """Magenta's robot speaks in its own team's frame."""
    said = Motion(x=-7.5, y=0.5, heading=0.1, vx=1.0, vy=0.0, omega=0.0)
    seen = view(Side.MAGENTA, magenta1=word("magenta1", self=said, intention="keep the goal"))
    assert seen["robots"][0]["pose"] == [-0.5, -7.5, 0.1]
    assert seen["robots"][0]["velocity"] == [0.0, 1.0, 0.0]
    assert seen["robots"][0]["intention"] == "keep the goal"
    assert seen["ageMs"] == 100


def test_old_beliefs_do_not_count(view: View) -> None:
    old = word("cyan1", time=8.0, self=Motion(x=5.0, y=5.0, heading=0.0))
    assert view(Side.CYAN, cyan1=old)["robots"][0]["pose"] == [-1.0, -8.0, 0.0]


@pytest.mark.parametrize(
    ("first", "second", "position", "confidence"),
    [(0.5, 0.1, [-4.0, 3.0, 0.11], 0.9), (0.1, 0.5, [1.0, 2.0, 0.11], 0.9), (2.5, 3.0, [1.0, 2.0, 0.11], 0.0)],
)
def test_the_ball_is_where_it_was_seen_last_and_the_less_sure_the_longer_ago(
    view: View, first: float, second: float, position: list[float], confidence: float
) -> None:
    words = {
        "cyan1": word("cyan1", ball=BallBelief(x=2.0, y=-1.0, age=first)),
        "cyan2": word("cyan2", ball=BallBelief(x=3.0, y=4.0, vx=2.0, age=second)),
    }
    (ball,) = view(Side.CYAN, **words)["balls"]
    assert ball["position"] == pytest.approx(position, abs=0.002)
    assert ball["confidence"] == pytest.approx(confidence, abs=1e-3)


def test_a_team_that_sees_no_ball_sends_none(view: View) -> None:
    assert view(Side.CYAN, cyan1=word("cyan1", role="searcher"))["balls"] == []


def test_a_game_without_a_ball_has_none(view: View) -> None:
    assert view(Side.CYAN, world=WORLD.replace(ball=None))["balls"] == []


def test_obstacles_are_where_the_robots_believe_them(view: View) -> None:
    """Magenta's robots send them in their own team's frame."""
    seen = view(Side.MAGENTA, magenta1=word("magenta1", obstacles=[Point(x=2.0, y=-3.0)]))
    assert [one["position"] for one in seen["obstacles"]] == [[3.0, 2.0]]
    assert len(view(Side.MAGENTA, magenta1=word("magenta1", role="keeper"))["obstacles"]) == 2


def test_what_stands_on_the_pitch_is_an_obstacle(view: View) -> None:
    post = ObstacleTruth(x=4.0, y=0.0, heading=0.0, radius=0.3, height=1.0, shape="cylinder", size_x=0.6, size_y=0.6)
    seen = view(Side.CYAN, world=WORLD.replace(obstacles={"post": post}))
    assert {"position": [0.0, 4.0], "velocity": [0.0, 0.0], "radius": 0.3, "confidence": 1.0} in seen["obstacles"]
    pushed = post.replace(pushed=PushedTruth(vx=0.5, vy=-0.25, omega=0.0, mass=5.0, friction=0.4))
    seen = view(Side.CYAN, world=WORLD.replace(obstacles={"post": pushed}))
    assert {"position": [0.0, 4.0], "velocity": [0.25, 0.5], "radius": 0.3, "confidence": 1.0} in seen["obstacles"]


def test_a_world_state_has_eleven_robots_with_the_numbers_of_their_names(
    check_world_state: Callable[[Any], None],
) -> None:
    setup = make_setup(size=11, rules="eleven")
    sides = {name: side for side, team in setup.teams.items() for name in team.robots}
    robots = {name: truth(0.5 * number, 1.0, holding=False) for number, name in enumerate(sides)}
    world = WORLD.replace(robots=robots)
    for side in Side:
        seen = own_world_state(side, setup, sides, state(), world, {})
        check_world_state(seen)
        assert [robot["id"] for robot in seen["robots"]] == list(range(1, 12))
        assert len(seen["obstacles"]) == 11
