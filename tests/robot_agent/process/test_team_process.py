"""The robots of a team in one process: turns, and what ends all of them."""

import threading
from collections.abc import Callable, Iterator
from functools import partial
from types import SimpleNamespace
from typing import Any

import pytest

from robot_agent.process.brain_runner import BrainRunner
from robot_agent.process.runner import Member
from robot_agent.process.settings import FIRST_SIGHT_FAILED
from robot_agent.process.team_process import serve_team
from runtime.bus.contract import PresenceKind, Subscription
from schemas.errors import TouchlineError
from schemas.messages.command import Command
from schemas.messages.sight import Sight
from schemas.topics import COMMAND, SETUP, SIGHT
from support.in_process_bus import SharedState
from support.process_story import wait_for
from support.stepped_clock import SteppedClock

ROBOTS = ("cyan1", "cyan2", "cyan3")


class Team:
    """A process of a team on a thread of the test, which is its host."""

    def __init__(self, setup: Any) -> None:
        medium = SharedState()
        self.host, self.bus = (medium.open_bus("friendly", SteppedClock()) for _ in range(2))
        self.host.declare_alive(PresenceKind.HOST, "host")
        self.commands = self.host.subscribe(COMMAND)
        self.sights = {robot: self.host.publisher(SIGHT, robot=robot) for robot in ROBOTS}
        self.presence = self.host.watch_alive()
        self.ready = set(ROBOTS)
        self.threads: set[str] = set()
        self.status: int | BaseException | None = None
        self._setup, self._server = setup, self.host.serve(SETUP)
        self._thread = threading.Thread(target=self._run, daemon=True)

    def act(self, sight: Sight) -> Command:
        self.threads.add(threading.current_thread().name)
        if sight.tick == 9:
            raise ZeroDivisionError("no ball, no plan")
        return Command(answers_tick=sight.tick)

    def build(self, _: Any) -> Any:
        return SimpleNamespace(act=self.act)

    def start(self) -> None:
        self._thread.start()

    def end(self) -> int | BaseException | None:
        self._thread.join(30.0)
        return self.status

    def joined(self) -> set[str]:
        """The robots that have joined since the last call."""
        found = iter(self.presence.receive, None)
        return {one.name for one in found if one.kind is PresenceKind.AGENT and one.alive}

    def _run(self) -> None:
        answering = threading.Thread(target=self._answer, daemon=True)
        answering.start()
        try:
            self.status = serve_team(self.bus, ROBOTS, self._member, self.ready.__contains__)
        except TouchlineError as error:
            self.status = error

    def _answer(self) -> None:
        while (query := self._server.receive(None)) is not None:
            query.reply(self._setup)

    def _member(self, robot: str, sights: Subscription) -> Member:
        return Member(self.bus, self.build, robot, 60.0, make_runner=partial(BrainRunner, sights=sights))


@pytest.fixture
def team(setup, monkeypatch) -> Iterator[Team]:
    monkeypatch.setattr("robot_agent.process.team_process.IDLE_S", 0.01)
    made = Team(setup)
    yield made
    made.bus.close()
    made.end()
    made.host.close()


def test_each_robot_answers_its_sights_on_the_one_thread_of_its_team(team: Team, sight_of: Callable[..., Sight]):
    team.start()
    joined: set[str] = set()
    wait_for(lambda: joined.update(team.joined()) or joined == set(ROBOTS))
    for tick in range(3):
        for robot, sights in team.sights.items():
            sights.put(sight_of(tick, robot))
        answered = [wait_for(team.commands.receive) for _ in ROBOTS]
        assert [(one.key, one.message().answers_tick) for one in answered] == [
            (f"robot/{robot}/command", tick) for robot in ROBOTS
        ]
    assert len(team.threads) == 1


def test_a_robot_joins_once_it_is_ready_and_gets_no_sight_before(team: Team, sight_of: Callable[..., Sight]):
    team.ready = {"cyan1"}
    team.start()
    joined: set[str] = set()
    wait_for(lambda: joined.update(team.joined()) or joined)
    team.sights["cyan2"].put(sight_of(0, "cyan2"))
    team.sights["cyan1"].put(sight_of(0, "cyan1"))
    assert wait_for(team.commands.receive).key == "robot/cyan1/command"
    assert joined == {"cyan1"} and team.commands.receive() is None
    team.ready.add("cyan2")
    wait_for(lambda: joined.update(team.joined()) or joined == {"cyan1", "cyan2"})
    team.sights["cyan2"].put(sight_of(1, "cyan2"))
    assert wait_for(team.commands.receive).key == "robot/cyan2/command"


@pytest.mark.parametrize(("first", "status"), [(9, FIRST_SIGHT_FAILED), (8, 1)])
def test_a_robot_that_fails_ends_the_process_with_its_status(
    team: Team, sight_of: Callable[..., Sight], capsys: pytest.CaptureFixture[str], first: int, status: int
):
    team.start()
    joined: set[str] = set()
    wait_for(lambda: joined.update(team.joined()) or joined == set(ROBOTS))
    if first == 8:
        team.sights["cyan2"].put(sight_of(8, "cyan2"))
        wait_for(team.commands.receive)
    team.sights["cyan2"].put(sight_of(9, "cyan2"))
    assert team.end() == status
    assert "cyan2 has failed, and with it the process of its team" in capsys.readouterr().err


def test_a_bus_that_is_closed_ends_the_process_with_status_0(team: Team):
    team.start()
    joined: set[str] = set()
    wait_for(lambda: joined.update(team.joined()) or joined == set(ROBOTS))
    team.bus.close()
    assert team.end() == 0


def test_what_one_robot_raises_the_process_raises(team: Team):
    def build(_: Any) -> Any:
        raise TouchlineError("no such brain")

    team.build = build  # type: ignore[method-assign]
    team.start()
    assert str(team.end()) == "no such brain"
