"""One lockstep match in which much goes wrong, ended by Ctrl-C: what it must survive, show, and leave."""

import os
import signal
import time

import pytest

from recordings.container.manifest import EndReason
from recordings.reading.recording import open_recording
from runtime.access.accounts import Account
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock
from schemas.messages.command import Command, Drive
from schemas.topics import key_prefix
from schemas.wire.message import BadMessageError
from sim_host.server.admission.agent_stats import SILENT_TICKS
from support.process_story import MessageLog

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

CRASH_TICK = 200
WATCHDOG_TICKS = 10
"""0.2 s of simulated time."""
MIND = f"""
from schemas.messages.command import Command, Drive

class Circles:
    def __init__(self, briefing):
        self.robot = briefing.robot

    def act(self, sight):
        if self.robot == "cyan2" and sight.tick >= {CRASH_TICK}:
            return Command(answers_tick=sight.tick, drive=Drive(vx=1.0 / 0.0))
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0, omega=1.0))
"""
MATCH = """
name = "harmed"
duration = 80000

[teams.cyan]
robots = ["cyan1", "cyan2", "cyan3"]
brain = "mind:Circles"

[teams.magenta]
robots = ["magenta1"]
brain = "mind:Circles"
"""
RUBBISH = {
    "NaN": b'{"answers_tick":1,"drive":{"vx":NaN}}',
    "an absurd speed": b'{"answers_tick":1,"drive":{"vx":1e9}}',
    "a truncated payload": Command(answers_tick=1).encode()[:-7],
    "not JSON": b"drive ahead!",
    "fourteen thousand bytes": b"\x00" * 14_000,
    "an answer to a tick to come": Command(answers_tick=10**9).encode(),
}
"""Sent on the key of cyan1, whose own agent goes on all the while."""


class Story:
    """Faults injected into the match, and the messages received; ticks are those of the host's messages."""

    def __init__(self, program, listener):
        self.program, self.heard = program, listener
        listener.until_tick(50)
        self.bad_messages()
        self.crashes()
        self.killed()
        self.stopped()
        self.recorder_stops()
        self.interrupted()

    def bad_messages(self):
        prefix = key_prefix("harmed")
        with open_client("harmed", WallClock(), self.heard.bus.endpoint, account=Account.CYAN) as team:
            for number, payload in enumerate(RUBBISH.values(), 1):
                team.session.put(f"{prefix}robot/cyan1/command", payload)  # one by one: the host limits the rate
                self.heard.until(lambda heard, sent=number: heard.robot("cyan1").invalid >= sent, "a count of each")
            team.session.put(f"{prefix}robot/cyan7/command", Command(answers_tick=1).encode())
        self.heard.until(lambda heard: heard.healths[-1].strangers, "a count of strangers")
        self.heard.until(lambda heard: len(heard.invalid) == len(RUBBISH) + 1, "word of each invalid message")
        self.at_bad_messages = self.heard.tick

    def crashes(self):
        self.program.wait_for_error("cyan2 failed at its first sight; not started again")
        self.program.wait_for_error("silent: cyan2")

    def killed(self):
        self.heard.update()
        before = self.heard.robot("cyan3").answers
        os.kill(self.program.process("cyan3"), signal.SIGKILL)
        self.heard.until(lambda heard: heard.silences("cyan3"), "cyan3 falling silent")
        self.program.wait_for_error("cyan3 was ended by SIGKILL; started again (1 of 3)")
        self.heard.until(
            lambda heard: heard.robot("cyan3").answering and heard.robot("cyan3").answers > before + 100,
            "answers of the new cyan3",
        )

    def stopped(self):
        pid = self.program.process("magenta1")
        os.kill(pid, signal.SIGSTOP)
        self.heard.until(lambda heard: not heard.robot("magenta1").answering, "magenta1 falling silent")
        self.heard.for_ticks(300)
        self.during_stop = self.heard.tick
        os.kill(pid, signal.SIGCONT)
        self.heard.until(lambda heard: heard.robot("magenta1").answering, "answers of magenta1")
        self.heard.for_ticks(50)

    def recorder_stops(self):
        pid = self.program.process("recorder")
        os.kill(pid, signal.SIGSTOP)
        self.heard.for_ticks(100)
        os.kill(pid, signal.SIGCONT)
        self.heard.for_ticks(300)

    def interrupted(self):
        self.processes = list(self.program.processes().values())
        self.policies = {os.sched_getscheduler(pid) for pid in self.processes}
        self.heard.update()
        self.last_tick = self.heard.tick
        began = time.monotonic()
        self.program.popen.send_signal(signal.SIGINT)
        self.exit_status = self.program.status()
        self.took = time.monotonic() - began


@pytest.fixture(scope="module")
def story(start, listen, folder, endpoint):
    (folder / "mind.py").write_text(MIND)
    (folder / "match.toml").write_text(MATCH)
    words = ("match.toml", "--seed", "7", "--pace", "lockstep", "--record", "m.mcap", "--json", "--listen", endpoint)
    program = start("touchline", "match", *words, folder=folder)
    return Story(program, listen("harmed", endpoint, program, every_tick=False))


@pytest.fixture(scope="module")
def recording(story, folder):
    return open_recording(folder / "m.mcap", whole=True)


@pytest.fixture(scope="module")
def inputs(recording):
    """Tick → robot → its input."""
    return {applied.tick: applied.inputs for _, applied in recording.decoded("host/applied") if applied.tick > 0}


@pytest.fixture(scope="module")
def worlds(recording):
    return MessageLog(recording.messages("world"))


def silences(recording, robot):
    """Ticks at which a robot was reported silent and answering, in turn."""
    events = [event for _, event in recording.decoded("game/event") if event.kind == "agent" and event.robot == robot]
    assert [("does not" in event.text) for event in events] == [place % 2 == 0 for place in range(len(events))]
    return [event.tick for event in events]


def test_the_match_goes_on_with_every_tick_whatever_happens(worlds, story):
    ticks = [world.tick for world in worlds]
    assert ticks == list(range(len(ticks)))
    assert ticks[-1] >= story.last_tick


def test_in_lockstep_all_processes_use_batch_scheduling(story):
    assert story.policies == {os.SCHED_BATCH}


def test_ctrl_c_ends_all_processes_soon_with_status_130(story, is_running):
    assert story.exit_status == 128 + signal.SIGINT
    assert story.took < 25.0  # not the half minute that a recorder has after a match; a busy machine took 6.5 s
    assert story.program.out == ""
    assert len(story.processes) == 5  # host, recorder, three agents
    assert [pid for pid in story.processes if is_running(pid)] == []


def test_ctrl_c_leaves_a_finished_recording_and_prints_its_path(recording, story, folder):
    assert recording.complete
    assert recording.result.ended in (EndReason.HOST_GONE, EndReason.STOPPED)
    assert "touchline: match interrupted; see m.mcap" in story.program.err


def test_bad_messages_are_recorded_raw_on_their_keys(recording):
    raw = [message.payload for message in recording.messages("robot/cyan1/command")]
    assert [case for case, payload in RUBBISH.items() if payload not in raw] == []
    assert [message.payload for message in recording.messages("robot/cyan7/command")] == [
        Command(answers_tick=1).encode()
    ]


def test_bad_messages_are_recorded_with_the_reason(recording):
    told = [invalid for _, invalid in recording.decoded("host/invalid")]
    assert {invalid.key for invalid in told} == {"robot/cyan1/command", "robot/cyan7/command"}
    reasons = [invalid.reason for invalid in told]
    for payload in list(RUBBISH.values())[:-1]:
        with pytest.raises(BadMessageError) as refused:
            Command.decode(payload)
        assert str(refused.value) in reasons
    assert any("answers_tick is 1000000000, the newest sight is" in reason for reason in reasons)
    assert "no robot of this match has that name" in reasons


def test_bad_messages_are_counted_and_ignored(story, inputs):
    last = story.heard.healths[-1]
    assert {name: robot.invalid for name, robot in last.robots.items()} == {
        "cyan1": len(RUBBISH),
        "cyan2": 0,
        "cyan3": 0,
        "magenta1": 0,
    }
    assert last.strangers == {"robot/cyan7/command": 1}
    answers = [inputs[tick]["cyan1"].answers_tick for tick in range(1, story.at_bad_messages)]
    assert answers == list(range(story.at_bad_messages - 1))


def test_a_crashing_agent_is_started_again_three_times_and_reported_with_its_error(story):
    lines = story.program.err.splitlines()
    first, counted = [line for line in lines if "ZeroDivisionError: float division by zero" in line]
    assert first.startswith("cyan2 ended with status 1; started again (1 of 3): act raised at tick ")
    assert "mind.py, line " in first and first.endswith("; cyan2.log has the traceback")
    assert counted.startswith("4 times (cyan2 4): act raised (")


def test_the_robot_of_a_crashed_agent_rests_from_then_on(inputs, worlds, story):
    assert inputs[CRASH_TICK]["cyan2"].drive == Drive(vx=1.0, omega=1.0)
    later = range(CRASH_TICK + WATCHDOG_TICKS + 1, len(worlds))
    assert len(later) > 100
    assert all(inputs[tick]["cyan2"].drive == Drive() for tick in later)
    last = story.heard.healths[-1]
    assert last.robots["cyan2"].missed >= last.tick - CRASH_TICK - 1
    end = worlds[story.during_stop].robots["cyan2"]
    assert abs(end.vx) + abs(end.vy) + abs(end.omega) < 0.01


def test_a_robot_that_does_not_answer_is_shown_in_the_status_line(story):
    assert any("silent: cyan2" in line and "robots 3/4" in line for line in story.program.err.splitlines())


def test_a_killed_agent_is_reported_and_its_successor_plays(recording, inputs, worlds, story):
    assert "cyan3 was ended by SIGKILL; started again (1 of 3)" in story.program.err
    fell, back = silences(recording, "cyan3")
    answering = {tick for tick, given in inputs.items() if given["cyan3"].answers_tick is not None}
    assert set(range(1, fell)) <= answering
    assert set(range(back + 1, worlds[-1].tick)) <= answering


def test_a_stopped_agent_is_waited_for_a_few_ticks_and_then_rests_until_it_answers_again(
    recording, inputs, worlds, story
):
    fell, back = silences(recording, "magenta1")
    assert fell < story.during_stop < back
    unanswered = [tick for tick in range(1, back) if inputs[tick]["magenta1"].answers_tick is None]
    assert unanswered == list(range(unanswered[0], back))
    assert fell - unanswered[0] < SILENT_TICKS
    assert all(inputs[tick]["magenta1"].drive == Drive() for tick in unanswered[WATCHDOG_TICKS:])
    truth = worlds[story.during_stop].robots["magenta1"]
    assert abs(truth.vx) + abs(truth.vy) + abs(truth.omega) < 0.01
    moving = worlds[-1].robots["magenta1"]
    assert abs(moving.omega) > 0.1


def test_no_other_robot_missed_a_tick_meanwhile(story):
    assert story.heard.robot("cyan1").missed == 0


def test_a_recorder_that_stood_still_for_a_moment_has_lost_nothing(recording):
    lost = {key: count.lost for key, count in recording.result.keys.items() if count.lost}
    lost.pop("robot/magenta1/command", None)  # its agent's first message after its stop may be lost with the old link
    assert lost == {}
