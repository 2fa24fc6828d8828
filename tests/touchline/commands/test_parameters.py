"""`touchline parameters`, against a host of the same process."""

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from typer.testing import CliRunner, Result

from runtime.access.accounts import Account
from runtime.bus.contract import Bus
from runtime.bus.settings import ClientSettings
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.messages.parameters import ParametersReply
from schemas.topics import PARAMETERS
from sim_host.match.live_parameters import LiveParameters
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from touchline.commands import parameters
from touchline.commands.cli.command_line import app


@pytest.fixture(autouse=True)
def host(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Answers as a host does, from the numbers of the default match."""
    medium = SharedState()
    bus = medium.open_bus("friendly", SteppedClock())
    server = bus.serve(PARAMETERS)

    def answer() -> None:
        live_parameters = LiveParameters.of(MatchConfig())
        while (query := server.receive(None)) is not None:
            request = query.message()
            try:
                live_parameters = live_parameters.after_request(request)
                asked = tuple(request.values) or tuple(request.names)
                query.reply(ParametersReply(accepted=True, parameters=live_parameters.describe(asked)))
            except TouchlineError as error:
                query.reply(ParametersReply(accepted=False, reason=str(error)))

    @contextmanager
    def seat(connection: ClientSettings, account: Account) -> Iterator[Bus]:
        with medium.open_bus(connection.match or "friendly", SteppedClock()) as client:
            yield client

    monkeypatch.setattr(parameters, "bus_client", seat)
    thread = threading.Thread(target=answer)
    thread.start()
    yield
    bus.close()
    thread.join()


def touchline(*words: str) -> Result:
    return CliRunner().invoke(app, ["parameters", *words], prog_name="touchline")


def test_a_list_shows_value_unit_range_and_meaning() -> None:
    lines = touchline("list").stdout.splitlines()
    (rolling,) = [line for line in lines if line.startswith("ball.rolling_deceleration ")]
    assert rolling.split("  ")[1:] != [] and "0.5 m/s²" in rolling and "0 to 10" in rolling
    assert rolling.endswith("loss of speed of a ball that rolls freely")
    (length,) = [line for line in lines if line.startswith("field.length ")]
    assert length.endswith("(fixed)")


def test_parameters_are_set_shown_and_brought_back() -> None:
    done = touchline("set", "ball.mass=0.43", "noise.preset=perfect", "--json")
    assert done.exit_code == 0
    assert {one["name"]: one["value"] for one in json.loads(done.stdout)} == {
        "ball.mass": 0.43,
        "noise.preset": "perfect",
    }
    assert "0.43 kg" in touchline("get", "ball").stdout and "was 0.41" in touchline("get", "ball").stdout
    assert "was" not in touchline("reset").stdout


def test_a_refusal_fails_with_its_reason() -> None:
    result = touchline("set", "radio.loss=2")
    assert (result.exit_code, result.stderr) == (
        1,
        "touchline: refused: radio.loss is 2; it must be between 0 and 1\n",
    )
