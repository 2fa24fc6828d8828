"""Networks of robots on hardware without a host: what their processes have in common."""

from pathlib import Path

from runtime.bus.endpoint import is_loopback
from runtime.bus.settings import Endpoint
from runtime.bus.zenoh.any_keys import open_network
from runtime.bus.zenoh.bus import ZenohBus
from runtime.process.clock import Clock
from schemas.config.match_config import load_match
from schemas.config.settings import Settings
from schemas.errors import TouchlineError
from schemas.messages.setup import Setup


class WithoutHost(Settings):
    """Without a host: the match, and the network."""

    match_file: Path | None = None
    """Without a host: the match file with robots, profile and rules. With referee.mode = "manual", people or a league's
    referee box decide the game, through `touchline coach bridge`; otherwise it is free."""
    listen: Endpoint | None = None
    """Without a host: the endpoint at which this process waits for robots and recorders, who --connect to it."""
    insecure: bool = False
    """Without a host: let other machines connect, too. There are no credentials; use a network of your own."""

    def check(self, *, has_credentials: bool) -> None:
        """Check that the options fit together.

        Raises:
            TouchlineError: one has no effect without another.
        """
        if self.match_file is None and (self.listen is not None or self.insecure):
            raise TouchlineError("--listen and --insecure are for robots without a host; add --match-file")
        if self.match_file is not None and has_credentials:
            raise TouchlineError("--credentials are those of a host; leave them or --match-file out")

    def setup(self) -> Setup:
        """The setup of the match that the match file describes.

        Raises:
            TouchlineError: the file is invalid.
        """
        config = load_match(self.match_file)
        return Setup.of(config, config.load_profile(), config.load_rule_book())

    def open(self, match: str, connect: str | None, clock: Clock, patience: float) -> ZenohBus:
        """The network: this process waits for the others, or connects to one of them at `connect`.

        Raises:
            TouchlineError: it is open to other machines and that is not wanted, or nothing answers for `patience` s.
        """
        listen = self.listen
        if listen is not None and connect is not None:
            raise TouchlineError("--listen waits for others, --connect joins one that does; leave one of them out")
        if listen is not None and not self.insecure and not is_loopback(listen):
            raise TouchlineError(
                f"--listen {listen} is open to other machines; add --insecure on a network of your own, or listen on "
                "tcp/127.0.0.1:7447"
            )
        return open_network(match, clock, connect, listen, patience=patience)
