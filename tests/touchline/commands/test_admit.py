"""The command that admits a recorder."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from typer.testing import CliRunner, Result

from runtime.access.accounts import Account
from runtime.bus.contract import Bus
from runtime.bus.settings import ClientSettings
from schemas.topics import ADMISSION
from sim_host.server.admission.admitted_recorders import AdmittedRecorders
from support.fake_host import FakeHost
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from touchline.commands import admit
from touchline.commands.cli.command_line import app


@pytest.fixture
def host(monkeypatch: pytest.MonkeyPatch) -> Iterator[FakeHost]:
    admission = AdmittedRecorders([])
    there = FakeHost(SharedState(), answers={ADMISSION: admission.handle}, clock=SteppedClock(), in_threads=True)

    @contextmanager
    def client(connection: ClientSettings, account: Account) -> Iterator[Bus]:
        assert account is Account.REFEREE
        with there.medium.open_bus(connection.match or "friendly", SteppedClock()) as bus:
            yield bus

    monkeypatch.setattr(admit, "bus_client", client)
    yield there
    there.close()


def touchline(*words: str) -> Result:
    return CliRunner().invoke(app, words, prog_name="touchline")


def test_a_recorder_is_admitted(host: FakeHost) -> None:
    result = touchline("referee", "admit-recorder", "--name", "tape")
    assert (result.exit_code, result.stdout) == (0, "the host waits for tape\n")
    assert [request.recorder for request in host.asked] == ["tape"]
