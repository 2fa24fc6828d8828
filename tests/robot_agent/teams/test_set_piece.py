"""Where robots of both teams stand at set pieces."""

import math

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.skills.keep_out import Area
from robot_agent.teams.set_piece import stand
from schemas.messages.soccer.game import GameView
from schemas.soccer.game import Point, TeamPhase

SPOT = (-10.7, 6.7)
"""m; of a corner of the other side."""


@pytest.mark.parametrize("place", [(-10.74, 6.69), (-10.75, 6.7), (-10.74, 6.71), (-10.8, 6.75), (-10.7, 6.75)])
def test_a_robot_on_the_spot_of_their_corner_leaves_it_although_the_straight_way_ends_at_the_lines(setup, place):
    game = GameView(phase=TeamPhase.THEIR_CORNER, running=False, clock=0.0, our_score=0, their_score=0)
    x, y = place
    for _ in range(150):
        drive = stand(Body(x, y, 0.0), (-9.0, 4.0), game, SPOT, [], setup, DriveLimits.of(setup))
        x, y = x + drive.vx * setup.time.tick, y + drive.vy * setup.time.tick
    assert math.dist((x, y), SPOT) > setup.restarts.opponent_distance + setup.robot.radius


def test_after_start_of_a_penalty_its_taker_stays_the_same_although_another_robot_is_nearer(squad):
    made = squad("simple")
    seen = {"ball": (7.4, 0.0), "spot": Point(x=7.4, y=0.0), "phase": TeamPhase.OUR_PENALTY}
    for _ in range(150):
        made.move(made.act(running=False, **seen))
    takers = [name for name, heard in made.said.items() if heard.role == "striker"]
    other = next(name for name in made.poses if name not in (*takers, "cyan1"))
    taker, x, y = takers[0], *made.poses[takers[0]][:2]
    made.poses[other] = (7.4, 0.45, 0.0)
    made.poses[taker] = (x - 0.5, y, 0.0)
    for _ in range(10):
        made.act(running=True, **seen)
    assert [name for name, heard in made.said.items() if heard.role == "striker"] == takers == [taker]


@pytest.mark.parametrize("team", ["simple", "nubot"])
@pytest.mark.parametrize(
    ("phase", "spot"),
    [
        (TeamPhase.THEIR_GOAL_KICK, (7.4, -3.5)),
        (TeamPhase.THEIR_FREE_KICK, (-7.4, 0.0)),
        (TeamPhase.THEIR_CORNER, (-10.7, 6.7)),
        (TeamPhase.OUR_GOAL_KICK, (-7.4, 3.5)),
        (TeamPhase.OUR_CORNER, (10.7, -6.7)),
    ],
)
def test_at_start_no_field_robot_is_in_a_penalty_area_wherever_it_was_before(squad, setup, team, phase, spot):
    """As seen in a match: the way out of the circle around the ball led two attackers into the area."""
    near = math.copysign(1.0, spot[0])
    poses = {
        2: (8.6 * near, 3.5, 0.0),
        3: (8.5 * near, -3.4, 0.0),
        4: (6.0 * near, -3.0, 0.0),
        5: (10.9 * near, -2.0, 0.0),
    }
    made, area = squad(team, {1: (-10.5, 0.0, 0.0), **poses}), Area.penalty(setup.pitch)
    for _ in range(200):
        made.move(made.act(ball=spot, phase=phase, running=False, spot=Point(x=spot[0], y=spot[1])))
    inside = [name for name, (x, y, _) in made.poses.items() if area.has(near, x, y)]
    assert [name for name in inside if name != "cyan1"] == []


def test_two_robots_that_defend_before_their_own_goal_keep_to_two_places(squad, setup):
    """Both wanted the same place, and drove to and fro around the ball for it."""
    made = squad("simple", {1: (-10.5, 0.0, 0.0), 2: (-6.0, 0.5, 0.0), 3: (-6.0, -0.5, 0.0), 4: (0.0, 2.0, 0.0)})
    seen = {"ball": (-7.4, 0.0), "phase": TeamPhase.THEIR_FREE_KICK, "spot": Point(x=-7.4, y=0.0), "running": False}
    for tick in range(400):
        commands = made.act(**seen)
        made.move(commands)
        if tick > 300:
            assert all(math.hypot(c.drive.vx, c.drive.vy) < 0.3 for c in commands.values())
    assert math.dist(made.poses["cyan2"][:2], made.poses["cyan3"][:2]) > 1.0
