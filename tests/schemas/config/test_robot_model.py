"""Types of robots: a profile and a match file change numbers of the standard robot, and every robot gets its own."""

from pathlib import Path

import pytest
from pytest import approx

from schemas.config.match_config import MatchConfig, load_match
from schemas.config.profile import load_profile
from schemas.config.robot_model import models_of, types_of
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup
from schemas.side import Side

HEAVY = """
[types.heavy.robot]
mass = { value = 60.0, unit = "kg", origin = "a second battery" }
[types.slow.drive]
max_speed = { value = 1.0, unit = "m/s", origin = "slower still" }
[teams.cyan]
types = { cyan1 = "keeper", cyan2 = "heavy", cyan3 = "slow" }
"""


def match_of(text: str, folder: Path) -> MatchConfig:
    path = folder / "cup.toml"
    path.write_text(text)
    return load_match(path)


def test_the_leagues_profile_has_a_keeper_with_a_wide_frame_and_a_slow_robot() -> None:
    """Rule book 10.2: the goalkeeper's frame may be 60 cm wide."""
    types = types_of(load_profile("msl"))
    assert list(types) == ["standard", "keeper", "slow"]
    assert types["keeper"].body.frame_width == 0.60
    assert types["keeper"].body.reach == approx((0.245**2 + 0.30**2) ** 0.5)
    assert types["slow"].drive.max_speed == 2.0 < types["standard"].drive.max_speed
    assert types["slow"].body == types["standard"].body


def test_a_body_without_a_frame_reaches_as_far_as_its_radius() -> None:
    assert load_profile("paper").robot.reach == load_profile("paper").robot.radius


def test_a_match_file_adds_types_changes_those_of_the_profile_and_assigns_them_to_robots(tmp_path: Path) -> None:
    models = models_of(match_of(HEAVY, tmp_path), load_profile("msl"))
    assert [models[f"cyan{number}"].type for number in range(1, 5)] == ["keeper", "heavy", "slow", "standard"]
    assert (models["cyan2"].body.mass, models["cyan4"].body.mass) == (60.0, 39.0)
    assert (models["cyan3"].drive.max_speed, models["cyan3"].drive.max_turn_rate) == (1.0, 2.0)
    assert {models[name].type for name in models if name.startswith("magenta")} == {"standard"}


def test_a_profile_that_extends_another_changes_one_number_of_its_type(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(
        'extends = "msl"\n[types.keeper.robot]\nframe_width = { value = 0.5, unit = "m", origin = "ours" }\n'
    )
    keeper = types_of(load_profile(str(path)))["keeper"]
    assert (keeper.body.frame_width, keeper.body.frame_depth) == (0.5, 0.08)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[teams.cyan]\ntypes = { cyan1 = "keper" }', 'teams.cyan.types.cyan1 is "keper"; did you mean "keeper"?'),
        ('[teams.cyan]\ntypes = { cyan9 = "keeper" }', "teams.cyan.types.cyan9: no robot of the side has that name"),
        ("[types.slow.drive]\nmax_speed = 1.0", "types.slow.drive.max_speed is 1.0; write { value"),
        (
            '[types.slow.drive]\nmax_sped = { value = 1.0, unit = "m/s", origin = "x" }',
            'types.slow.drive.max_sped is not known; did you mean "max_speed"?',
        ),
        (
            '[types.slow.drive]\nmax_speed = { value = 1.0, unit = "km/h", origin = "x" }',
            "types.slow.drive.max_speed has unit 'km/h'; its unit is \"m/s\"",
        ),
        ("[types.slow.field]\nlength = 3", "types.slow.field is not known"),
        ("[types.standard.robot]\nmass = 3", "types.standard is the profile's own robot"),
        (
            '[types.odd.robot]\nframe_width = { value = 0.6, unit = "m", origin = "x" }',
            "types.odd: robot.frame_width is 0.6 m, robot.frame_depth 0.0 m; a frame has both",
        ),
        (
            '[types.odd.dribble]\ngap = { value = 0.6, unit = "m", origin = "x" }',
            "types.odd: dribble.gap is 0.6 m; a held ball must stay within dribble.distance",
        ),
        ("[types.odd]\nrobot = 3", "types.odd.robot is 3; write a table"),
    ],
)
def test_a_wrong_type_is_named_in_one_line_with_its_remedy(text: str, said: str, tmp_path: Path) -> None:
    with pytest.raises(TouchlineError) as error:
        models_of(match_of(text, tmp_path), load_profile("msl"))
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_the_setup_has_every_type_and_the_robots_of_each(tmp_path: Path) -> None:
    config, profile = match_of(HEAVY, tmp_path), load_profile("msl")
    setup = Setup.decode(Setup.of(config, profile, load_rule_book("msl")).encode())
    assert setup.robot.mass == setup.models["standard"].body.mass == 39.0
    assert setup.teams[Side.CYAN].types["cyan2"] == "heavy"
    assert setup.models["heavy"].body.mass == 60.0
    assert setup.for_robot("cyan2").robot.mass == 60.0
    assert setup.for_robot("cyan3").drive.max_speed == 1.0
    assert setup.for_robot("cyan2").for_robot("cyan4") == setup
