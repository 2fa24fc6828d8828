"""How far a lockstep host runs ahead of its recorders."""

import pytest

from schemas.config.match_config import MatchConfig
from schemas.messages.record_batch import RecordBatch, RecordBatchesReply, RecordBatchesRequest
from schemas.messages.recorder import RecorderProgress
from schemas.messages.soccer.game import RefereeAction
from schemas.recovery_window import RUN_AHEAD_TICKS
from schemas.soccer.game import ActionName
from schemas.topics import ACTION, RECORD_BATCH, RECORD_BATCHES, RECORDER_PROGRESS
from sim_host.server.admission.admitted_recorders import MOST_UNNAMED
from support.host_rig import TEAMS, HostRig

PATIENCE_S = 6.0
"""How long the host waits for a recorder that stands still."""


@pytest.fixture
def rig(rig_of):
    rig = rig_of(patience={"recorder": PATIENCE_S})
    rig.join_all()
    rig.begin()
    return rig


@pytest.fixture
def recorder(rig):
    return rig.record()


def test_a_recorder_that_stands_still_holds_the_host_once_and_is_then_left_behind(rig, recorder):
    rig.ticks(10)
    recorder.stands = True
    rig.ticks(RUN_AHEAD_TICKS)
    assert rig.clock.now() < PATIENCE_S
    rig.ticks(50)
    assert PATIENCE_S < rig.clock.now() < 2 * PATIENCE_S
    assert rig.health().recorders["recorder"] == pytest.approx(RUN_AHEAD_TICKS + 50, abs=2)


def test_a_recorder_that_was_left_behind_is_waited_for_again_when_it_moves(rig, recorder):
    recorder.stands = True
    rig.ticks(RUN_AHEAD_TICKS + 20)
    recorder.stands = False
    rig.ticks(1)
    assert rig.health().recorders["recorder"] <= 2
    recorder.stands = True
    before = rig.clock.now()
    rig.ticks(RUN_AHEAD_TICKS + 20)
    assert rig.clock.now() - before > PATIENCE_S


def test_a_recorder_that_is_slow_is_waited_for_as_long_as_it_moves(rig, recorder):
    recorder.stands = True

    def take_one_in_half_a_second():
        if rig.clock.now() >= 0.5 * (recorder.seen + 2) and (received := recorder.worlds.receive()) is not None:
            recorder.seen = received.message().tick

    rig.idle.append(take_one_in_half_a_second)
    rig.ticks(RUN_AHEAD_TICKS + 20)
    assert rig.host.simulation.now.tick - recorder.seen <= RUN_AHEAD_TICKS + 1
    assert rig.clock.now() >= 0.5 * 19


def test_a_dead_recorder_stops_the_match_no_longer_than_one_that_stands_still(rig, recorder):
    rig.ticks(5)
    recorder.stands = True
    rig.ticks(RUN_AHEAD_TICKS - 20)
    rig.idle.remove(recorder.pump)
    recorder.bus.close()
    rig.ticks(60)
    assert PATIENCE_S < rig.clock.now() < PATIENCE_S + 1.0
    assert rig.health().recorders == {}


def test_the_host_does_not_wait_for_a_recorder_that_reports_that_it_leaves(rig, recorder):
    recorder.stands = True
    rig.ticks(RUN_AHEAD_TICKS - 2)
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
            assert rig.host.simulation.now.tick <= newest + RUN_AHEAD_TICKS + 1
            back.append(rig.record())
            back[0].seen = newest

    rig.idle.append(come_back)
    rig.ticks(2 * RUN_AHEAD_TICKS)
    assert back
    assert rig.health().recorders["recorder"] <= 2


def test_a_recorder_that_talks_without_end_and_does_not_move_is_left_behind(rig, recorder):
    recorder.stands = True
    rig.idle.extend([recorder.report] * 20)
    rig.ticks(RUN_AHEAD_TICKS + 20)
    assert rig.clock.now() < 2 * PATIENCE_S


def ending(rig):
    """The same rig with a match that ends in its first tick."""
    rig.join_all()
    rig.outside.query(ACTION, RefereeAction(action=ActionName.END_GAME))
    return rig


def test_at_the_end_the_recorders_get_their_patience_for_the_last_tick(rig_of, monkeypatch):
    """They got 5 s, in which a recorder on a busy machine lost the last batches."""
    rig = ending(rig_of(patience={"recorder": PATIENCE_S}))
    recorder = rig.record()
    recorder.stands = True
    update, looks = rig.host.presence.update, []

    def look(timeout=0.0):
        if rig.host.simulation.over:
            looks.append(rig.clock.now())
            rig.pass_time(PATIENCE_S / 21)
            recorder.stands = len(looks) < 20
            recorder.pump()
        return update(0.0)

    monkeypatch.setattr(rig.host.presence, "update", look)
    rig.host.run()
    assert len(looks) == 20
    assert rig.host.presence.recorder_lags(rig.host.simulation.now.tick) == {"recorder": 0}


def test_a_host_that_waits_for_a_recorder_gives_it_the_batches_that_it_missed(rig, recorder):
    """Otherwise each would wait for the other."""
    recorder.stands = True
    answers = []

    def ask_and_go_on():
        if rig.host.simulation.now.tick - recorder.seen > RUN_AHEAD_TICKS and not answers:
            answers.append(recorder.bus.query(RECORD_BATCHES, RecordBatchesRequest(first=0, last=1)))
        elif answers and recorder.stands:
            assert len(RecordBatchesReply.decode(answers[0].payload(0.0)).batches) == 2
            recorder.stands = False

    rig.idle.append(ask_and_go_on)
    rig.ticks(RUN_AHEAD_TICKS + 20)
    assert not recorder.stands
    assert rig.clock.now() < PATIENCE_S


def test_at_the_end_missing_batches_are_given_still(rig_of, monkeypatch):
    rig = ending(rig_of())
    rig.record().stands = True
    update, answers = rig.host.presence.update, []

    def look(timeout=0.0):
        rig.pass_time(timeout)
        if rig.host.simulation.over and not answers:
            answers.append(rig.outside.query(RECORD_BATCHES, RecordBatchesRequest(first=0)))
        return update(0.0)

    monkeypatch.setattr(rig.host.presence, "update", look)
    rig.host.run()
    assert RecordBatchesReply.decode(answers[0].payload(0.0)).batches


def sights_in(rig, listener) -> list[str]:
    """Keys of the sights in the batches since this was last called."""
    rig.host._batches.send()
    batches = [RecordBatch.decode(received.payload) for received in iter(listener.receive, None)]
    return [entry.key for batch in batches for entry in batch.entries if entry.key.endswith("/sight")]


def test_sights_are_in_the_batches_while_a_recorder_records_them(rig):
    batches = rig.outside.subscribe(RECORD_BATCH)
    rig.ticks(5)
    assert sights_in(rig, batches) == []
    recorder = rig.record()
    progress = recorder.bus.publisher(RECORDER_PROGRESS, name="recorder")
    rig.ticks(1)
    progress.put(RecorderProgress(tick=5, messages=0, lost=0, sights=True))
    rig.ticks(1)
    sights_in(rig, batches)
    rig.ticks(10)
    assert sights_in(rig, batches) == ["robot/cyan1/sight", "robot/cyan2/sight", "robot/magenta1/sight"] * 10
    recorder.leave()
    rig.idle.clear()
    rig.ticks(1)
    sights_in(rig, batches)
    rig.ticks(5)
    assert sights_in(rig, batches) == []


def test_if_the_match_file_demands_it_sights_are_in_the_batches_from_tick_0(rig_of):
    rig = rig_of(record={"sights": True})
    batches = rig.outside.subscribe(RECORD_BATCH)
    rig.join_all()
    rig.begin()
    rig.ticks(1)
    assert sights_in(rig, batches) == ["robot/cyan1/sight", "robot/cyan2/sight", "robot/magenta1/sight"] * 2


def test_with_credentials_the_host_waits_for_the_first_few_recorders_that_nobody_named_and_for_named_ones():
    match = {"seed": 7, "teams": TEAMS, "record": {"admit": ["tape"]}, "patience": {"recorder": PATIENCE_S}}
    config = MatchConfig.model_validate(match)
    rig = HostRig(config, settings={"has_accounts": True})
    rig.join_all()
    rig.begin()
    for name in [*(f"ghost{number}" for number in range(200)), "tape"]:
        rig.outside.declare_alive("recorder", name)
    began = rig.clock.now()
    rig.ticks(RUN_AHEAD_TICKS + 50)
    assert rig.clock.now() - began < (MOST_UNNAMED + 2) * PATIENCE_S
    recorders = rig.health().recorders
    assert "tape" in recorders
    assert len(recorders) < 30
    (text,) = [text for text in rig.silences() if text.startswith("the host does not wait for ")]
    assert text.startswith("the host does not wait for ghost4 and later recorders: ghost0, ghost1, ghost2, ghost3 have")
    rig.host.simulation.close()
