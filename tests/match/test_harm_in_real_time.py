"""One match in real time whose host and whose robots stand still for a while."""

import os
import signal
import time

import pytest

from recordings.reading.recording import open_recording
from schemas.messages.command import Drive

pytestmark = [pytest.mark.processes, pytest.mark.timeout(300)]

WATCHDOG_TICKS = 10
"""0.2 s of simulated time."""
SILENCE_TICKS = 3
"""0.06 s of simulated time."""
TICK_S = 0.02
"""A control tick, s."""
PAUSE_S = 0.3
"""Wall time for which the host is stopped."""
MIND = """
from schemas.messages.command import Command, Drive

class Circles:
    def __init__(self, briefing):
        pass

    def act(self, sight):
        heard = sight.order.sequence if sight.order else None
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0, omega=1.0), acknowledges_order=heard)
"""
MATCH = """
name = "live"
duration = 80000
referee.mode = "manual"

[teams.cyan]
robots = ["cyan1", "cyan2"]
brain = "mind:Circles"

[teams.magenta]
robots = ["magenta1"]
brain = "mind:Circles"
"""
CIRCLES = Drive(vx=1.0, omega=1.0)


class Story:
    """Faults injected into the match, and the messages received."""

    def __init__(self, program, listener):
        self.program, self.heard = program, listener
        listener.until_tick(50)
        self.host_paused()
        self.stopped()
        self.killed()

    def host_paused(self):
        """As on a machine that is busy with something else: the host gets no core for a while."""
        before = self.heard.until(lambda heard: heard.healths and heard.healths[-1], "a first health report")
        host = self.program.process("host")
        os.kill(host, signal.SIGSTOP)
        time.sleep(PAUSE_S)
        os.kill(host, signal.SIGCONT)
        self.heard.until(lambda heard: heard.healths[-1].time > before.time + 1.0, "reports after the pause")

    def stopped(self):
        pid = self.program.process("cyan2")
        self.policies = {os.sched_getscheduler(one) for one in (pid, self.program.process("host"))}
        self.heard.until(lambda heard: turns(heard, "cyan2"), "cyan2 driving")
        self.before_stop = self.heard.tick
        os.kill(pid, signal.SIGSTOP)
        self.heard.until(lambda heard: not heard.robot("cyan2").answering, "cyan2 falling silent")
        self.program.wait_for_error("(silent: cyan2 ")
        self.heard.for_ticks(150)
        self.heard.until(lambda heard: len(answered(heard, "cyan1", self.before_stop)) > 100, "answers of cyan1")
        self.during_stop = self.heard.tick
        os.kill(pid, signal.SIGCONT)
        self.heard.until(lambda heard: heard.robot("cyan2").answering, "answers of cyan2")
        self.heard.until(lambda heard: turns(heard, "cyan2"), "cyan2 driving again")

    def killed(self):
        before = self.heard.robot("magenta1").answers
        os.kill(self.program.process("magenta1"), signal.SIGKILL)
        self.program.wait_for_error("magenta1 was ended by SIGKILL; started again (1 of 3)")
        self.heard.until(lambda heard: heard.robot("magenta1").answers > before + 20, "answers of the new magenta1")


def turns(heard, robot):
    """Whether a robot drives its circle."""
    return heard.worlds[-1].robots[robot].omega > 0.1


def answered(heard, robot, since):
    """Ticks after this one with an answer of the robot."""
    return [one.tick for one in heard.applied if one.tick > since and one.inputs[robot].answers_tick is not None]


def told_otherwise(inputs, arrivals):
    """Ticks in which a robot did not circle although a command was in force, or circled without one.

    Args:
        inputs: tick → the robot's input.
        arrivals: tick → the tick that the newest command answers which arrived for it, also one that was too old.
    """
    newest, arrived, pause, wrong = None, None, 0, []
    for tick, given in sorted(inputs.items()):
        if tick in arrivals:
            pause = tick - arrived - 1 if arrived is not None else 0
            newest, arrived = arrivals[tick], tick
        is_in_force = (
            newest is not None
            and tick - 1 - newest <= WATCHDOG_TICKS  # when this tick began, the newest sight was that of the one before
            and (tick == arrived or tick - arrived - pause < SILENCE_TICKS)
        )
        if given.drive != (CIRCLES if is_in_force else Drive()):
            wrong.append(tick)
    return wrong


def arrivals_of(recording, robot, inputs):
    """Tick → the tick that the newest command answers which arrived for it, as recorded.

    A command that is young and is no input was refused: its agent had not claimed its robot, or had lost it.
    """
    newest, found = -1, {}
    for recorded, command in recording.decoded(f"robot/{robot}/command"):
        tick, answers = round(recorded.time / TICK_S) + 1, command.answers_tick
        is_too_old = tick - 1 - answers > WATCHDOG_TICKS
        if answers > newest and tick in inputs and (is_too_old or inputs[tick].answers_tick is not None):
            newest = found[tick] = answers
    return found


@pytest.fixture(scope="module")
def story(start, listen, folder, endpoint):
    (folder / "mind.py").write_text(MIND)
    (folder / "match.toml").write_text(MATCH)
    words = ("match.toml", "--seed", "7", "--pace", "realtime", "--record", "m.mcap", "--json", "--listen", endpoint)
    program = start("touchline", "match", *words, folder=folder)
    story = Story(program, listen("live", endpoint, program))
    asked = start(
        "touchline", "referee", "end-game", "--connect", endpoint, "--match", "live", folder=folder, name="end"
    )
    assert asked.status() == 0, asked.err
    assert program.status() == 0, program.err
    story.heard.update()
    return story


@pytest.fixture(scope="module")
def inputs(story):
    """Tick → robot → its input."""
    return {applied.tick: applied.inputs for applied in story.heard.applied if applied.tick > 0}


def test_every_tick_is_played_whatever_happens_until_the_coach_ends_the_game(story):
    ticks = [world.tick for world in story.heard.worlds]
    assert ticks == list(range(ticks[0], ticks[-1] + 1))
    assert story.heard.logs["game/state"][-1].phase == "full_time"


def test_in_real_time_no_process_uses_batch_scheduling(story):
    assert story.policies == {os.SCHED_OTHER}


def test_the_watchdog_brakes_a_stopped_robot(inputs, story):
    quiet = [tick for tick in inputs if tick <= story.during_stop and inputs[tick]["cyan2"].answers_tick is not None]
    rest = range(quiet[-1] + WATCHDOG_TICKS + 1, story.during_stop)
    assert len(rest) > 50
    assert all(inputs[tick]["cyan2"].drive == Drive() for tick in rest)
    standing = next(world for world in story.heard.worlds if world.tick == story.during_stop).robots["cyan2"]
    assert abs(standing.vx) + abs(standing.vy) + abs(standing.omega) < 0.01


@pytest.mark.parametrize("robot", ["cyan1", "cyan2", "magenta1"])
def test_a_robot_keeps_its_last_command_until_silence_or_the_watchdog_brakes_it(story, folder, robot):
    """However late its agent answers, on a machine that is busy with other things."""
    recording = open_recording(folder / "m.mcap", whole=True)
    inputs = {one.tick: one.inputs[robot] for _, one in recording.decoded("host/applied") if one.tick > 0}
    arrivals = arrivals_of(recording, robot, inputs)
    seen = {tick: given.answers_tick for tick, given in inputs.items() if given.answers_tick is not None}
    assert len(seen) > 100
    assert {tick: answers for tick, answers in arrivals.items() if tick in seen} == seen
    assert told_otherwise(inputs, arrivals) == []


def test_the_others_play_on_meanwhile(inputs, story):
    stopped = [inputs[tick]["cyan1"] for tick in inputs if story.before_stop < tick <= story.during_stop]
    assert sum(given.drive == CIRCLES and given.answers_tick is not None for given in stopped) > 100
