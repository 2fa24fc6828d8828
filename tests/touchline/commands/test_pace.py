"""`touchline pace` and `touchline pace step`, against the pause of a host in the same process."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from typer.testing import CliRunner, Result

from runtime.access.accounts import Account
from runtime.bus.contract import Bus
from runtime.bus.settings import ClientSettings
from schemas.topics import PACE
from sim_host.server.services.pause import Pause
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from touchline.commands import pace
from touchline.commands.cli.command_line import app


@pytest.fixture
def accounts(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[Account]]:
    """The accounts with which a host at tick 412 is asked."""
    medium, used = SharedState(), list[Account]()
    pause = Pause(lambda: 412, lambda: False)
    bus = medium.open_bus("friendly", SteppedClock())
    server = bus.serve(PACE)

    def answer() -> None:
        while (query := server.receive(None)) is not None:
            query.reply(pause.handle(query.message()))

    @contextmanager
    def seat(connection: ClientSettings, account: Account) -> Iterator[Bus]:
        used.append(account)
        with medium.open_bus(connection.match or "friendly", SteppedClock()) as client:
            yield client

    monkeypatch.setattr(pace, "bus_client", seat)
    thread = threading.Thread(target=answer)
    thread.start()
    yield used
    bus.close()
    thread.join()


def touchline(*words: str) -> Result:
    return CliRunner().invoke(app, ["pace", *words], prog_name="touchline")


def test_a_match_is_paused_stepped_and_let_run_by_its_operator(accounts: list[Account]) -> None:
    said = [touchline(*words).stdout for words in ((), ("pause",), ("step", "50"), ("run",))]
    assert said == [f"tick 412: {state}\n" for state in ("runs", "paused", "pauses at tick 462", "runs")]
    assert set(accounts) == {Account.OPERATOR}


def test_a_refusal_fails_with_its_reason(accounts: list[Account]) -> None:
    result = touchline("step")
    assert result.exit_code == 1
    assert result.stderr == "touchline: refused: the match is not paused; pause it first\n"
