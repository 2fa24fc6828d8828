import pytest

from robot_agent.bodies import DriveLimits
from robot_agent.contract import Briefing
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.side import Side


def test_a_briefing_has_number_side_and_teammates(setup):
    keeper = Briefing.of("magenta1", setup)
    assert (keeper.side, keeper.number) == (Side.MAGENTA, 1)
    assert Briefing.of("cyan3", setup).teammates == ("cyan1", "cyan2", "cyan4", "cyan5")


def test_a_robot_that_does_not_play_is_named_with_the_nearest_that_does(setup):
    with pytest.raises(TouchlineError, match=r'robot is "cyam2".*friendly.*did you mean "cyan2"\?'):
        Briefing.of("cyam2", setup)


def test_a_briefing_has_the_numbers_of_the_robots_own_type() -> None:
    types = {"cyan1": "keeper", "cyan3": "slow"}
    config = load_match(None, {"teams.cyan.types": types})
    setup = Setup.of(config, load_profile("msl"), load_rule_book("msl"))
    slow, keeper, plain = (Briefing.of(name, setup).setup for name in ("cyan3", "cyan1", "magenta3"))
    assert DriveLimits.of(slow).speed == 2.0 < DriveLimits.of(plain).speed
    assert keeper.robot.reach > plain.robot.reach == plain.robot.radius
