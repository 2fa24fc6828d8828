"""Scenes on the bus: robots come and go while the host runs, and everybody is told (reference 13, rows 22 and 42)."""

import pytest

from schemas.game import EventKind
from schemas.host import SetupRequest
from schemas.scene import Scene, SceneDeed, SceneReply, SceneRequest, SceneRobot
from schemas.side import Side
from schemas.topics import EVENT, HEALTH, INVALID, SCENE, SETUP, SIGHT, STATE, WORLD


def ask(pitch, deed, **content) -> SceneReply:
    """The host's answer, given before the next tick."""
    answer = pitch.outside.ask(SCENE, SceneRequest(deed=deed, **content))
    pitch.ticks(1)
    reply = answer.result(0.0)
    assert reply.accepted, reply.reason
    return reply


def cyan(name, x, y, **more) -> SceneRobot:
    return SceneRobot(name=name, side=Side.CYAN, x=x, y=y, **more)


@pytest.mark.parametrize("stage", ["pitch", "live"])
def test_a_removed_robot_gets_no_more_sights_and_its_health_says_why(stage, request):
    pitch = request.getfixturevalue(stage)
    sights, health = pitch.hear(SIGHT), pitch.hear(HEALTH)
    pitch.ticks(3)
    ask(pitch, SceneDeed.REMOVE, remove=["cyan2"])
    sights.all()
    pitch.pass_time(0.3)
    pitch.ticks(3)
    assert {sight.robot for sight in sights.all()} == {"cyan1", "magenta1"}
    row = health.all()[-1].robots["cyan2"]
    assert (row.removed, row.alive, row.answering) == (True, True, False)
    assert pitch.host.simulation.now.tick == 7


def test_a_robot_that_is_put_back_is_played_by_its_agent_again(pitch):
    pitch.ticks(3)
    ask(pitch, SceneDeed.REMOVE, remove=["cyan2"])
    pitch.ticks(3)
    ask(pitch, SceneDeed.ADD, robots=[cyan("cyan2", -4.0, 5.0)])
    pitch.inputs("cyan1")
    pitch.ticks(2)
    assert [given.answers_tick for given in pitch.inputs("cyan2")] == [8, 9]
    row = pitch.health().robots["cyan2"]
    assert not row.removed and row.answering


def test_an_added_robot_rests_until_an_agent_comes_for_it(pitch):
    pitch.ticks(3)
    ask(pitch, SceneDeed.ADD, robots=[cyan("cyan7", -4.0, 5.0)])
    pitch.ticks(5)
    assert pitch.truth("cyan7")["vx"] == 0.0
    assert any("cyan7 does not answer" in text for text in pitch.silences())
    pitch.join("cyan7")
    pitch.ticks(20)
    assert pitch.truth("cyan7")["vx"] > 0.3
    assert pitch.health().robots["cyan7"].alive


def test_an_agent_that_came_before_its_robot_plays_it_at_once(pitch):
    pitch.join("cyan7")
    pitch.ticks(3)
    ask(pitch, SceneDeed.ADD, robots=[cyan("cyan7", -4.0, 5.0)])
    pitch.ticks(20)
    assert pitch.truth("cyan7")["vx"] > 0.3


def test_nobody_waits_for_the_agent_of_a_robot_that_stands_still(pitch):
    robots = [cyan("cyan1", -4.0, 5.0), cyan("cyan2", -4.0, 3.0, agent=False)]
    ask(pitch, SceneDeed.LOAD, scene=Scene(says="x", robots=robots))
    pitch.agents["cyan2"].frozen = True
    before = pitch.clock.now()
    pitch.ticks(10)
    assert pitch.clock.now() - before < 1.0
    row = pitch.health().robots["cyan2"]
    assert row.still and not row.removed


def test_everyone_is_told_of_another_episode_and_late_comers_of_who_plays(pitch):
    events, states, worlds = pitch.hear(EVENT), pitch.hear(STATE), pitch.hear(WORLD)
    pitch.ticks(3)
    reply = ask(pitch, SceneDeed.LOAD, load="two_on_one")
    late = pitch.outside.ask(SETUP, SetupRequest())
    pitch.ticks(1)
    assert reply.episode == 2
    assert [world.episode for world in worlds.all()][-3:] == [1, 2, 2]
    assert states.all()[-1].episode == 2
    (said,) = [event for event in events.all() if event.kind is EventKind.SCENE]
    assert said.text == "operator loads the scene two_on_one; episode 2 begins"
    teams = late.result(0.0).teams
    assert teams[Side.CYAN].robots == ["cyan2", "cyan3"] and not teams[Side.CYAN].goalkeeper
    assert teams[Side.MAGENTA].robots == ["magenta1", "magenta2"] and teams[Side.MAGENTA].goalkeeper


def test_a_scene_that_is_none_is_told_with_what_is_wrong(pitch):
    told = pitch.hear(INVALID)
    pitch.outside.ask(SCENE, SetupRequest())
    pitch.ticks(1)
    (invalid,) = told.all()
    assert invalid.key == "host/scene" and "deed" in invalid.reason
