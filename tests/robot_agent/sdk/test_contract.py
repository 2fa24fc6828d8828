import pytest

from robot_agent.sdk.bodies import DriveLimits
from robot_agent.sdk.contract import Briefing
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.messages.setup import Setup
from schemas.messages.sight import Sight
from schemas.side import Side
from touchline.play.play_match import InProcessMatch


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


def test_a_briefing_has_the_parameters_of_its_own_team() -> None:
    config = load_match(None, {"teams.cyan.parameters": {"press": 0.5, "plan": "wide", "risk": True, "depth": 3}})
    setup = Setup.of(config, load_profile("msl"), load_rule_book("msl"))
    decoded = Setup.decode(setup.encode())
    parameters = Briefing.of("cyan2", decoded).parameters
    assert parameters == {"press": 0.5, "plan": "wide", "risk": True, "depth": 3}
    assert [type(value) for value in parameters.values()] == [float, str, bool, int]
    assert Briefing.of("magenta2", decoded).parameters == {}


@pytest.mark.parametrize("value", [[1], float("nan"), {"deep": 1}])
def test_a_parameter_that_is_no_plain_value_is_refused_by_name(value: object) -> None:
    with pytest.raises(TouchlineError, match=r"teams\.cyan\.parameters.*press is .*; give a finite number"):
        load_match(None, {"teams.cyan.parameters.press": value})


def test_a_brain_in_a_match_gets_its_parameters() -> None:
    given = []

    class Idle:
        def __init__(self, briefing: Briefing) -> None:
            given.append((briefing.robot, dict(briefing.parameters)))

        def act(self, sight: Sight) -> Command:
            return Command(answers_tick=sight.tick)

    overrides = {"teams.cyan.size": 1, "teams.magenta.size": 1, "teams.magenta.parameters": {"depth": 3}}
    match = InProcessMatch(load_match(None, overrides), {"cyan1": Idle, "magenta1": Idle})
    match.close()
    assert given == [("cyan1", {}), ("magenta1", {"depth": 3})]
