"""The simulation host: server, match, referee, sensing, actuation and physics of one match.

It receives commands and actions, and publishes sights, the true state of the world, and events. It knows neither the
code of the teams nor coaches nor recordings.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sim_host.server.settings import HostSettings


def run(settings: "HostSettings") -> int:
    """Host one match until it is over, or until SIGINT or SIGTERM; the exit status of the process.

    Raises:
        TouchlineError: PyBullet is missing, or the endpoint cannot be listened on or is open to others unguarded.
    """
    from sim_host.server.process import run as run_process

    return run_process(settings)
