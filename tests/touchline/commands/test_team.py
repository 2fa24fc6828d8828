"""`touchline team`: what its robots are launched with."""

import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

from runtime.bus.contract import BusError, PresenceKind
from runtime.bus.endpoint import with_free_port
from runtime.bus.zenoh import bus as zenoh_bus
from runtime.bus.zenoh.bus import open_host
from runtime.process.clock import WallClock
from touchline.commands.cli.command_line import app
from touchline.launch import team_run
from touchline.launch.team_run import TeamPlan

BRAIN = ("--brain", "simple")
NOWHERE = ("--connect", "tcp/127.0.0.1:1", "--patience", "0")


def team(*words: str) -> Result:
    return CliRunner().invoke(app, ["team", "cyan", *words], prog_name="touchline")


@pytest.fixture
def planned(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[tuple[str, list[TeamPlan]]]:
    """The endpoint of a host, and what was to be launched for it."""
    plans: list[TeamPlan] = []

    class Launched:
        def __init__(self, plan: TeamPlan, *_: Any) -> None:
            plans.append(plan)

        def play(self) -> None:
            pass

    monkeypatch.setattr(team_run, "TeamRun", Launched)
    monkeypatch.chdir(tmp_path)
    endpoint = with_free_port("tcp/127.0.0.1:0")
    with open_host("friendly", WallClock(), endpoint) as host:
        host.declare_alive(PresenceKind.HOST, "host")
        yield endpoint, plans


def test_the_robots_of_a_team_load_changed_code_if_they_are_to(planned: tuple[str, list[TeamPlan]]) -> None:
    endpoint, plans = planned
    for words in ((), ("--reload",)):
        result = team("--connect", endpoint, *BRAIN, *words)
        assert result.exit_code == 0, result.output
    assert [plan.agent.reload for plan in plans] == [False, True]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("--command", "cat"), "--reload is for brains"),
        (("--stdio", "cat"), "--reload is for brains"),
        ((*BRAIN, "--isolate", "bubblewrap"), "robots in bubblewrap do not see changed files"),
    ],
)
def test_code_that_robots_could_not_load_again_is_refused_before_a_host_is_looked_for(
    words: tuple[str, ...], sentence: str
) -> None:
    result = team(*NOWHERE, *words, "--reload")
    assert result.exit_code == 2
    assert sentence in result.stderr and result.stderr.count("\n") == 1


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_team_waits_for_its_host_until_it_is_interrupted(number: int, monkeypatch: pytest.MonkeyPatch) -> None:
    def no_host(*_: object, **__: object) -> None:
        signal.raise_signal(number)
        raise BusError("no host answers there")

    monkeypatch.setattr(zenoh_bus, "open_client", no_host)
    result = team("--connect", "tcp/127.0.0.1:1", *BRAIN)
    assert (result.exit_code, result.stdout) == (0, "")
    assert result.stderr == "no host answers there; waiting for it for up to 86400 s\n"
