"""One lockstep match whose agent is killed and whose recorder stands still, ended by Ctrl-C: what it leaves."""

import os
import signal
import time

import pytest

from recordings.container.manifest import EndReason
from recordings.reading.recording import open_recording
from support.process_story import MessageLog

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

MIND = """
from schemas.messages.command import Command, Drive

class Circles:
    def __init__(self, briefing):
        pass

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0, omega=1.0))
"""
MATCH = """
name = "harmed"
duration = 80000

[teams.cyan]
robots = ["cyan1", "cyan2"]
brain = "mind:Circles"

[teams.magenta]
robots = ["magenta1"]
brain = "mind:Circles"
"""


class Story:
    """Faults injected into the match, and the messages received; ticks are those of the host's messages."""

    def __init__(self, program, listener):
        self.program, self.heard = program, listener
        listener.until_tick(50)
        self.killed()
        self.recorder_stops()
        self.interrupted()

    def killed(self):
        self.heard.update()
        before = self.heard.robot("cyan2").answers
        os.kill(self.program.process("cyan2"), signal.SIGKILL)
        self.heard.until(lambda heard: heard.silences("cyan2"), "cyan2 falling silent")
        self.program.wait_for_error("cyan2 was ended by SIGKILL; started again (1 of 3)")
        self.heard.until(
            lambda heard: heard.robot("cyan2").answering and heard.robot("cyan2").answers > before + 100,
            "answers of the new cyan2",
        )

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


def test_a_killed_agent_is_reported_and_its_successor_plays(recording, inputs, worlds, story):
    assert "cyan2 was ended by SIGKILL; started again (1 of 3)" in story.program.err
    fell, back = silences(recording, "cyan2")
    answering = {tick for tick, given in inputs.items() if given["cyan2"].answers_tick is not None}
    assert set(range(1, fell)) <= answering
    assert set(range(back + 1, worlds[-1].tick)) <= answering


def test_no_other_robot_missed_a_tick_meanwhile(story):
    assert story.heard.robot("cyan1").missed == 0


def test_a_recorder_that_stood_still_for_a_moment_has_lost_nothing(recording):
    assert {key: count.lost for key, count in recording.result.keys.items() if count.lost} == {}
