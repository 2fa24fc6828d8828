"""How far a lockstep host runs ahead of its recorders."""

import pytest

from schemas.match_config import MatchConfig
from sim_host.attendance import WINDOW

PATIENCE_S = MatchConfig().patience.recorder
"""How long the host waits for a recorder that stands still; the match file's default."""


@pytest.fixture
def recorder(pitch):
    return pitch.record()


def test_a_recorder_that_stands_still_holds_the_host_once_and_is_then_left_behind(pitch, recorder):
    pitch.ticks(10)
    recorder.stands = True
    pitch.ticks(WINDOW)
    assert pitch.clock.now() < PATIENCE_S
    pitch.ticks(50)
    assert PATIENCE_S < pitch.clock.now() < 2 * PATIENCE_S
    assert pitch.health().recorders["recorder"] == pytest.approx(WINDOW + 50, abs=2)


def test_a_recorder_that_was_left_behind_is_waited_for_again_when_it_moves(pitch, recorder):
    recorder.stands = True
    pitch.ticks(WINDOW + 20)
    recorder.stands = False
    pitch.ticks(1)
    assert pitch.health().recorders["recorder"] <= 2
    recorder.stands = True
    before = pitch.clock.now()
    pitch.ticks(WINDOW + 20)
    assert pitch.clock.now() - before > PATIENCE_S


def test_a_recorder_that_is_slow_is_waited_for_as_long_as_it_moves(pitch, recorder):
    recorder.stands = True

    def take_one_in_half_a_second():
        if pitch.clock.now() >= 0.5 * (recorder.seen + 2) and (received := recorder.worlds.receive()) is not None:
            recorder.seen = received.message().tick

    pitch.idle.append(take_one_in_half_a_second)
    pitch.ticks(WINDOW + 20)
    assert pitch.host.simulation.now.tick - recorder.seen <= WINDOW + 1
    assert pitch.clock.now() >= 0.5 * 19


def test_a_dead_recorder_stops_the_match_no_longer_than_one_that_stands_still(pitch, recorder):
    pitch.ticks(5)
    recorder.stands = True
    pitch.ticks(WINDOW - 20)
    pitch.idle.remove(recorder.pump)
    recorder.bus.close()
    pitch.ticks(60)
    assert PATIENCE_S < pitch.clock.now() < PATIENCE_S + 1.0
    assert pitch.health().recorders == {}


def test_a_recorder_that_says_it_leaves_is_waited_for_no_longer(pitch, recorder):
    recorder.stands = True
    pitch.ticks(WINDOW - 2)
    began = pitch.clock.now()

    def leave():
        if pitch.clock.now() > began + 0.3:
            recorder.leave()
            pitch.idle.clear()

    pitch.idle.append(leave)
    pitch.ticks(10)
    assert 0.3 < pitch.clock.now() - began < 0.5
    assert pitch.health().recorders == {}


def test_a_frozen_recorder_whose_link_broke_is_waited_for_until_it_is_back(pitch, recorder):
    """A link breaks after 2 s of silence; the host must not run out of what can be fetched again meanwhile."""
    pitch.ticks(5)
    pitch.idle.remove(recorder.pump)
    recorder.bus.close()
    newest = recorder.seen
    back = []

    def come_back():
        if pitch.clock.now() > 3.0 and not back:
            assert pitch.host.simulation.now.tick <= newest + WINDOW + 1
            back.append(pitch.record())
            back[0].seen = newest

    pitch.idle.append(come_back)
    pitch.ticks(2 * WINDOW)
    assert back
    assert pitch.health().recorders["recorder"] <= 2


def test_a_recorder_that_talks_without_end_and_does_not_move_is_left_behind(pitch, recorder):
    recorder.stands = True
    pitch.idle.extend([recorder.pump] * 20)
    pitch.ticks(WINDOW + 20)
    assert pitch.clock.now() < 2 * PATIENCE_S


def test_at_the_end_the_recorders_get_time_for_the_last_tick(pitch_of, monkeypatch):
    pitch = pitch_of(duration=1)
    recorder = pitch.record()
    recorder.stands = True
    pitch.join_all()
    update, looks = pitch.host.attendance.update, []

    def look(timeout=0.0):
        if pitch.host.simulation.over:
            looks.append(pitch.clock.now())
            pitch.pass_time(0.1)
            recorder.stands = len(looks) < 20
            recorder.pump()
        return update(0.0)

    monkeypatch.setattr(pitch.host.attendance, "update", look)
    pitch.host.run()
    assert len(looks) == 20
    assert pitch.host.attendance.behind(pitch.host.simulation.now.tick) == {"recorder": 0}


def test_at_the_end_a_recorder_that_stands_still_is_not_waited_for_without_end(pitch_of, monkeypatch):
    pitch = pitch_of(duration=1)
    pitch.record().stands = True
    pitch.join_all()
    update = pitch.host.attendance.update

    def look(timeout=0.0):
        pitch.pass_time(timeout)
        return update(0.0)

    monkeypatch.setattr(pitch.host.attendance, "update", look)
    pitch.host.run()
    assert pitch.host.simulation.over
