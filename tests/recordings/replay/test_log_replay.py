"""Files of other writers on a network of Zenoh that is none of a match."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from support.foreign import Network, drive, write_mcap
from touchline.commands.cli.command_line import app


@pytest.fixture
def network() -> Iterator[Network]:
    network = Network()
    yield network
    network.close()


def replay(network: Network, *words: str | Path) -> Result:
    return CliRunner().invoke(
        app, ["replay", *map(str, words), "--connect", network.endpoint], prog_name="touchline", catch_exceptions=False
    )


def test_a_json_file_of_another_writer_is_replayed_on_keys_named_like_its_topics(tmp_path, network):
    file = write_mcap(tmp_path / "log.mcap", drive(50))
    result = replay(network, file, "--rate", "100")
    assert result.exit_code == 0, result.output
    samples = network.received(50)
    assert {str(one.key_expr) for one in samples} == {"robot1/odom"}
    assert [one.payload.to_bytes() for one in samples] == [payload for _, _, payload in drive(50)]
    assert {str(one.encoding) for one in samples} == {"application/json;any"}
