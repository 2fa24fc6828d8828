"""A brain that does not return is named with its line, and goes on."""

import signal
import time

import pytest

from robot_agent.process import brain_runner
from robot_agent.process.brain_runner import BrainRunner
from runtime.process.process_log import NOTE
from schemas.messages.command import Command
from schemas.topics import COMMAND, SIGHT
from support.answers import answer_next
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock


class Slow:
    """Takes 60 ms."""

    def act(self, sight):
        ends = time.monotonic() + 0.06
        while time.monotonic() < ends:
            pass
        return Command(answers_tick=sight.tick)


@pytest.fixture
def answered(sight_of, monkeypatch, capfd):
    """Whether a slow brain's answer arrives, where 20 ms are long; what is printed is captured."""
    monkeypatch.setattr(brain_runner, "HANG_S", 0.02)
    medium = SharedState()
    host, robot = medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock())
    commands = host.subscribe(COMMAND)
    runner = BrainRunner(robot, Slow(), "cyan2")
    host.publisher(SIGHT, robot="cyan2").put(sight_of(4))
    answer_next(runner)
    return commands.receive() is not None


@pytest.mark.usefixtures("free_alarm")
def test_the_log_has_the_stack_of_a_brain_that_does_not_return_and_one_note(answered, capfd):
    stack, note = capfd.readouterr().err.split(NOTE)
    file = "tests/robot_agent/process/test_brain_runner.py"
    assert answered
    assert stack.splitlines()[-2].endswith(", in act")
    assert note.startswith(f"act has not returned for 0.02 s in {file}: cyan2 is in line ")
    assert note.endswith("at tick 4; its log has the stack\n")


@pytest.fixture
def own_alarm():
    before = signal.signal(signal.SIGALRM, signal.SIG_IGN)
    yield
    signal.signal(signal.SIGALRM, before)


def test_a_brain_that_uses_the_alarm_itself_keeps_it(own_alarm, answered, capfd):
    assert (answered, signal.getsignal(signal.SIGALRM), capfd.readouterr().err) == (True, signal.SIG_IGN, "")
