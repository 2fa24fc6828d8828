"""Profiles and rule books: every number has a unit and an origin, and a wrong one is named."""

from pathlib import Path

import pytest
from pytest import approx

from schemas.config.profile import SHIPPED, load_profile
from schemas.config.quantity import Quantity, meanings
from schemas.config.sections import SECTIONS
from schemas.config.soccer.rule_book import SECTIONS as RULE_SECTIONS
from schemas.config.soccer.rule_book import SHIPPED as RULE_BOOKS
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError


@pytest.mark.parametrize("name", SHIPPED)
def test_every_number_of_a_shipped_profile_has_unit_and_origin(name: str) -> None:
    profile = load_profile(name)
    for section, cls in SECTIONS.items():
        for key, meaning in meanings(cls).items():
            assert profile.origins[f"{section}.{key}"]
            assert not isinstance(meaning, Quantity) or meaning.unit


@pytest.mark.parametrize("name", RULE_BOOKS)
def test_every_number_of_a_shipped_rule_book_has_unit_and_origin(name: str) -> None:
    book = load_rule_book(name)
    for section, cls in RULE_SECTIONS.items():
        for key in meanings(cls):
            assert book.origins[f"{section}.{key}"]


@pytest.mark.parametrize(
    ("name", "size", "penalty_area", "goal_area", "goal"),
    [
        ("msl", (22, 14), (6.9, 2.25), (3.9, 0.75), (2.4, 1.0)),
        ("paper", (18, 12), (6.5, 2.25), (3.5, 0.75), (2.0, 1.0)),
    ],
)
def test_pitches_have_the_sizes_of_their_rule_books(
    name: str,
    size: tuple[float, float],
    penalty_area: tuple[float, float],
    goal_area: tuple[float, float],
    goal: tuple[float, float],
) -> None:
    """An area is as wide as the goal and twice its depth, in either year."""
    pitch = load_profile(name).field
    assert (pitch.length, pitch.width) == size
    assert (pitch.penalty_area_width, pitch.penalty_area_depth) == approx(penalty_area)
    assert (pitch.goal_area_width, pitch.goal_area_depth) == approx(goal_area)
    assert (pitch.goal_width, pitch.goal_height) == goal


def test_the_papers_tables_are_in_its_profile() -> None:
    """Tables I and II."""
    paper = load_profile("paper")
    assert (paper.robot.mass, paper.robot.inertia_zz, paper.robot.inertia_xx, paper.robot.friction) == (
        31,
        2.86,
        0,
        0.1,
    )
    assert paper.time.physics_step == 0.007


def test_nine_restart_spots_are_marked() -> None:
    """Rule book 10.1: centre, two penalty marks, two on the halfway line, four beside the marks; Q is 3.5 m."""
    spots = load_profile("msl").field.restart_spots
    assert len(set(spots)) == 9
    assert {(0.0, 0.0), (7.4, 0.0), (-7.4, 0.0), (0.0, 3.5), (7.4, -3.5)} <= {(round(x, 6), y) for x, y in spots}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[field]\nlenght = 3", 'field.lenght is not known; did you mean "length"?'),
        (
            '[field]\nlength = { value = 22, unit = "cm", origin = "x" }',
            "field.length has unit 'cm'; its unit is \"m\"",
        ),
        (
            '[field]\nlength = { value = 2200, unit = "m", origin = "x" }',
            "field.length is 2200; it must be between 4 and 120 m",
        ),
        ('[field]\nlength = { value = "22", unit = "m", origin = "x" }', "field.length is '22'; write a number in m"),
        ('[field]\nlength = { value = nan, unit = "m", origin = "x" }', "field.length is nan; write a number in m"),
        ("[field]\nlength = 22", "field.length is 22; write { value"),
        ('[time]\nsteps_per_tick = { value = 2.5, unit = "1", origin = "x" }', "write a whole number"),
        ('[dribble]\nmethod = { value = "glue", origin = "x" }', "dribble.method is 'glue'; known: pose, velocity"),
        (
            '[wheels]\nmax_speed = { value = 7, unit = "m/s", origin = "x" }',
            "wheels.max_speed is 7.0 m/s; no_load_speed, radius and gear let a rim reach 6.62 m/s at most",
        ),
        (
            '[drive]\nmodel = { value = "diferential", origin = "x" }',
            "drive.model is 'diferential'; did you mean \"differential\"?",
        ),
        (
            '[drive]\nmodel = { value = "differential", origin = "x" }',
            'wheels.count is 4; a robot whose drive.model is "differential" has 2 wheels',
        ),
        (
            '[types.own.wheels]\ncount = { value = 2, unit = "1", origin = "x" }',
            'types.own: wheels.count is 2; a robot whose drive.model is "traction" has 3 or 4 wheels',
        ),
        (
            '[types.own.wheels]\ncount = { value = 2, unit = "1", origin = "x" }\n'
            'max_speed = { value = 3, unit = "m/s", origin = "x" }\n'
            '[types.own.drive]\nmodel = { value = "differential", origin = "x" }',
            "types.own: drive.max_speed is 4.0 m/s; two wheels with wheels.max_speed 3.0 m/s drive no faster",
        ),
        ("[feild]\nlength = 3", 'section [feild] is not known; did you mean "field"?'),
        ('[dribble]\ngap = { value = 0.6, unit = "m", origin = "x" }', "a held ball must stay within dribble.distance"),
        ("[field", "not TOML"),
    ],
)
def test_a_wrong_profile_names_place_value_and_remedy(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('extends = "msl"\n' + text)
    with pytest.raises(TouchlineError) as error:
        load_profile(str(path))
    assert said in str(error.value)
    assert str(path) in str(error.value)
    assert "\n" not in str(error.value)


def test_a_profile_of_ones_own_changes_what_it_names_and_keeps_the_rest(tmp_path: Path) -> None:
    path = tmp_path / "small.toml"
    path.write_text('extends = "msl"\n[field]\nlength = { value = 12, unit = "m", origin = "our hall" }\n')
    small, msl = load_profile(str(path)), load_profile("msl")
    assert small.field.length == 12
    assert small.origins["field.length"] == "our hall"
    assert small.field.width == msl.field.width and small.robot == msl.robot


def test_an_unknown_profile_is_no_other() -> None:
    with pytest.raises(TouchlineError, match='did you mean "paper"'):
        load_profile("papr")
    with pytest.raises(TouchlineError, match='did you mean "friendly"'):
        load_rule_book("freindly")


def test_the_rule_books_of_2016_and_of_today_differ_in_what_the_sources_say() -> None:
    then, today = load_rule_book("msl-2016"), load_rule_book("msl")
    assert (then.discipline.suspension, today.discipline.suspension) == (120.0, 90.0)
    assert (then.people.repair, today.people.repair) == (30.0, 20.0)
    assert (then.people.substitutions, today.people.substitutions) == (0, 3)
    assert then.origins["discipline.suspension"].startswith("rule book 2016")
    assert load_rule_book("msl-2019").origins["restarts.drag_distance"].startswith("rule book 2019")


@pytest.mark.parametrize("name", ["msl", "msl-2016", "msl-2019"])
def test_an_origin_of_the_leagues_rule_books_names_its_source_or_is_ours(name: str) -> None:
    sources = (
        "rule book",
        "the rule book",
        "the league's referee box",
        "ours",
        "simatch",
        "China simulation league 2020",
        "Small Size League",
        "Laws of the Game",
    )
    for number, origin in load_rule_book(name).origins.items():
        assert origin.startswith(sources), number


def test_the_pitch_of_the_rule_book_of_2016_is_in_its_profile() -> None:
    book = load_rule_book("msl-2016")
    assert book.profile == "msl-2016" and load_rule_book("msl-2019").profile is None
    pitch = load_profile("msl-2016").field
    assert (pitch.length, pitch.width, pitch.goal_width, pitch.penalty_mark) == (18.0, 12.0, 2.0, 3.0)
    assert pitch.penalty_area_width == approx(6.5) and pitch.goal_area_width == approx(3.5)
    assert load_profile("msl-2016").robot == load_profile("msl").robot


@pytest.mark.parametrize("text", ["profile = 3", "profile = true"])
def test_the_profile_of_a_rule_book_is_a_name(tmp_path: Path, text: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(f'extends = "msl"\n{text}\n')
    with pytest.raises(TouchlineError, match=r"mine\.toml: profile is .*; write the name of a profile"):
        load_rule_book(str(path))
