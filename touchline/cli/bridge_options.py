"""The words for bridges that several commands share: what coach programs, referee boxes and audiences are joined to."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import typer

from coach_gateway.ports import LOOPBACK
from coach_gateway.refbox.framing import BoxProtocol
from schemas.side import Side

if TYPE_CHECKING:
    from coach_gateway.bridges import Bridges

_Words = list[str] | None


@dataclass(frozen=True, slots=True)
class BridgeOptions:
    """One option each."""

    udp: Annotated[int | None, typer.Option(help="Hear coach programs on this UDP port; 0 takes a free one.")] = None
    refbox: Annotated[
        str | None, typer.Option(metavar="HOST[:PORT]", help="Be a base station at a league's referee box.")
    ] = None
    team: Annotated[list[Side] | None, typer.Option(help="Whose base station; may be given twice.")] = None
    refbox_protocol: Annotated[
        BoxProtocol, typer.Option(help="How that box speaks; auto: as its first bytes show.")
    ] = BoxProtocol.AUTO
    refbox_server: Annotated[
        _Words, typer.Option(metavar="[SIDE:]PORT", help="Be a referee box for team software; the league's is 28097.")
    ] = None
    audience: Annotated[_Words, typer.Option(metavar="HOST:PORT", help="Send the audience feed there.")] = None
    listen_bridges: Annotated[
        str, typer.Option(help="Address that programs and base stations come to; 0.0.0.0 lets other machines in.")
    ] = LOOPBACK

    def bridges(self) -> "Bridges":
        """What is wanted.

        Raises:
            TouchlineError: a word that cannot be meant.
        """
        from coach_gateway.bridges import bridges_of

        return bridges_of(
            udp=self.udp,
            refbox_at=self.refbox,
            teams=self.team or (),
            protocol=self.refbox_protocol,
            server_addresses=self.refbox_server or (),
            audience=self.audience or (),
            listen=self.listen_bridges,
        )

    def arguments(self) -> tuple[str, ...]:
        """The same words for the gateway's process; none where no bridge is wanted.

        Raises:
            TouchlineError: as `bridges`.
        """
        if self == NO_BRIDGES or not self.bridges().wanted:
            return ()
        one = {"udp": self.udp, "refbox": self.refbox}
        return (
            *(f"--{word}={value}" for word, value in one.items() if value is not None),
            *(f"--team={side.value}" for side in self.team or ()),
            f"--refbox-protocol={self.refbox_protocol.value}",
            *(f"--refbox-server={address}" for address in self.refbox_server or ()),
            *(f"--audience={address}" for address in self.audience or ()),
            f"--listen-bridges={self.listen_bridges}",
        )


NO_BRIDGES = BridgeOptions()
