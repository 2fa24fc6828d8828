"""Tests of TeamName: scenes, played in this process. `touchline scene list` lists them."""

from touchline.testing import ScenePlayer

TEAM = "team_name:TeamName"


def test_it_shoots_at_a_lone_goalkeeper(play: ScenePlayer) -> None:
    facts = play("one_against_keeper", cyan=TEAM)
    assert facts.first("shot").time < 8.0


def test_it_scores_now_and_then(play: ScenePlayer) -> None:
    runs = play.over("one_against_keeper", cyan=TEAM, seeds=range(1, 21))
    runs.at_least(2, lambda facts: facts.has("goal:cyan"))


def test_its_throw_in_reaches_a_teammate_more_often_than_not(play: ScenePlayer) -> None:
    runs = play.over("throw_in", cyan=TEAM, seeds=range(1, 6))
    runs.at_least(3, lambda facts: facts.success)


def test_no_field_robot_enters_the_goal_area_of_the_opponents(play: ScenePlayer) -> None:
    facts = play("two_on_one", cyan=TEAM)
    assert not any(facts.enters(robot, "goal_area:magenta") for robot in ("cyan2", "cyan3"))
