"""Commands that admit a recorder, or an account that was cut off."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from typer.testing import CliRunner, Result

from schemas.access.accounts import Account
from schemas.bus.contract import Bus
from schemas.bus.in_process_bus import SharedState
from schemas.bus.settings import ClientSettings
from schemas.process.clock import SteppedClock
from schemas.topics import ADMISSION
from sim_host.server.account_limits import AccountLimits
from sim_host.server.admission import Admission
from support.fake_host import FakeHost
from touchline.command_line import app
from touchline.commands import admit


@pytest.fixture
def host(monkeypatch: pytest.MonkeyPatch) -> Iterator[FakeHost]:
    """A host that has cut off cyan."""
    accounts = AccountLimits({}, has_accounts=True)
    accounts.of_key("team/cyan/order").cut_off = True
    admission = Admission([], accounts)
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


def test_without_a_name_the_accounts_that_are_cut_off_are_listed(host: FakeHost) -> None:
    assert touchline("referee", "admit").stdout == "cut off: cyan_coach\n"


def test_an_account_is_admitted_again(host: FakeHost) -> None:
    result = touchline("referee", "admit", "cyan_coach")
    assert (result.exit_code, result.stdout) == (0, "cyan_coach is admitted again\nno account is cut off\n")


def test_an_account_that_is_not_cut_off_is_refused_with_the_names_of_those_that_are(host: FakeHost) -> None:
    result = touchline("referee", "admit", "magenta")
    assert result.exit_code == 1
    assert result.stderr == "touchline: refused: magenta is not cut off; cut off are: cyan_coach\n"


def test_a_recorder_is_admitted(host: FakeHost) -> None:
    result = touchline("recorder", "admit", "--name", "tape")
    assert (result.exit_code, result.stdout) == (0, "the host waits for tape\n")
    assert [request.recorder for request in host.asked] == ["tape"]
