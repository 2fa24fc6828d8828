"""The process of the tests plays hosts and clients by turns, and takes a host's threads for both."""

from collections.abc import Callable, Sequence

import pytest

from schemas.bus.endpoint import with_port
from schemas.bus.zenoh_bus import open_host
from schemas.clock import WallClock
from schemas.host import Applied
from schemas.match_config import MatchConfig
from sim_host.snapshot import Roster
from sim_host.tuning import Tuning
from sim_host.world.world import World


def pytest_configure() -> None:
    """Zenoh chooses its threads when the first session of a process is opened."""
    open_host("first", WallClock(), with_port("tcp/127.0.0.1:0")).close()


@pytest.fixture(scope="session")
def simulated_again() -> Callable[[MatchConfig, Sequence[Applied]], list[str]]:
    """Gives the hash chain of every tick of a match, from what a recording keeps of it alone."""

    def simulate(config: MatchConfig, recorded: Sequence[Applied]) -> list[str]:
        tuning, robots, obstacles = Tuning.of(config), recorded[0].robots or [], recorded[0].obstacles or []
        world, chains = World(tuning.profile, Roster.cast(robots, tuning.types)), []
        for obstacle in obstacles:
            world.put_obstacle(obstacle)
        for tick in recorded:
            tuning = tuning.laid_over(tick.parameters)
            robots = robots if tick.robots is None else tick.robots
            obstacles = obstacles if tick.obstacles is None else tick.obstacles
            if tick.remade:
                world.remake(tuning.profile, Roster.cast(robots, tuning.types), obstacles)
            world.place(tick.placements)
            if tick.tick > 0:
                if tick.checkpoint:
                    world.rebuild()
                world.advance(tick.inputs)
            chains.append(world.chain())
        world.close()
        return chains

    return simulate
