"""What a gateway process is started with: the page, the bridges, or both."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from coach_gateway.ports import LOOPBACK
from coach_gateway.web.settings import WebSettings
from runtime.bus.settings import ClientSettings
from runtime.bus.without_host import WithoutHost
from runtime.process.log_format import LogSettings
from schemas.config.settings import CommandLine, Settings
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.side import Side


class BridgeOptions(Settings):
    """What coach programs, referee boxes and audiences are joined to."""

    udp: Annotated[int | None, Field(ge=0, le=65_535)] = None
    """Accept coach programs on this UDP port; 0 selects a free one."""
    refbox: Annotated[str | None, CommandLine(metavar="HOST[:PORT]")] = None
    """Be a base station at a league's referee box."""
    team: list[Side] = Field(default_factory=list)
    """Whose base station; may be given twice."""
    refbox_protocol: BoxProtocol = BoxProtocol.AUTO
    """Protocol of that box; auto: as its first bytes show."""
    refbox_server: Annotated[list[str], CommandLine(metavar="[SIDE:]PORT[:characters]")] = Field(default_factory=list)
    """Be a referee box for team software; the league's port is 28097. With :characters for software of before 2020."""
    address: Annotated[list[str], CommandLine(metavar="SIDE=ADDRESS")] = Field(default_factory=list)
    """League address of a side, for team software that is served by --refbox-server."""
    audience: Annotated[list[str], CommandLine(metavar="HOST:PORT")] = Field(default_factory=list)
    """Send the audience feed there."""
    listen_bridges: str = LOOPBACK
    """Address that programs and base stations come to; 0.0.0.0 lets other machines in."""

    @property
    def wanted(self) -> bool:
        """Whether there is any bridge to run."""
        given = (self.refbox, self.team, self.refbox_server, self.address, self.audience)
        return self.udp is not None or any(given)


NO_BRIDGES = BridgeOptions()
_A_HOST = WithoutHost()


class GatewaySettings(ClientSettings, LogSettings):
    """One gateway process: a page, bridges, or both."""

    tokens: Annotated[Path | None, CommandLine(environment="TOUCHLINE_TOKENS")] = None
    """File of the tokens, made when it is not there; without one they last as long as the process."""
    web: WebSettings | None = None
    """The page."""
    result: Path | None = None
    """Folder in which the result of the match will be written; with one, the page's server ends after the match, once
    no page is open any more."""
    bridges: BridgeOptions = NO_BRIDGES
    """What takes part besides the page."""
    alone: WithoutHost = _A_HOST
    """Robots on hardware without a host, whose game this process publishes."""
