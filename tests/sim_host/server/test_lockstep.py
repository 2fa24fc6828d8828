"""Lockstep: what is waited for, and for how long, when messages are lost and robots are slow, silent, dead or late."""

import pytest

from schemas.messages.applied import AppliedInput
from schemas.messages.command import Command, Drive
from schemas.messages.scene import SceneOperation, SceneRequest
from schemas.topics import APPLIED, COMMAND, SCENE, WORLD
from sim_host.server.admission.agent_stats import SILENT_TICKS
from support.host_rig import TEAMS

PATIENCE_S = 10.0
"""How long the host waits for an answer; the match file's default."""
REST = AppliedInput(drive=Drive(), dribble=False)
HELD_TICKS = 2
"""Ticks without a new command in which the last one is in force: in the third one, after 0.06 s, the robot brakes."""


def answered(inputs):
    return [given.answers_tick for given in inputs]


def test_a_lost_sight_is_sent_again_and_costs_no_tick(rig):
    losses = rig.medium.lose("robot/cyan2/sight", {3, 7, 8})
    rig.ticks(12)
    assert len(losses.sent) == 12 + 3
    assert answered(rig.inputs("cyan2")) == list(range(12))
    assert rig.clock.now() < PATIENCE_S
    assert rig.host.inbox.agent_stats["cyan2"].missed == 0


def test_a_lost_command_is_asked_for_again_and_the_brain_is_not(rig):
    runner = rig.agents["cyan2"].runner
    rig.medium.lose("robot/cyan2/command", {4, 5})
    rig.ticks(12)
    assert answered(rig.inputs("cyan2")) == list(range(12))
    assert (runner.answered, runner.repeated) == (12, 2)
    assert rig.host.inbox.agent_stats["cyan2"].missed == 0


def test_a_lost_message_does_not_change_the_match(rig_of):
    chains = []
    for lost in (set(), {2, 3, 9}):
        rig = rig_of()
        applied = rig.listen(APPLIED)
        rig.join_all()
        rig.medium.lose("robot/magenta1/sight", lost)
        rig.begin()
        rig.ticks(20)
        chains.append([message.chain for message in applied.all()])
    assert len(chains[0]) == 21
    assert chains[0] == chains[1]


def test_a_silent_robot_is_waited_for_a_few_ticks_and_then_no_more(rig):
    rig.ticks(5)
    rig.agents["cyan2"].frozen = True
    began = rig.clock.now()
    rig.ticks(SILENT_TICKS)
    waited = rig.clock.now() - began
    assert waited == pytest.approx(SILENT_TICKS * PATIENCE_S, abs=0.1)
    rig.ticks(50)
    assert rig.clock.now() - began - waited < PATIENCE_S
    assert rig.host.pace.late_ticks == SILENT_TICKS


def test_a_silent_robot_rests_and_is_waited_for_when_it_answers_again(rig):
    rig.ticks(50)
    rig.agents["cyan2"].frozen = True
    rig.ticks(100)
    inputs = rig.inputs("cyan2")
    assert answered(inputs[:50]) == list(range(50))
    assert all(given.drive == Drive(vx=1.0) for given in inputs[: 50 + HELD_TICKS])
    assert inputs[50 + HELD_TICKS :] == [REST] * (100 - HELD_TICKS)
    assert abs(rig.truth("cyan2")["vx"]) < 1e-3
    assert rig.truth("cyan1")["vx"] > 0.5
    health = rig.health().robots["cyan2"]
    assert (health.alive, health.answering, health.missed) == (True, False, 101)
    assert rig.silences() == ["cyan2 does not answer, its robot stops"]

    rig.agents["cyan2"].frozen = False
    rig.inputs("cyan2")
    rig.ticks(20)
    assert None not in answered(rig.inputs("cyan2")[2:])
    assert rig.health().robots["cyan2"].answering
    assert rig.silences() == ["cyan2 answers"]


def test_time_without_a_processor_is_not_waited_for_an_answer(rig):
    rig.agents["cyan2"].thinks_s = 6 * PATIENCE_S
    rig.idle.append(lambda: rig.pass_time(5.0))  # the host is not scheduled for 5 s at a time, nor is the robot
    rig.ticks(3)
    assert rig.clock.now() > 18 * PATIENCE_S
    assert rig.host.inbox.agent_stats["cyan2"].missed == 0
    assert rig.host.pace.late_ticks == 0


def test_a_robot_that_always_answers_too_late_does_not_hold_the_match_at_every_tick(rig):
    rig.agents["cyan2"].thinks_s = 1.2 * PATIENCE_S
    rig.ticks(400)
    assert rig.clock.now() < 100 * PATIENCE_S
    health = rig.health().robots
    assert not health["cyan2"].answering
    assert health["cyan1"].missed == 0
    assert rig.silences() == ["cyan2 does not answer, its robot stops"]


class Answers:
    """Answers another tick than that of the sight."""

    def __init__(self, other):
        self.other = other

    def act(self, sight):
        return Command(answers_tick=self.other(sight.tick), drive=Drive(vx=1.0))


@pytest.mark.parametrize(
    ("other", "answered_tick"),
    [(lambda tick: 0, 0), (lambda tick: max(tick - 1, 0), 400)],
    ids=["a constant tick", "the tick before"],
)
def test_a_robot_that_answers_an_earlier_tick_does_not_hold_the_match_and_is_reported(rig_of, other, answered_tick):
    rig = rig_of()
    rig.join("cyan1"), rig.join("cyan2", Answers(other)), rig.join("magenta1")
    rig.begin()
    rig.ticks(401)
    assert rig.clock.now() < 60 * PATIENCE_S
    health = rig.health().robots
    assert health["cyan2"].fault == f"answers tick {answered_tick}, the match is at 402; use sight.tick"
    assert health["cyan1"].fault == ""


def test_a_robot_whose_commands_are_invalid_is_reported_with_the_reason(rig):
    rig.ticks(5)
    rig.agents["cyan2"].frozen = True
    writer = rig.outside.publisher(COMMAND, robot="cyan2")
    for _ in range(10):
        writer.put_payload(b'{"answers_tick":5,"drive":{"vx":NaN}}')
        rig.ticks(1)
    reason = "Command: drive.vx is nan; m/s from -20 to 20"
    assert rig.silences() == [f"cyan2 does not answer, its robot stops: {reason}"]
    assert rig.health().robots["cyan2"].fault == reason
    rig.agents["cyan2"].frozen = False
    rig.ticks(5)
    assert rig.health().robots["cyan2"].fault == ""


def test_a_robot_that_needs_long_but_not_too_long_is_waited_for(rig):
    rig.agents["cyan2"].thinks_s = 0.7 * PATIENCE_S
    rig.ticks(6)
    assert rig.host.inbox.agent_stats["cyan2"].missed == 0
    assert answered(rig.inputs("cyan2")) == list(range(6))


def test_an_agent_that_dies_is_not_waited_for_and_its_successor_joins(rig):
    rig.ticks(5)
    rig.leave("cyan2")
    began = rig.clock.now()
    rig.ticks(30)
    assert rig.clock.now() - began < PATIENCE_S
    assert not rig.health().robots["cyan2"].alive
    rig.join("cyan2")
    rig.ticks(10)
    ticks = answered(rig.inputs("cyan2"))
    assert ticks[:5] == [0, 1, 2, 3, 4]
    assert ticks[5:36] == [None] * 31
    assert ticks[-9:] == list(range(37, 46))
    assert rig.silences() == ["cyan2 does not answer, its robot stops", "cyan2 answers"]


def test_an_agent_that_comes_while_the_host_waits_for_another_is_in_time_for_this_tick(rig):
    rig.leave("cyan2")
    rig.agents["cyan1"].thinks_s = 0.03

    def come() -> None:
        if "cyan2" not in rig.agents and rig.clock.now() > 0.01:
            rig.join("cyan2")

    rig.idle.append(come)
    rig.ticks(1)
    assert answered(rig.inputs("cyan2")) == [0]
    assert rig.clock.now() == pytest.approx(0.03, abs=0.01)


def test_the_first_tick_waits_for_everybody_and_for_a_recorder_where_one_is_wanted(rig_of):
    rig = rig_of(record={"wait": True})
    rig.join_all()
    presence = rig.host.presence
    presence.update()
    assert presence.all_present(wait_for_recorder=False)
    assert not presence.all_present(wait_for_recorder=True)
    rig.outside.declare_alive("recorder", "recorder")
    rig.host.wait_for_all()
    assert presence.all_present(wait_for_recorder=True)
    assert rig.clock.now() == 0.0


@pytest.mark.parametrize("there, begins_at", [((), 2.0), (("magenta1",), 0.5)], ids=["nobody", "one of two"])
def test_a_remote_side_is_waited_for_until_one_of_its_robots_is_there(rig_of, monkeypatch, there, begins_at):
    teams = {"cyan": TEAMS["cyan"], "magenta": {"name": "Magenta", "size": 2, "remote": True}}
    rig = rig_of(teams=teams, patience={"remote": 0.5})
    for robot in ("cyan1", "cyan2", *there):
        rig.join(robot)
    look = rig.host.presence.update

    def update(timeout: float = 0.0) -> None:
        look()
        rig.pass_time(0.1)
        if rig.clock.now() > 1.95 and "magenta1" not in rig.agents:
            rig.join("magenta1")

    monkeypatch.setattr(rig.host.presence, "update", update)
    rig.host.wait_for_all()
    assert rig.clock.now() == pytest.approx(begins_at, abs=0.15)


def test_a_remote_side_whose_robots_an_operator_has_removed_is_waited_for_no_longer(rig_of, monkeypatch):
    rig = rig_of(teams={**TEAMS, "magenta": {**TEAMS["magenta"], "remote": True}}, patience={"remote": 0.5})
    rig.join("cyan1")  # cyan2 is missing, too: the wait does not end with its roster
    rig.outside.query(SCENE, SceneRequest(operation=SceneOperation.REMOVE, remove=["magenta1"]))
    look = rig.host.presence.update

    def update(timeout: float = 0.0) -> None:
        look()
        rig.pass_time(0.1)
        assert rig.clock.now() < 2.0

    monkeypatch.setattr(rig.host.presence, "update", update)
    rig.host.wait_for_all()
    assert "magenta1" not in rig.host.simulation.roster.names


def test_a_stopped_host_waits_for_no_robot_and_ends_its_tick(rig):
    worlds, applied = rig.listen(WORLD), rig.listen(APPLIED)
    rig.ticks(5)
    rig.agents["cyan2"].frozen = True
    rig.host.stop()
    began = rig.clock.now()
    rig.ticks(1)
    assert rig.clock.now() - began < PATIENCE_S
    last = applied.all()[-1]
    assert worlds.all()[-1].tick == last.tick == 6
    assert last.inputs["cyan2"].answers_tick is None
