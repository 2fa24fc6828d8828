"""A brain whose code changes between two episodes of a match."""

import os
import sys
from itertools import count

import pytest
from msgspec.structs import replace

from robot_agent.loading.brain_loader import load_brain
from robot_agent.loading.brain_reload import BrainReload
from robot_agent.process.run import run
from robot_agent.process.runner import Member, serve
from robot_agent.process.settings import AgentSettings
from robot_agent.sdk.contract import Briefing
from schemas.errors import TouchlineError
from schemas.topics import COMMAND, SETUP
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock

NUMBERS = count()
BRAIN = """
from touchline import Command, Drive
from {helper} import SPEED

class Mine:
    def __init__(self, briefing):
        self.acts = 0

    def act(self, sight):
        self.acts += 1
        return Command(answers_tick=sight.tick, drive=Drive(vx=SPEED, vy=0.1 * self.acts))
"""


class Code:
    """The user's folder: a brain in one module, a number that it imports from another."""

    def __init__(self, folder):
        self.folder = folder
        number = next(NUMBERS)
        self.brain, self.helper = f"reloaded_brain_{number}", f"reloaded_helper_{number}"
        self.write_brain(BRAIN.format(helper=self.helper))
        self.write_speed(1.0)

    def write_brain(self, text):
        file = self.folder / f"{self.brain}.py"
        file.write_text(text)
        os.utime(file, (1_700_000_000, 1_700_000_000))

    def write_speed(self, speed):
        """All versions have the same length and the same time, to which compiled files are compared."""
        file = self.folder / f"{self.helper}.py"
        file.write_text(f"SPEED = {speed:.1f}\n")
        os.utime(file, (1_700_000_000, 1_700_000_000))


@pytest.fixture
def code(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    return Code(tmp_path)


@pytest.fixture
def reload(code, setup):
    return BrainReload("cyan2", lambda setup: load_brain(f"{code.brain}:Mine", Briefing.of("cyan2", setup)))


@pytest.fixture
def in_episode(sight_of):
    def sight(episode, tick=0):
        made = sight_of(tick)
        return replace(made, game=replace(made.game, episode=episode))

    return sight


def test_a_changed_module_that_the_brain_imports_makes_a_new_brain_in_the_next_episode(
    code, reload, setup, in_episode, capsys
):
    brain = reload.build(setup)
    assert brain.act(in_episode(1)).drive.vx == 1.0
    assert reload.before(in_episode(1), setup) is None
    code.write_speed(2.0)
    assert reload.before(in_episode(1, 5), setup) is None, "the episode goes on"
    changed = reload.before(in_episode(2), setup)
    assert (changed.act(in_episode(2)).drive.vx, changed.acts) == (2.0, 1)
    assert reload.before(in_episode(2, 1), setup) is None
    assert reload.before(in_episode(3), setup) is None, "nothing has changed since"
    assert capsys.readouterr().err == (
        f"note: episode 2 is played with the changed {code.helper}.py: cyan2 has a new brain\n"
    )


def test_code_that_is_edited_while_it_is_imported_is_imported_again(code, setup, in_episode):
    def build(setup):
        brain = load_brain(f"{code.brain}:Mine", Briefing.of("cyan2", setup))
        (code.folder / f"{code.helper}.py").write_text("SPEED = 2.0\n")
        return brain

    reload = BrainReload("cyan2", build)
    assert reload.build(setup).act(in_episode(1)).drive.vx == 1.0
    assert reload.before(in_episode(1), setup).act(in_episode(1)).drive.vx == 2.0


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("def act(:\n", "SyntaxError: invalid syntax ({brain}.py, line 1)"),
        ("import nowhere_to_be_found\n", "imports nowhere_to_be_found, which is not installed"),
        ("\n1 / 0\n", "ZeroDivisionError: division by zero ({brain}.py, line 2)"),
        ("class Yours: pass\n", "has no Mine"),
    ],
)
def test_broken_code_is_one_line_and_the_old_brain_goes_on(code, reload, setup, in_episode, capsys, text, fault):
    brain = reload.build(setup)
    reload.before(in_episode(1), setup)
    code.write_brain(text)
    assert reload.before(in_episode(2), setup) is None
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"note: episode 2 is played with old brains, the changed {code.brain}.py is broken: cyan2: ")
    assert fault.format(brain=code.folder / code.brain) in line or fault.format(brain=code.brain) in line
    assert brain.act(in_episode(2)).drive.vx == 1.0
    assert reload.before(in_episode(3), setup) is None
    assert capsys.readouterr().err == "", "it is reported once"
    code.write_brain(BRAIN.format(helper=code.helper) + "\n")
    assert reload.before(in_episode(4), setup).act(in_episode(4)).drive.vx == 1.0


def test_a_brain_without_its_file_plays_on(code, reload, setup, in_episode, capsys):
    reload.build(setup)
    reload.before(in_episode(1), setup)
    (code.folder / f"{code.brain}.py").unlink()
    assert reload.before(in_episode(2), setup) is None
    assert f"there is no module {code.brain}" in capsys.readouterr().err


def test_another_match_is_played_with_the_changed_code(code, reload, setup, in_episode):
    reload.build(setup)
    code.write_speed(3.0)
    assert reload.build(setup).act(in_episode(1)).drive.vx == 3.0


def test_an_agent_answers_the_first_sight_of_an_episode_with_its_new_brain(
    code, reload, setup, in_episode, monkeypatch
):
    medium = SharedState()
    host, robot = medium.open_bus("friendly", SteppedClock()), medium.open_bus("friendly", SteppedClock())
    host.declare_alive("host", "host")
    server, commands = host.serve(SETUP), host.subscribe(COMMAND)
    waiting = [in_episode(1, 0), in_episode(1, 1), in_episode(2, 2), in_episode(2, 3)]

    def query(topic, request, timeout=2.0):
        answer = type(robot).query(robot, topic, request, timeout)
        server.receive().reply(setup)
        return answer

    def next_sight(runner, timeout):
        if len(waiting) == 2:
            code.write_speed(2.0)
        if not waiting:
            raise KeyboardInterrupt
        return waiting.pop(0)

    monkeypatch.setattr(robot, "query", query)
    monkeypatch.setattr("robot_agent.process.runner.Runner.next_sight", next_sight)
    with pytest.raises(KeyboardInterrupt):
        serve(robot, Member(robot, reload.build, "cyan2", 1.0, reload=reload))
    drives = [received.message().drive for received in iter(commands.receive, None)]
    assert [drive.vx for drive in drives] == [1.0, 1.0, 2.0, 2.0]
    assert [round(10 * drive.vy) for drive in drives] == [1, 2, 1, 2]


def test_a_program_is_not_reloaded():
    with pytest.raises(TouchlineError, match="--reload is for brains in Python"):
        run(AgentSettings(robot="cyan2", stdio=["./robot"], reload=True))
