"""`touchline parameters`, against a host of the same process."""

import json

import pytest
from typer.testing import CliRunner, Result

from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError
from schemas.messages.parameters import ParametersReply, ParametersRequest
from schemas.topics import PARAMETERS
from sim_host.match.live_parameters import LiveParameters
from support.terminal import Terminal
from touchline.commands.cli.command_line import app


@pytest.fixture(autouse=True)
def host(terminal: Terminal) -> None:
    """Answers as a host does, from the numbers of the default match."""
    live = [LiveParameters.of(MatchConfig())]

    def answer(request: ParametersRequest) -> ParametersReply:
        try:
            live.append(live[-1].after_request(request))
        except TouchlineError as error:
            return ParametersReply(accepted=False, reason=str(error))
        asked = tuple(request.values) or tuple(request.names)
        return ParametersReply(accepted=True, parameters=live[-1].describe(asked))

    terminal.answers({PARAMETERS: answer})


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
