"""How people and coach programs take part in a match. Knows the bus, and nothing of physics, teams or files."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from coach_gateway.settings import GatewaySettings


def run(settings: "GatewaySettings") -> int:
    """Serve a match's page and bridges until SIGINT or SIGTERM; the process's exit status.

    Raises:
        TouchlineError: nothing is to be served, a package is not installed, a port is taken, or tokens cannot be read.
    """
    from coach_gateway.process import run as run_process

    return run_process(settings)
