"""The robots of a team in one process: turns, and what ends all of them."""

import subprocess
import sys
import threading
import time

import pytest

from robot_agent.process import team_process
from robot_agent.process.team_process import MakeRunner, serve_team
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.topics import COMMAND, SIGHT
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock

ROBOTS = ("cyan1", "cyan2", "cyan3")
LIMIT_S = 60.0


class Alone:
    """Answers, and notes whether another brain is within `act` at the same time."""

    acting = 0
    most = 0

    def act(self, sight):
        Alone.acting += 1
        Alone.most = max(Alone.most, Alone.acting)
        time.sleep(0.002)  # others may run meanwhile
        Alone.acting -= 1
        return Command(answers_tick=sight.tick)


def test_each_robot_answers_its_sights_and_none_thinks_while_another_does(sight_of):
    medium = SharedState()
    host = medium.open_bus("friendly", SteppedClock())
    commands = host.subscribe(COMMAND)
    sights = {robot: host.publisher(SIGHT, robot=robot) for robot in ROBOTS}
    together = threading.Barrier(len(ROBOTS), timeout=LIMIT_S)

    def serve_robot(robot: str, make_runner: MakeRunner) -> int:
        runner = make_runner(medium.open_bus("friendly", SteppedClock()), Alone(), robot)
        together.wait()
        for tick in range(10):
            sights[robot].put(sight_of(tick))
            runner.answer(runner.next_sight(0.0))
        together.wait()
        return 0

    assert serve_team(ROBOTS, serve_robot, nothing, WallClock()) == 0
    answered = [received.message().answers_tick for received in iter(commands.receive, None)]
    assert sorted(answered) == sorted(3 * [*range(10)])
    assert Alone.most == 1


def nothing() -> None:
    """Ends no robot: those of the test have ended, or never end."""


def ended(event: threading.Event) -> int:
    """The status of a robot that plays until the event."""
    return 0 if event.wait(LIMIT_S) else 1


def robots_that_run() -> set[str]:
    return {thread.name for thread in threading.enumerate()} & set(ROBOTS)


def test_the_first_robot_that_ends_ends_the_process_with_its_status_and_all_others(monkeypatch):
    monkeypatch.setattr(team_process, "PROGRAM_ENDS_S", LIMIT_S)
    over = threading.Event()
    assert serve_team(ROBOTS, lambda robot, _: 3 if robot == "cyan2" else ended(over), over.set, WallClock()) == 3
    assert robots_that_run() == set()


def test_a_brain_that_does_not_end_delays_the_end_of_the_process_by_a_moment_only(monkeypatch):
    monkeypatch.setattr(team_process, "PROGRAM_ENDS_S", 0.05)
    over = threading.Event()
    assert serve_team(ROBOTS, lambda robot, _: 3 if robot == "cyan2" else ended(over), nothing, WallClock()) == 3
    assert robots_that_run() == {"cyan1", "cyan3"}
    over.set()


TEAM = """
import sys
from robot_agent.process.team_process import serve_team
from runtime.bus.zenoh.bus import open_client
from runtime.process.clock import WallClock

clock = WallClock()
with open_client("friendly", clock, sys.argv[1], 60.0) as bus:
    def serve_robot(robot, make_runner):
        runner = make_runner(bus, None, robot)
        while not bus.closed:
            runner.next_sight(0.05)
            if robot == "cyan1":
                return 3
        return 0
    status = serve_team([f"cyan{number}" for number in range(1, 6)], serve_robot, bus.close, clock)
sys.exit(status)
"""


@pytest.mark.processes
@pytest.mark.slow
def test_no_robot_that_waits_on_the_network_aborts_the_process_that_ends():
    with open_host("friendly", WallClock(), with_free_port("tcp/127.0.0.1:0")) as host:
        words = [sys.executable, "-c", TEAM, host.endpoint]
        teams = [subprocess.Popen(words, stderr=subprocess.PIPE, text=True) for _ in range(6)]
        ends = [(team.communicate(timeout=LIMIT_S)[1], team.returncode) for team in teams]
    assert ends == 6 * [("", 3)]  # without the wait for threads each one of them aborts in every second run


def test_what_one_robot_raises_the_process_raises():
    others = threading.Event()

    def serve_robot(robot: str, _: MakeRunner) -> int:
        if robot == "cyan3":
            raise TouchlineError("cyan3: refused by the host")
        return ended(others)

    with pytest.raises(TouchlineError, match="cyan3: refused by the host"):
        serve_team(ROBOTS, serve_robot, others.set, WallClock())
