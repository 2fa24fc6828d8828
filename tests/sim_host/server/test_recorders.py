"""How far a lockstep host runs ahead of its recorders."""

import pytest

from schemas.config.match_config import MatchConfig
from sim_host.server.presence_tracker import MAX_RECORDER_LAG

PATIENCE_S = MatchConfig().patience.recorder
"""How long the host waits for a recorder that stands still; the match file's default."""


@pytest.fixture
def recorder(rig):
    return rig.record()


def test_a_recorder_that_stands_still_holds_the_host_once_and_is_then_left_behind(rig, recorder):
    rig.ticks(10)
    recorder.stands = True
    rig.ticks(MAX_RECORDER_LAG)
    assert rig.clock.now() < PATIENCE_S
    rig.ticks(50)
    assert PATIENCE_S < rig.clock.now() < 2 * PATIENCE_S
    assert rig.health().recorders["recorder"] == pytest.approx(MAX_RECORDER_LAG + 50, abs=2)


def test_a_recorder_that_was_left_behind_is_waited_for_again_when_it_moves(rig, recorder):
    recorder.stands = True
    rig.ticks(MAX_RECORDER_LAG + 20)
    recorder.stands = False
    rig.ticks(1)
    assert rig.health().recorders["recorder"] <= 2
    recorder.stands = True
    before = rig.clock.now()
    rig.ticks(MAX_RECORDER_LAG + 20)
    assert rig.clock.now() - before > PATIENCE_S


def test_a_recorder_that_is_slow_is_waited_for_as_long_as_it_moves(rig, recorder):
    recorder.stands = True

    def take_one_in_half_a_second():
        if rig.clock.now() >= 0.5 * (recorder.seen + 2) and (received := recorder.worlds.receive()) is not None:
            recorder.seen = received.message().tick

    rig.idle.append(take_one_in_half_a_second)
    rig.ticks(MAX_RECORDER_LAG + 20)
    assert rig.host.simulation.now.tick - recorder.seen <= MAX_RECORDER_LAG + 1
    assert rig.clock.now() >= 0.5 * 19


def test_a_dead_recorder_stops_the_match_no_longer_than_one_that_stands_still(rig, recorder):
    rig.ticks(5)
    recorder.stands = True
    rig.ticks(MAX_RECORDER_LAG - 20)
    rig.idle.remove(recorder.pump)
    recorder.bus.close()
    rig.ticks(60)
    assert PATIENCE_S < rig.clock.now() < PATIENCE_S + 1.0
    assert rig.health().recorders == {}


def test_a_recorder_that_says_it_leaves_is_waited_for_no_longer(rig, recorder):
    recorder.stands = True
    rig.ticks(MAX_RECORDER_LAG - 2)
    began = rig.clock.now()

    def leave():
        if rig.clock.now() > began + 0.3:
            recorder.leave()
            rig.idle.clear()

    rig.idle.append(leave)
    rig.ticks(10)
    assert 0.3 < rig.clock.now() - began < 0.5
    assert rig.health().recorders == {}


def test_a_frozen_recorder_whose_link_broke_is_waited_for_until_it_is_back(rig, recorder):
    """A link breaks after 2 s of silence; the host must not run out of what can be fetched again meanwhile."""
    rig.ticks(5)
    rig.idle.remove(recorder.pump)
    recorder.bus.close()
    newest = recorder.seen
    back = []

    def come_back():
        if rig.clock.now() > 3.0 and not back:
            assert rig.host.simulation.now.tick <= newest + MAX_RECORDER_LAG + 1
            back.append(rig.record())
            back[0].seen = newest

    rig.idle.append(come_back)
    rig.ticks(2 * MAX_RECORDER_LAG)
    assert back
    assert rig.health().recorders["recorder"] <= 2


def test_a_recorder_that_talks_without_end_and_does_not_move_is_left_behind(rig, recorder):
    recorder.stands = True
    rig.idle.extend([recorder.pump] * 20)
    rig.ticks(MAX_RECORDER_LAG + 20)
    assert rig.clock.now() < 2 * PATIENCE_S


def test_at_the_end_the_recorders_get_time_for_the_last_tick(rig_of, monkeypatch):
    rig = rig_of(duration=1)
    recorder = rig.record()
    recorder.stands = True
    rig.join_all()
    update, looks = rig.host.presence.update, []

    def look(timeout=0.0):
        if rig.host.simulation.over:
            looks.append(rig.clock.now())
            rig.pass_time(0.1)
            recorder.stands = len(looks) < 20
            recorder.pump()
        return update(0.0)

    monkeypatch.setattr(rig.host.presence, "update", look)
    rig.host.run()
    assert len(looks) == 20
    assert rig.host.presence.recorder_lags(rig.host.simulation.now.tick) == {"recorder": 0}


def test_at_the_end_a_recorder_that_stands_still_is_not_waited_for_without_end(rig_of, monkeypatch):
    rig = rig_of(duration=1)
    rig.record().stands = True
    rig.join_all()
    update = rig.host.presence.update

    def look(timeout=0.0):
        rig.pass_time(timeout)
        return update(0.0)

    monkeypatch.setattr(rig.host.presence, "update", look)
    rig.host.run()
    assert rig.host.simulation.over
