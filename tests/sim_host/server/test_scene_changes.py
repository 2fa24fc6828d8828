"""Scenes on the bus: robots come and go while the host runs, and all clients are notified."""

import pytest

from schemas.config.scene import Scene, SceneRobot
from schemas.messages.scene import SceneOperation, SceneReply, SceneRequest
from schemas.messages.setup import SetupRequest
from schemas.side import Side
from schemas.soccer.game import EventKind
from schemas.topics import EVENT, HEALTH, INVALID, SCENE, SETUP, SIGHT, STATE, WORLD


def ask(rig, operation, **content) -> SceneReply:
    """The host's answer, given before the next tick."""
    answer = rig.outside.query(SCENE, SceneRequest(operation=operation, **content))
    rig.ticks(1)
    reply = answer.result(0.0)
    assert reply.accepted, reply.reason
    return reply


def cyan(name, x, y, **more) -> SceneRobot:
    return SceneRobot(name=name, side=Side.CYAN, x=x, y=y, **more)


@pytest.mark.parametrize("rig_name", ["rig", "realtime_rig"])
def test_a_removed_robot_gets_no_more_sights_and_its_health_reports_the_removal(rig_name, request):
    rig = request.getfixturevalue(rig_name)
    sights, health = rig.listen(SIGHT), rig.listen(HEALTH)
    rig.ticks(3)
    ask(rig, SceneOperation.REMOVE, remove=["cyan2"])
    sights.all()
    rig.pass_time(0.3)
    rig.ticks(3)
    assert {sight.robot for sight in sights.all()} == {"cyan1", "magenta1"}
    row = health.all()[-1].robots["cyan2"]
    assert (row.removed, row.alive, row.answering) == (True, True, False)
    assert rig.host.simulation.now.tick == 7


def test_a_robot_that_is_put_back_is_played_by_its_agent_again(rig):
    rig.ticks(3)
    ask(rig, SceneOperation.REMOVE, remove=["cyan2"])
    rig.ticks(3)
    ask(rig, SceneOperation.ADD, robots=[cyan("cyan2", -4.0, 5.0)])
    rig.inputs("cyan1")
    rig.ticks(2)
    assert [given.answers_tick for given in rig.inputs("cyan2")] == [8, 9]
    row = rig.health().robots["cyan2"]
    assert not row.removed and row.answering


def test_an_added_robot_rests_until_an_agent_comes_for_it(rig):
    rig.ticks(3)
    ask(rig, SceneOperation.ADD, robots=[cyan("cyan7", -4.0, 5.0)])
    rig.ticks(5)
    assert rig.truth("cyan7")["vx"] == 0.0
    assert any("cyan7 does not answer" in text for text in rig.silences())
    rig.join("cyan7")
    rig.ticks(20)
    assert rig.truth("cyan7")["vx"] > 0.3
    assert rig.health().robots["cyan7"].alive


def test_an_agent_that_came_before_its_robot_plays_it_at_once(rig):
    rig.join("cyan7")
    rig.ticks(3)
    ask(rig, SceneOperation.ADD, robots=[cyan("cyan7", -4.0, 5.0)])
    rig.ticks(20)
    assert rig.truth("cyan7")["vx"] > 0.3


def test_the_host_does_not_wait_for_the_agent_of_a_still_robot(rig):
    robots = [cyan("cyan1", -4.0, 5.0), cyan("cyan2", -4.0, 3.0, agent=False)]
    ask(rig, SceneOperation.LOAD, scene=Scene(description="x", robots=robots))
    rig.agents["cyan2"].frozen = True
    before = rig.clock.now()
    rig.ticks(10)
    assert rig.clock.now() - before < 1.0
    row = rig.health().robots["cyan2"]
    assert row.still and not row.removed


def test_another_episode_is_published_to_all_and_the_setup_has_the_new_roster(rig):
    events, states, worlds = rig.listen(EVENT), rig.listen(STATE), rig.listen(WORLD)
    rig.ticks(3)
    reply = ask(rig, SceneOperation.LOAD, load="two_on_one")
    late = rig.outside.query(SETUP, SetupRequest())
    rig.ticks(1)
    assert reply.episode == 2
    assert [world.episode for world in worlds.all()][-3:] == [1, 2, 2]
    assert states.all()[-1].episode == 2
    (said,) = [event for event in events.all() if event.kind is EventKind.SCENE]
    assert said.text == "operator loads the scene two_on_one; episode 2 begins"
    teams = late.result(0.0).teams
    assert teams[Side.CYAN].robots == ["cyan2", "cyan3"] and not teams[Side.CYAN].goalkeeper
    assert teams[Side.MAGENTA].robots == ["magenta1", "magenta2"] and teams[Side.MAGENTA].goalkeeper


def test_an_invalid_scene_is_refused_with_the_reason(rig):
    told = rig.listen(INVALID)
    rig.outside.query(SCENE, SetupRequest())
    rig.ticks(1)
    (invalid,) = told.all()
    assert invalid.key == "host/scene" and "operation" in invalid.reason
