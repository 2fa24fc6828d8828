"""Test mode in the simulated world: each test performs its task, in every shipped team.

The test modes are those of the NuBot coach, by name. The robots of the paper's first scene show them, with the
noise of their profile, beside rivals that stand still.
"""

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from schemas.config.match_config import load_match
from schemas.config.roster import Placement
from schemas.frames import wrap
from schemas.messages.coach import CoachMode, CoachOrder, CoachTest
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.side import Side
from schemas.soccer.game import EventKind, Point
from sim_host.match.simulation import TickResult
from touchline.play.play_match import InProcessMatch

BRAINS = {"simple": "robot_agent.teams.simple:Simple", "nubot": "robot_agent.teams.nubot:NuBot"}
UNDISTURBED = {"rules": "friendly", "referee.mode": "manual"}
"""No rule stops the game for a ball that lies still."""
NEAR = 0.2
"""m; how near to its point a robot comes to rest, with the noise of its profile."""


class Practice:
    """A side of three that a coach gives orders to."""

    def __init__(self, team: str, profile: str, **flags: Any) -> None:
        words = {"scene": "paper_static", "profile": profile, "teams.cyan.brain": BRAINS[team], **UNDISTURBED}
        self.table = InProcessMatch(load_match(None, words | flags))
        self.ticks: list[TickResult] = []
        self._given = 0

    def close(self) -> None:
        self.table.simulation.close()

    def order(self, test: str, **content: Any) -> None:
        """Give cyan the order that names a test."""
        self._given += 1
        points = {key: Point(x=value[0], y=value[1]) for key, value in content.items() if key.startswith("point")}
        made = CoachOrder(sequence=self._given, mode=CoachMode.TEST, test=CoachTest(test), **{**content, **points})
        self.table.simulation.orders[Side.CYAN] = made

    def run(self, until: Callable[[], bool], most: float = 30.0) -> bool:
        """Play until something is so, for at most `most` s of simulated time; whether it became so."""
        end = self.table.simulation.now.time + most
        while self.table.simulation.now.time < end:
            self.ticks.append(self.table.step())
            if until():
                return True
        return False

    def play(self, seconds: float) -> None:
        self.run(lambda: False, seconds)

    def place(self, **placement: Any) -> None:
        """Set a body down."""
        reply = self.table.simulation.handle_scene(
            SceneRequest(operation=SceneOperation.PLACE, place=[Placement(**placement)], source="test")
        )
        assert reply.accepted, reply.reason

    def robot(self, name: str) -> dict[str, Any]:
        truth: dict[str, Any] = self.table.simulation.now.world["robots"][name]
        return truth

    def away(self, name: str, x: float, y: float) -> float:
        """m between a robot's centre and a point."""
        robot = self.robot(name)
        return math.hypot(robot["x"] - x, robot["y"] - y)

    def is_at(self, name: str, x: float, y: float) -> bool:
        """Whether a robot rests at a point."""
        robot = self.robot(name)
        return self.away(name, x, y) < NEAR and math.hypot(robot["vx"], robot["vy"]) < 0.1

    def has_ball(self, name: str) -> bool:
        return bool(self.robot(name)["holding"])

    def is_in_goal(self) -> bool:
        """Whether the ball is in the goal that cyan attacks."""
        ball, pitch = self.table.simulation.now.world["ball"], self.table.simulation.profile.field
        return bool(ball["x"] > pitch.goal_line and abs(ball["y"]) < 0.5 * pitch.goal_width)


@pytest.fixture(
    params=[("simple", "msl"), pytest.param(("nubot", "paper"), marks=pytest.mark.long)],
    ids=lambda param: "-".join(param),
)
def practice(request: pytest.FixtureRequest) -> Iterator[Practice]:
    made = Practice(*request.param)
    yield made
    made.close()


def test_stop_stops_every_robot(practice: Practice) -> None:
    practice.order("move", robot_a="cyan2", point_a=(0.0, 4.0))
    practice.play(1.0)
    practice.order("stop")
    practice.play(2.0)
    for name in ("cyan1", "cyan2", "cyan3"):
        robot = practice.robot(name)
        assert math.hypot(robot["vx"], robot["vy"]) < 0.05


def test_a_robot_moves_to_its_point_and_faces_its_angle_and_the_others_stand(practice: Practice) -> None:
    practice.order("move", robot_a="cyan2", point_a=(-4.0, 3.0), angle_a=-2.0)
    assert practice.run(lambda: practice.is_at("cyan2", -4.0, 3.0))
    practice.play(2.0)
    assert practice.is_at("cyan2", -4.0, 3.0)
    assert abs(wrap(practice.robot("cyan2")["heading"] + 2.0)) < 0.15
    assert practice.away("cyan1", -6.0, 0.0) < 0.1
    assert practice.away("cyan3", -2.0, -1.5) < 0.1


def nearest_rival(practice: Practice, name: str) -> float:
    """m; least distance of the centres of a robot and of rivals over all ticks."""
    least = math.inf
    for tick in practice.ticks:
        robots = tick.world["robots"]
        for rival in ("magenta1", "magenta2", "magenta3"):
            dx, dy = robots[name]["x"] - robots[rival]["x"], robots[name]["y"] - robots[rival]["y"]
            least = min(least, math.hypot(dx, dy))
    return least


def test_a_robot_that_avoids_goes_around_a_rival_and_one_that_does_not_runs_into_it(practice: Practice) -> None:
    reach = practice.table.simulation.setup().robot.radius
    practice.order("move", robot_a="cyan2", point_a=(4.5, 1.5), avoid=True)
    assert practice.run(lambda: practice.is_at("cyan2", 4.5, 1.5))
    assert nearest_rival(practice, "cyan2") > 2.0 * reach + 0.02
    practice.order("move", robot_a="cyan2", point_a=(-0.5, 1.5))
    practice.play(6.0)
    assert nearest_rival(practice, "cyan2") < 2.0 * reach + 0.02


def test_with_the_ball_a_robot_gets_it_and_brings_it_to_its_point(practice: Practice) -> None:
    practice.order("move", robot_a="cyan3", point_a=(-3.0, -3.5), angle_a=1.0, with_ball=True)
    assert practice.run(lambda: practice.is_at("cyan3", -3.0, -3.5) and practice.has_ball("cyan3"))
    practice.play(1.5)
    assert practice.is_at("cyan3", -3.0, -3.5) and practice.has_ball("cyan3")
    assert abs(wrap(practice.robot("cyan3")["heading"] - 1.0)) < 0.15


def test_location_goes_from_one_point_to_the_other_and_back(practice: Practice) -> None:
    a, b = (-4.0, 2.0), (-2.0, 4.0)
    practice.order("location", robot_a="cyan2", point_a=a, point_b=b, angle_b=0.5)
    for point in (a, b, a, b):
        assert practice.run(lambda point=point: practice.is_at("cyan2", *point))


@pytest.mark.parametrize("with_ball", [False, True])
@pytest.mark.slow
@pytest.mark.parametrize(
    ("team", "profile"), [("simple", "msl"), pytest.param("nubot", "paper", marks=pytest.mark.long)]
)
def test_a_circle_keeps_its_radius_round_after_round(team: str, profile: str, with_ball: bool) -> None:
    """As far as the robot knows where it is: without noise."""
    practice = Practice(team, profile, **{"noise.preset": "perfect"})
    centre, radius = (-3.0, 2.0), 1.5
    practice.order("circle", robot_a="cyan2", point_a=centre, radius=radius, max_speed=1.2, with_ball=with_ball)
    assert practice.run(
        lambda: abs(practice.away("cyan2", *centre) - radius) < 0.05 and practice.has_ball("cyan2") == with_ball
    )
    practice.play(2.0)
    turned, before = 0.0, None
    for _ in range(600):
        practice.play(0.02)
        robot = practice.robot("cyan2")
        assert abs(practice.away("cyan2", *centre) - radius) < 0.06
        bearing = math.atan2(robot["y"] - centre[1], robot["x"] - centre[0])
        turned += wrap(bearing - before) if before is not None else 0.0
        before = bearing
        assert abs(wrap(robot["heading"] - bearing - 0.5 * math.pi)) < 0.35
        assert not with_ball or practice.has_ball("cyan2")
    assert turned > 2.0 * math.pi
    practice.close()


def test_a_pass_goes_from_one_robot_to_the_other(practice: Practice) -> None:
    practice.order("pass", robot_a="cyan2", robot_b="cyan3")
    assert practice.run(lambda: practice.has_ball("cyan2"))
    assert practice.run(lambda: practice.has_ball("cyan3"))
    practice.play(1.0)
    assert practice.has_ball("cyan3")


def test_a_pass_goes_from_point_to_point(practice: Practice) -> None:
    a, b = (-4.0, 2.5), (-5.0, -2.5)
    practice.order("pass", robot_a="cyan2", robot_b="cyan3", point_a=a, point_b=b, kick_speed=4.5)
    assert practice.run(lambda: practice.has_ball("cyan2") and practice.away("cyan2", *a) < 0.4)
    assert practice.run(lambda: practice.has_ball("cyan3"))
    assert practice.away("cyan3", *b) < 2.0


def test_a_ball_that_comes_is_caught_and_one_that_lies_is_left(practice: Practice) -> None:
    practice.order("catch", robot_a="cyan1", point_a=(-5.0, 1.0))
    practice.play(4.0)
    assert practice.is_at("cyan1", -5.0, 1.0)
    practice.place(body="ball", x=0.0, y=0.0, vx=-5.0, vy=1.2)
    assert practice.run(lambda: practice.has_ball("cyan1"), 6.0)
    assert practice.away("cyan1", -5.0, 1.0) < 2.0


def test_a_shot_goes_into_the_goal(practice: Practice) -> None:
    practice.order("shoot", robot_a="cyan2", point_a=(1.0, 3.5))
    assert practice.run(lambda: practice.has_ball("cyan2") and practice.away("cyan2", 1.0, 3.5) < 0.2)
    assert practice.run(practice.is_in_goal)


def test_a_lob_goes_over_a_robot_in_the_way_into_the_goal(practice: Practice) -> None:
    practice.order("shoot", robot_a="cyan2", point_a=(3.0, 0.0), kick_mode="lob")
    assert practice.run(practice.is_in_goal)
    assert max(tick.world["ball"]["z"] for tick in practice.ticks) > 0.5


def test_a_shot_reaches_its_point_at_the_ordered_speed(practice: Practice) -> None:
    practice.order("shoot", robot_a="cyan3", point_b=(0.0, 6.5), kick_speed=3.0)
    assert practice.run(lambda: practice.has_ball("cyan3"))
    assert practice.run(lambda: not practice.has_ball("cyan3"))
    ball = practice.table.simulation.now.world["ball"]
    assert math.hypot(ball["vx"], ball["vy"]) == pytest.approx(3.0, abs=0.4)
    aimed = math.atan2(6.5 - ball["y"], 0.0 - ball["x"])
    assert abs(wrap(math.atan2(ball["vy"], ball["vx"]) - aimed)) < 0.15


def test_who_has_shot_does_not_go_after_the_ball(practice: Practice) -> None:
    practice.order("shoot", robot_a="cyan3", point_b=(-1.0, -5.0), kick_speed=2.0)
    assert practice.run(lambda: practice.has_ball("cyan3"))
    assert practice.run(lambda: not practice.has_ball("cyan3"))
    robot = practice.robot("cyan3")
    practice.play(3.0)
    assert practice.away("cyan3", robot["x"], robot["y"]) < 0.5


@pytest.mark.parametrize("team", BRAINS)
def test_where_the_rules_bind_a_robot_brings_the_ball_without_a_foul(team: str) -> None:
    practice = Practice(team, "paper", **{"rules": "paper", "referee.mode": "automatic"})
    practice.order("move", robot_a="cyan3", point_a=(-5.0, -4.0), with_ball=True)
    assert practice.run(lambda: practice.away("cyan3", -5.0, -4.0) < NEAR and practice.has_ball("cyan3"), 40.0)
    assert not [event for tick in practice.ticks for event in tick.events if event.kind is EventKind.FOUL]
    practice.close()
