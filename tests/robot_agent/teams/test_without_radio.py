"""Teams whose robots receive nothing from each other."""

import itertools
import math

import pytest

from robot_agent.teams.zones import MIDDLES, owner_of

PLAYING = {"simple": "striker", "nubot": "plays the ball"}


@pytest.mark.parametrize("team", PLAYING)
@pytest.mark.parametrize("ball", [(0.0, 0.0), (-6.0, 2.0), (6.0, -1.0), (1.0, 5.0), (-2.0, -4.0)])
def test_one_robot_plays_the_ball_and_the_others_keep_apart(squad, team, ball):
    """All went for the ball: three and more were within a metre of it for a quarter of the time."""
    made = squad(team)
    made.brains.pop("cyan1")
    roles = {}
    for _ in range(250):
        made.said.clear()
        commands = made.act(ball=ball)
        roles |= {name: command.radio.role for name, command in commands.items() if command.radio is not None}
        made.move(commands)
    assert list(roles.values()).count(PLAYING[team]) == 1
    field = [pose[:2] for name, pose in made.poses.items() if name != "cyan1"]
    assert sum(math.dist(place, ball) < 1.5 for place in field) <= 1
    assert min(math.dist(*pair) for pair in itertools.combinations(field, 2)) > 1.0


def test_a_ball_at_the_border_of_two_parts_stays_with_the_robot_that_plays_it(setup):
    field = ["cyan2", "cyan3", "cyan4", "cyan5"]
    left, right = owner_of((0.0, 0.1), field, setup.pitch), owner_of((0.0, -0.1), field, setup.pitch)
    assert left != right
    assert owner_of((0.0, -0.1), field, setup.pitch, plays=left) == left


def test_eleven_robots_have_parts_of_their_own():
    assert len(set(MIDDLES)) == len(MIDDLES) == 10
