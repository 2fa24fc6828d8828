"""A brain that does not return is named with its line, and goes on."""

import threading
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

HANG_S = 0.02
LIMIT_S = 60.0


class Slow:
    """Returns long after it was noted that it does not."""

    def __init__(self) -> None:
        self.noted = threading.Event()

    def act(self, sight):
        self.noted.wait(LIMIT_S)
        time.sleep(10 * HANG_S)
        return Command(answers_tick=sight.tick)


@pytest.fixture
def answered(sight_of, monkeypatch, capfd):
    """Whether a slow brain's answer arrives; what is printed is captured."""
    brain, log_note = Slow(), brain_runner.log_note
    monkeypatch.setattr(brain_runner, "HANG_S", HANG_S)
    monkeypatch.setattr(brain_runner, "log_note", lambda *words: (log_note(*words), brain.noted.set()))
    medium = SharedState()
    host, robot = medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock())
    commands = host.subscribe(COMMAND)
    runner = BrainRunner(robot, brain, "cyan2")
    host.publisher(SIGHT, robot="cyan2").put(sight_of(4))
    answer_next(runner)
    return commands.receive() is not None


def test_the_log_has_the_stack_of_a_brain_that_does_not_return_and_one_note(answered, capfd):
    stack, note = capfd.readouterr().err.split(NOTE)
    file = "tests/robot_agent/process/test_brain_runner.py"
    assert answered
    assert stack.splitlines()[-2].endswith(", in act")
    assert note.startswith(f"act has not returned for 0.02 s in {file}: cyan2 is in line ")
    assert note.endswith("at tick 4; its log has the stack\n")
