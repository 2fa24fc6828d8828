"""The command that admits a recorder."""

from typer.testing import CliRunner, Result

from runtime.access.accounts import Account
from schemas.topics import ADMISSION
from sim_host.server.admission.admitted_recorders import AdmittedRecorders
from support.terminal import Terminal
from touchline.commands.cli.command_line import app


def touchline(*words: str) -> Result:
    return CliRunner().invoke(app, words, prog_name="touchline")


def test_a_recorder_is_admitted(terminal: Terminal) -> None:
    host = terminal.answers({ADMISSION: AdmittedRecorders([]).handle})
    result = touchline("referee", "admit-recorder", "--name", "tape")
    assert (result.exit_code, result.stdout) == (0, "the host waits for tape\n")
    assert [request.recorder for request in host.asked] == ["tape"]
    assert terminal.accounts == [Account.REFEREE]
