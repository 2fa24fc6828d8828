"""Where robots of both teams stand at set pieces."""

import math

import pytest

from robot_agent.bodies import Body, DriveLimits
from robot_agent.teams.set_piece import stand
from schemas.game import Point, TeamPhase
from schemas.messages.game import GameView

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
