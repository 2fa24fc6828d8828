"""Lockstep: what is waited for, and for how long, when messages are lost and robots are slow, silent, dead or late."""

import pytest

from schemas.command import Drive
from schemas.host import AppliedInput
from schemas.topics import APPLIED, WORLD
from sim_host.inbox import SILENT_TICKS

PATIENCE_S = 1.0
"""How long the host waits for an answer; the match file's default."""
REST = AppliedInput(drive=Drive(), dribble=False)


def answered(inputs):
    return [given.answers_tick for given in inputs]


def test_a_lost_sight_is_sent_again_and_costs_no_tick(pitch, lose):
    tried = lose(pitch.host._outbox._sights["cyan2"], {3, 7, 8})
    pitch.ticks(12)
    assert len(tried) == 12 + 3
    assert answered(pitch.inputs("cyan2")) == list(range(12))
    assert pitch.clock.now() < PATIENCE_S
    assert pitch.host.inbox.ledgers["cyan2"].missed == 0


def test_a_lost_command_is_asked_for_again_and_the_brain_is_not(pitch, lose):
    runner = pitch.agents["cyan2"].runner
    lose(runner._commands, {4, 5})
    pitch.ticks(12)
    assert answered(pitch.inputs("cyan2")) == list(range(12))
    assert (runner.answered, runner.repeated) == (12, 2)
    assert pitch.host.inbox.ledgers["cyan2"].missed == 0


def test_a_lost_message_does_not_change_the_match(pitch_of, lose):
    chains = []
    for lost in (set(), {2, 3, 9}):
        pitch = pitch_of()
        applied = pitch.hear(APPLIED)
        pitch.join_all()
        lose(pitch.host._outbox._sights["magenta1"], lost)
        pitch.begin()
        pitch.ticks(20)
        chains.append([message.chain for message in applied.all()])
    assert len(chains[0]) == 21
    assert chains[0] == chains[1]


def test_a_silent_robot_is_waited_for_a_few_ticks_and_then_no_more(pitch):
    pitch.ticks(5)
    pitch.agents["cyan2"].frozen = True
    began = pitch.clock.now()
    pitch.ticks(SILENT_TICKS)
    waited = pitch.clock.now() - began
    assert waited == pytest.approx(SILENT_TICKS * PATIENCE_S, abs=0.1)
    pitch.ticks(50)
    assert pitch.clock.now() - began - waited < PATIENCE_S
    assert pitch.host.pace.late_ticks == SILENT_TICKS


def test_a_silent_robot_rests_and_is_waited_for_when_it_answers_again(pitch):
    pitch.ticks(50)
    pitch.agents["cyan2"].frozen = True
    pitch.ticks(100)
    inputs = pitch.inputs("cyan2")
    assert answered(inputs[:50]) == list(range(50))
    assert all(given.drive == Drive(vx=1.0) for given in inputs[:60])
    assert inputs[60:] == [REST] * 90
    assert abs(pitch.truth("cyan2")["vx"]) < 1e-3
    assert pitch.truth("cyan1")["vx"] > 0.5
    health = pitch.health().robots["cyan2"]
    assert (health.alive, health.answering, health.missed) == (True, False, 101)
    assert pitch.silences() == ["cyan2 does not answer, its robot rests"]

    pitch.agents["cyan2"].frozen = False
    pitch.inputs("cyan2")
    pitch.ticks(20)
    assert None not in answered(pitch.inputs("cyan2")[2:])
    assert pitch.health().robots["cyan2"].answering
    assert pitch.silences() == ["cyan2 answers"]


def test_a_robot_that_always_answers_too_late_does_not_hold_the_match_at_every_tick(pitch):
    pitch.agents["cyan2"].thinks_s = 1.2 * PATIENCE_S
    pitch.ticks(400)
    assert pitch.clock.now() < 100 * PATIENCE_S
    health = pitch.health().robots
    assert not health["cyan2"].answering
    assert health["cyan1"].missed == 0
    assert pitch.silences() == ["cyan2 does not answer, its robot rests"]


def test_a_robot_that_needs_long_but_not_too_long_is_waited_for(pitch):
    pitch.agents["cyan2"].thinks_s = 0.7 * PATIENCE_S
    pitch.ticks(6)
    assert pitch.host.inbox.ledgers["cyan2"].missed == 0
    assert answered(pitch.inputs("cyan2")) == list(range(6))


def test_an_agent_that_dies_is_not_waited_for_and_its_successor_joins(pitch):
    pitch.ticks(5)
    pitch.leave("cyan2")
    began = pitch.clock.now()
    pitch.ticks(30)
    assert pitch.clock.now() - began < PATIENCE_S
    assert not pitch.health().robots["cyan2"].alive
    pitch.join("cyan2")
    pitch.ticks(10)
    ticks = answered(pitch.inputs("cyan2"))
    assert ticks[:5] == [0, 1, 2, 3, 4]
    assert ticks[5:36] == [None] * 31
    assert ticks[-9:] == list(range(37, 46))
    assert pitch.silences() == ["cyan2 does not answer, its robot rests", "cyan2 answers"]


def test_an_agent_that_comes_late_joins(pitch_of):
    pitch = pitch_of(patience={"attendance": 0})
    for robot in ("cyan1", "magenta1"):
        pitch.join(robot)
    pitch.begin()
    pitch.ticks(10)
    pitch.join("cyan2")
    pitch.ticks(10)
    ticks = answered(pitch.inputs("cyan2"))
    assert ticks[:10] == [None] * 10
    assert ticks[-9:] == list(range(11, 20))
    assert pitch.clock.now() < PATIENCE_S


def test_an_agent_that_comes_while_the_host_waits_for_another_is_in_time_for_this_tick(pitch):
    pitch.leave("cyan2")
    pitch.agents["cyan1"].thinks_s = 0.03

    def come() -> None:
        if "cyan2" not in pitch.agents and pitch.clock.now() > 0.01:
            pitch.join("cyan2")

    pitch.idle.append(come)
    pitch.ticks(1)
    assert answered(pitch.inputs("cyan2")) == [0]
    assert pitch.clock.now() == pytest.approx(0.03, abs=0.01)


def test_the_first_tick_waits_for_everybody_and_for_a_recorder_where_one_is_wanted(pitch_of):
    pitch = pitch_of(record={"wait": True})
    pitch.join_all()
    attendance = pitch.host.attendance
    attendance.update()
    assert attendance.all_here(wait_for_recorder=False)
    assert not attendance.all_here(wait_for_recorder=True)
    pitch.outside.declare_alive("recorder", "recorder")
    pitch.host.wait_for_all()
    assert attendance.all_here(wait_for_recorder=True)
    assert pitch.clock.now() == 0.0


def test_a_host_that_is_told_to_leave_waits_for_nobody_and_ends_its_tick(pitch):
    worlds, applied = pitch.hear(WORLD), pitch.hear(APPLIED)
    pitch.ticks(5)
    pitch.agents["cyan2"].frozen = True
    pitch.host.leave()
    began = pitch.clock.now()
    pitch.ticks(1)
    assert pitch.clock.now() - began < PATIENCE_S
    last = applied.all()[-1]
    assert worlds.all()[-1].tick == last.tick == 6
    assert last.inputs["cyan2"].answers_tick is None
