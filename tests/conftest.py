"""The process of the tests plays hosts and clients by turns, and takes a host's threads for both."""

from collections.abc import Callable, Sequence

import pytest

from schemas.bus.endpoint import with_port
from schemas.bus.zenoh_bus import open_host
from schemas.clock import WallClock
from schemas.host import Applied, noted
from schemas.match_config import MatchConfig
from sim_host.resimulation import InForce, Resimulation
from sim_host.tuning import Tuning


def pytest_configure() -> None:
    """Zenoh chooses its threads when the first session of a process is opened."""
    open_host("first", WallClock(), with_port("tcp/127.0.0.1:0")).close()


@pytest.fixture(scope="session")
def simulated_again() -> Callable[[MatchConfig, Sequence[bytes]], list[str]]:
    """Gives the hash chain of every tick of a match, from what a recording keeps of it alone."""

    def simulate(config: MatchConfig, recorded: Sequence[bytes]) -> list[str]:
        again = Resimulation(InForce(Tuning.of(config)))
        chains = [again.step(Applied.decode(payload), noted(payload)).chain for payload in recorded]
        again.close()
        return chains

    return simulate
