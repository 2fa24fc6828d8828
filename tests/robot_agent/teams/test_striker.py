"""What a robot of Simple does with the ball at its foot."""

import pytest

from robot_agent.sdk.bodies import Body, DriveLimits
from robot_agent.sdk.world_model import Teammate
from robot_agent.teams.simple.striker import PATIENCE, StrikerSituation, play_ball


@pytest.fixture
def intention(setup):
    def of(mate, held):
        me = Body(0.0, 0.0, 0.0)
        mates = {"cyan3": Teammate(Body(*mate, 0.0), "", "", None)}
        return play_ball(StrikerSituation(me, mates, (), held, 0.0, "cyan3"), setup, DriveLimits.of(setup)).intention

    return of


@pytest.mark.parametrize(
    ("mate", "held", "does"),
    [((4.0, 1.0), 0.0, "pass to cyan3"), ((-4.0, 1.0), 0.0, "carry"), ((-4.0, 1.0), PATIENCE + 0.1, "pass to cyan3")],
)
def test_the_ball_goes_back_to_the_receiver_it_was_meant_for_only_in_a_hurry(intention, mate, held, does):
    assert intention(mate, held) == does
