"""`touchline pace` and `touchline pace step`, against the pause of a host in the same process."""

import pytest
from typer.testing import CliRunner, Result

from runtime.access.accounts import Account
from schemas.topics import PACE
from sim_host.server.services.pause import Pause
from support.terminal import Terminal
from touchline.commands.cli.command_line import app


@pytest.fixture
def accounts(terminal: Terminal) -> list[Account]:
    """The accounts with which a host at tick 412 is asked."""
    terminal.answers({PACE: Pause(lambda: 412, lambda: False).handle})
    return terminal.accounts


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
