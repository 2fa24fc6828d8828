"""The links of a host to its clients: what each has sent, and how the host closes or refuses one."""

from collections.abc import Callable
from typing import NamedTuple


class Link(NamedTuple):
    """The link of one client."""

    client: str
    """Identifier of the client's session, which it keeps when it connects again by itself."""
    address: str
    """The client's address."""
    port: int
    """The client's port, by which two links of one address differ."""


class Links:
    """The links of a bus; this is that of a bus without a network, which has none."""

    def traffic(self) -> dict[Link, int]:
        """Link → bytes that its client has sent by it; links whose bytes the system does not count are missing."""
        return {}

    def close(self, link: Link) -> bool:
        """Close a link at once; returns whether it was open. Its client may connect again."""
        del link
        return False

    def refuse_if(self, is_refused: Callable[[Link], bool]) -> None:
        """Close each new link for which this returns true, which is called from another thread."""
