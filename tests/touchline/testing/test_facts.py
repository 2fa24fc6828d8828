"""What a test of a brain can assert on, in scenes that are played."""

import math

import pytest
from pytest import approx

from schemas.config.scene import Scene, SceneBall, SceneRobot
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.debug import Debug
from schemas.messages.sight import Sight
from schemas.side import Side
from touchline import Briefing
from touchline.testing import Facts, ScenePlayer

SCENE = Scene(
    name="alone",
    description="A robot with the ball before it.",
    ball=SceneBall(x=6.0, y=0.0),
    robots=[SceneRobot(name="cyan2", side=Side.CYAN, x=5.0, y=0.0)],
)


class Drives:
    def __init__(self, briefing: Briefing) -> None:
        self.briefing = briefing

    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), dribble=True)


class Shoots(Drives):
    def act(self, sight: Sight) -> Command:
        kick = Kick(mode=KickMode.GROUND, speed=8.0) if sight.holding else None
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), dribble=True, kick=kick)


class Waits(Drives):
    def act(self, sight: Sight) -> Command:
        return Command(answers_tick=sight.tick)


@pytest.fixture(scope="module")
def shot() -> Facts:
    return ScenePlayer()(SCENE, cyan2=Shoots, seconds=3.0)


def test_a_scene_is_played_for_the_given_time(play: ScenePlayer) -> None:
    facts = play(SCENE, cyan2=Drives, seconds=1.5)
    assert facts.seconds == approx(1.5)
    assert len(facts.times) == len(facts.ball) == len(facts.robots["cyan2"]) == 76


def test_a_shot_is_known_with_its_time_and_its_goal(shot: Facts) -> None:
    kick, goal = shot.first("kick:cyan2"), shot.first("goal:cyan")
    assert 0.2 < kick.time < goal.time < 3.0
    assert (shot.score.cyan, shot.count("goal"), shot.has("goal:magenta")) == (1, 1, False)
    assert [one.robot for one in shot.shots] == ["cyan2"]
    assert shot.passes == []
    assert shot.first("touch:cyan2").time <= kick.time
    assert [event.kind for event in shot.events if event.kind == "goal"] == ["goal"]


def test_positions_are_those_of_each_tick(play: ScenePlayer) -> None:
    facts = play(SCENE, cyan2=Drives, seconds=1.0)
    way = facts.robots["cyan2"]
    assert tuple(way[0]) == approx((5.0, 0.0, 0.0), abs=1e-6)
    assert facts.distance("cyan2") == approx(way[-1][0] - 5.0, abs=0.02)
    assert facts.closest("cyan2", "ball") == approx(
        min(math.dist(a[:2], b[:2]) for a, b in zip(way, facts.ball, strict=True))
    )


def test_commands_are_those_that_answer_each_tick(play: ScenePlayer) -> None:
    facts = play(SCENE, cyan2=Drives, seconds=0.2)
    assert [command.answers_tick for command in facts.commands["cyan2"]] == list(range(11))


def test_debug_values_are_given_with_their_times(play: ScenePlayer) -> None:
    class Debugs(Drives):
        def act(self, sight: Sight) -> Command:
            values = {"tick": sight.tick, **({"late": True} if sight.tick >= 5 else {})}
            return Command(answers_tick=sight.tick, debug=Debug(values=values))

    facts = play(SCENE, cyan2=Debugs, seconds=0.2)
    assert [value for _, value in facts.debug("cyan2", "tick")] == list(range(11))
    assert facts.debug("cyan2", "late")[0] == (approx(0.1), True)
    assert facts.debug("cyan2", "other") == []


def test_a_robot_enters_the_areas_that_it_drives_through(play: ScenePlayer) -> None:
    facts = play(SCENE, cyan2=Drives, seconds=5.0)
    assert facts.enters("cyan2", "penalty_area:magenta")
    assert facts.enters("cyan2", "half:magenta")
    assert not facts.enters("cyan2", "half:cyan")
    assert not facts.enters("cyan2", "goal_area:cyan")
    assert facts.enters("cyan2", (5.5, -1.0, 6.0, 1.0))
    assert 0.0 < facts.time_in("cyan2", "penalty_area:magenta") < 5.0


def test_what_did_not_happen_is_named_in_the_message(play: ScenePlayer) -> None:
    facts = play(SCENE, cyan2=Waits, seconds=0.5, seed=7)
    with pytest.raises(AssertionError, match=r"no shot in 0.5 s of alone, seed 7: nothing happened"):
        facts.first("shot")


@pytest.mark.parametrize(
    ("what", "said"),
    [("shoot", 'did you mean "shot"'), ("shot:cyan9", "known: cyan, magenta, cyan2"), ("shot:", "known")],
)
def test_a_name_that_is_none_is_an_error_and_not_an_absence(shot: Facts, what: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        shot.has(what)


def test_an_area_or_a_robot_that_is_none_is_an_error(shot: Facts) -> None:
    with pytest.raises(ValueError, match='did you mean "goal_area:cyan"'):
        shot.enters("cyan2", "goal_area:cian")
    with pytest.raises(ValueError, match='did you mean "cyan2"'):
        shot.enters("cyan3", "goal_area:cyan")


def test_a_scene_with_a_verdict_is_played_to_it(play: ScenePlayer) -> None:
    facts = play("keeper_ground_shots", cyan=Waits, seed=1)
    assert facts.verdict is not None
    assert (facts.success, facts.verdict.because, facts.seconds) == (False, "goal:magenta", facts.verdict.time)


def test_equal_seeds_give_equal_runs_and_others_other_starts(play: ScenePlayer) -> None:
    one, again, other = (play("keeper_ground_shots", cyan=Waits, seconds=0.1, seed=seed) for seed in (1, 1, 2))
    assert (one.ball == again.ball).all()
    assert (one.ball != other.ball).any()


def test_a_brain_for_a_robot_that_is_not_in_the_scene_is_refused(play: ScenePlayer) -> None:
    with pytest.raises(TouchlineError, match="cyan3 is no robot with a brain in this match"):
        play(SCENE, cyan3=Drives)


def test_an_exception_of_a_brain_reaches_the_test_with_robot_and_tick(play: ScenePlayer) -> None:
    class Raises(Drives):
        def act(self, sight: Sight) -> Command:
            raise ValueError("no idea")

    with pytest.raises(ValueError, match=r"no idea\ncyan2, tick 0"):  # pytest adds an exception's notes
        play(SCENE, cyan2=Raises)
