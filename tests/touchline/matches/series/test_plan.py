"""The plan of a series."""

import pytest

from schemas.config.match_config import load_match
from schemas.config.shipped_teams import brain_of
from schemas.errors import TouchlineError
from schemas.side import Side
from touchline.matches.series.plan import plan_series, with_brains, with_sides_swapped


def test_each_seed_is_one_match_that_differs_in_its_seed_alone() -> None:
    config = load_match(None)
    plan = plan_series(config, [3, 9])
    assert [one.seed for one in plan.matches] == [3, 9]
    assert [one.planned.config for one in plan.matches] == [config.model_copy(update={"seed": seed}) for seed in (3, 9)]


def test_with_both_sides_each_seed_is_a_pair_with_the_teams_on_each_others_side() -> None:
    plan = plan_series(load_match(None), [5], both_sides=True)
    one, other = plan.matches
    assert (one.seed, one.swapped, other.seed, other.swapped) == (5, False, 5, True)
    assert other.sides == (Side.MAGENTA, Side.CYAN)
    assert (other.planned.config.teams.cyan, other.planned.config.teams.magenta) == (
        one.planned.config.teams.magenta,
        one.planned.config.teams.cyan,
    )


def test_types_of_robots_move_with_the_team() -> None:
    config = load_match(None, {"teams.cyan.types": {"cyan2": "keeper"}, "types.keeper": {}})
    assert with_sides_swapped(config).teams.magenta.types == {"magenta2": "keeper"}


def test_sides_swapped_twice_are_the_first_again() -> None:
    config = load_match(None, {"teams.cyan.size": 3, "teams.magenta.robots": ["one", "two"]})
    assert with_sides_swapped(with_sides_swapped(config)) == config


def test_equal_matches_have_equal_identities_and_others_have_others() -> None:
    first, again = (plan_series(load_match(None), [1, 2], both_sides=True).matches for _ in range(2))
    assert [one.identity for one in first] == [one.identity for one in again]
    assert len({one.identity for one in first}) == 4


def test_teams_of_the_same_name_are_told_apart() -> None:
    config = load_match(None, {"teams.cyan.name": "Same", "teams.magenta.name": "Same"})
    assert plan_series(config, [1]).teams == ("Same (1)", "Same (2)")


def test_a_team_that_is_no_brain_in_python_is_refused() -> None:
    program = load_match(None, {"teams.cyan": {"command": ["./robot"]}})
    with pytest.raises(TouchlineError, match=r"teams\.cyan is a program on the network.*--cyan module:Class"):
        plan_series(program, [1])
    remote = load_match(None, {"teams.magenta": "remote"})
    with pytest.raises(TouchlineError, match=r"teams\.magenta is remote"):
        plan_series(remote, [1])


def test_each_shipped_team_is_known_by_its_name() -> None:
    assert brain_of("nubot") == "robot_agent.teams.nubot:NuBot"
    assert brain_of("my_team:Striker") == "my_team:Striker"
    with pytest.raises(TouchlineError, match="did you mean"):
        brain_of("simpel")


def test_a_team_of_lines_plays_a_series() -> None:
    config = load_match(None, {"teams.cyan.stdio": ["node", "robot.js"]})
    assert [match.seed for match in plan_series(config, [1, 2]).matches] == [1, 2]


def test_a_brain_replaces_the_program_of_the_file_and_its_robots_stay() -> None:
    config = load_match(None, {"teams.cyan": {"command": ["./robot"], "size": 3}, "teams.magenta": "remote"})
    changed = with_brains(config, {Side.CYAN: "a:B", Side.MAGENTA: "c:D"})
    assert [changed.team(side).brain for side in Side] == ["a:B", "c:D"]
    assert [len(changed.robots(side)) for side in Side] == [3, 5]
    assert plan_series(changed, [1]).teams == ("B", "D")
