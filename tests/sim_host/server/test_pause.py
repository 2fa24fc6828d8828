"""An operator pauses a running match, steps it, and lets it run; the match stays the one that it would have been."""

from collections.abc import Callable
from typing import Any

import pytest

from schemas.config.roster import Placement
from schemas.messages.pace import PaceReply, PaceRequest
from schemas.messages.scene import SceneOperation, SceneReply, SceneRequest
from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import ActionName
from schemas.topics import ACTION, APPLIED, HEALTH, PACE, SCENE, WORLD
from support.host_rig import HostRig
from support.paused_host import RUN, STEP, ask, pace, paused, stepped_to


@pytest.mark.parametrize("rig_name", ["rig", "realtime_rig"])
def test_a_paused_match_computes_the_ticks_of_its_steps_and_no_others(
    rig_name: str, request: pytest.FixtureRequest
) -> None:
    rig = request.getfixturevalue(rig_name)
    worlds = rig.listen(WORLD)
    worlds.all()
    with paused(rig, 30):
        stepped_to(rig, 1)
        stepped_to(rig, 9)
        assert [world.tick for world in worlds.all()] == list(range(1, 10))
        assert pace(rig, RUN) == PaceReply(accepted=True, tick=9, paused=False)
    assert rig.host.simulation.now.tick == 30


@pytest.mark.parametrize("words", [{}, {"pace": "realtime"}])
def test_a_match_that_was_paused_and_stepped_has_the_chain_of_one_that_ran_through(
    rig_of: Callable[..., HostRig], words: dict[str, str]
) -> None:
    chains = []
    for is_paused in (False, True):
        rig = rig_of(**words)
        applied = rig.listen(APPLIED)
        rig.join_all()
        rig.begin()
        if is_paused:
            with paused(rig, 40):
                stepped_to(rig, 20)
                stepped_to(rig, 21)
                pace(rig, RUN)
        else:
            rig.ticks(40)
        chains.append([message.chain for message in applied.all()])
    assert len(chains[0]) == 41
    assert chains[1] == chains[0]


@pytest.mark.parametrize("rig_name", ["rig", "realtime_rig"])
def test_neither_patience_nor_watchdog_counts_during_a_pause(rig_name: str, request: pytest.FixtureRequest) -> None:
    rig = request.getfixturevalue(rig_name)
    health = rig.listen(HEALTH)
    rig.ticks(20)
    reports: list[Any] = []
    with paused(rig, 20):
        rig.pass_time(1000.0)
        while not any(report.paused for report in reports):
            reports += health.all()
        pace(rig, RUN)
    assert rig.truth("cyan1")["vx"] > 0.5
    assert rig.silences() == ["operator pauses the match", "operator lets the match run"]
    assert rig.host.pace.late_ticks == 0
    assert not rig.health().paused


def test_what_an_operator_changes_during_a_pause_is_there_after_the_next_step(rig: HostRig) -> None:
    with paused(rig, 3):
        there = Placement(body="cyan2", x=-1.0, y=5.0)
        reply = ask(rig, SceneRequest(operation=SceneOperation.PLACE, place=[there]), SCENE)
        assert isinstance(reply, SceneReply) and reply.accepted
        assert abs(rig.truth("cyan2")["x"] + 1.0) > 0.1
        stepped_to(rig, 1)
        assert rig.truth("cyan2")["x"] == pytest.approx(-1.0, abs=0.05)
        pace(rig, RUN)


def test_the_referee_refuses_actions_during_a_pause_at_once_and_does_not_carry_them_out_later(rig: HostRig) -> None:
    applied = rig.listen(APPLIED)
    with paused(rig, 3):
        reply = ask(rig, RefereeAction(action=ActionName.STOP), ACTION)
        assert not reply.accepted and "paused" in reply.reason
        pace(rig, RUN)
    assert not any(message.actions for message in applied.all())


def test_a_match_that_runs_cannot_be_stepped(rig: HostRig) -> None:
    asked = rig.outside.query(PACE, PaceRequest(operation=STEP))
    rig.ticks(1)
    assert asked.result(0.0).reason == "the match is not paused; pause it first"


def test_a_host_that_is_stopped_during_a_pause_ends(rig: HostRig) -> None:
    with paused(rig, 1):
        rig.host.stop()
    assert rig.host.simulation.now.tick == 1
