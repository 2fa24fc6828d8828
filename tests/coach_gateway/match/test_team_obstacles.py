"""Opponents and other bodies as a team believes them, fused from what its robots have sent."""

from coach_gateway.match.team_obstacles import TeamObstacle, team_obstacles
from schemas.messages.radio import Belief, Motion, Radio
from schemas.soccer.game import Point


def belief(robot: str, x: float, *places: tuple[float, float], time: float = 9.9) -> Belief:
    """A robot at (x, 0) that believes bodies at these places."""
    radio = Radio(self=Motion(x=x, y=0.0, heading=0.0), obstacles=[Point(x=px, y=py) for px, py in places])
    return Belief(tick=1, time=time, robot=robot, radio=radio)


def fused(*beliefs: Belief) -> list[TeamObstacle]:
    return team_obstacles({one.robot: one for one in beliefs}, 10.0)


def test_what_two_robots_see_near_each_other_is_one_body_where_the_nearer_one_sees_it() -> None:
    found = fused(belief("cyan1", 0.0, (5.0, 0.3)), belief("cyan2", 4.0, (5.2, 0.0), (8.0, 3.0)))
    told = [(one.x, one.y, one.age, one.seen_by) for one in found]
    assert told == [(5.2, 0.0, 0.1, ["cyan2", "cyan1"]), (8.0, 3.0, 0.1, ["cyan2"])]


def test_two_bodies_that_one_robot_sees_side_by_side_remain_two() -> None:
    assert len(fused(belief("cyan1", 0.0, (5.0, 0.2), (5.0, -0.2)))) == 2


def test_a_teammate_that_is_taken_for_an_obstacle_is_none() -> None:
    assert fused(belief("cyan1", 0.0, (4.1, 0.0)), belief("cyan2", 4.0)) == []


def test_old_beliefs_do_not_count() -> None:
    assert fused(belief("cyan1", 0.0, (5.0, 0.0), time=8.9)) == []


def test_a_robot_that_does_not_send_its_pose_counts_last() -> None:
    lost = Belief(tick=1, time=9.9, robot="cyan1", radio=Radio(obstacles=[Point(x=5.3, y=0.0)]))
    (found,) = fused(lost, belief("cyan2", 0.0, (5.0, 0.0)))
    assert (found.x, found.seen_by) == (5.0, ["cyan2", "cyan1"])
