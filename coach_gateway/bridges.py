"""The bridges of one gateway process, besides the page: which ones its settings ask for, and their services."""

import socket
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field

from coach_gateway.access.roles import COACHES
from coach_gateway.access.tokens import Tokens
from coach_gateway.match.live import LiveMatch
from coach_gateway.ports import LOOPBACK, InheritedSockets, bound_socket
from coach_gateway.service import Service
from coach_gateway.settings import BridgeOptions, GatewaySettings
from coach_gateway.soccer import refbox
from coach_gateway.soccer.refbox.audience_feed import AudienceFeed
from coach_gateway.soccer.refbox.client import BoxAddress, RefBoxClient
from coach_gateway.soccer.refbox.identity import SENT
from coach_gateway.soccer.refbox.server import RefBoxServer, ServerAddress
from coach_gateway.soccer.without_host.service import ServiceWithoutHost
from coach_gateway.udp.server import UdpServer
from runtime.bus.contract import Bus
from runtime.bus.zenoh.bus import ZenohBus
from runtime.process.clock import WallClock
from runtime.process.timing import RECONNECT_S
from schemas.errors import TouchlineError
from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.side import Side
from schemas.soccer.game import OfficiatingMode


@dataclass(frozen=True, slots=True)
class Bridges:
    """The bridges that are served besides the page."""

    udp: int | None = None
    """Port for coach programs; 0 selects a free one."""
    boxes: tuple[BoxAddress, ...] = ()
    """Referee boxes of the league, one for each team whose base station this is."""
    server_addresses: tuple[ServerAddress, ...] = ()
    """Where our referee serves as a referee box."""
    addresses: Mapping[Side, str] = field(default_factory=dict)
    """What sides are called in the commands of our box, where it is not their name."""
    audience: tuple[tuple[str, int], ...] = ()
    """Host and port of each receiver of the audience feed."""
    listen: str = LOOPBACK
    """Address that programs and base stations connect to."""

    def open_ports(self, inherited: InheritedSockets | None = None) -> list[socket.socket]:
        """Bind all ports, or take the sockets of a launcher that has bound them: that for coach programs, if they are
        wanted, then those for team software, in the order of the server addresses.

        Raises:
            TouchlineError: a port is in use.
        """
        with ExitStack() as stack:

            def bound(option: str, address: str, port: int, kind: socket.SocketKind) -> socket.socket:
                opened = inherited.next() if inherited is not None else None
                return stack.enter_context(opened or bound_socket(option, address, port, kind))

            ports = [bound("--udp", self.listen, self.udp, socket.SOCK_DGRAM)] if self.udp is not None else []
            ports += [
                bound("--refbox-server", address.host, address.port, socket.SOCK_STREAM)
                for address in self.server_addresses
            ]
            stack.pop_all()
        return ports


_LAST_PORT = 65_535


def bridges_of(options: BridgeOptions) -> Bridges:
    """The bridges that these options ask for.

    Raises:
        TouchlineError: an invalid address or port, or a referee box without a team.
    """
    if options.refbox is None and options.team:
        raise TouchlineError("--team is for --refbox HOST, which is not given")
    if options.refbox is not None and not options.team:
        raise TouchlineError("--refbox needs the team whose base station this is; add --team cyan or --team magenta")
    if options.address and not options.refbox_server:
        raise TouchlineError("--address is for --refbox-server, which is not given")
    box = _address("--refbox", options.refbox, refbox.DEFAULT_PORT) if options.refbox is not None else None
    boxes = tuple(BoxAddress(team, *box, options.refbox_protocol) for team in options.team) if box is not None else ()
    return Bridges(
        udp=options.udp,
        boxes=boxes,
        server_addresses=tuple(_server_address(word, options.listen_bridges) for word in options.refbox_server),
        addresses=dict(_league_address(word) for word in options.address),
        audience=tuple(_address("--audience", word, None) for word in options.audience),
        listen=options.listen_bridges,
    )


def services_of(
    bus: Bus, wanted: Bridges, ports: Sequence[socket.socket], tokens: Tokens, log: Callable[[str], None]
) -> list[Service]:
    """The services of these bridges, on their open ports; the first follows the match for all of them."""
    live = LiveMatch(bus)
    services, bound = list[Service]([live]), iter(ports)
    if wanted.udp is not None:
        services.append(UdpServer(live, tokens.role_of, log, next(bound)))
    services += [RefBoxClient(live, box, log) for box in wanted.boxes]
    team_states = None
    if wanted.server_addresses:
        box = RefBoxServer(
            live,
            wanted.server_addresses,
            tuple(bound),
            log,
            lambda token: _side_of(tokens, token),
            addresses=wanted.addresses,
        )
        team_states = box.team_states
        services.append(box)
    if wanted.audience:
        services.append(AudienceFeed(live, wanted.audience, log, team_states))
    return services


def open_without_host(settings: GatewaySettings) -> tuple[ZenohBus, Service]:
    """Open the network of robots without a host; its bus, and the service that publishes the game there.

    Raises:
        TouchlineError: as `WithoutHost.open`, or the referee of a host would decide the game.
    """
    alone = settings.alone
    setup = alone.setup()
    if setup.officiating is not OfficiatingMode.MANUAL:
        raise TouchlineError(
            f'{alone.match_file}: referee.mode is "{setup.officiating.value}", and without a host nobody decides so; '
            'write mode = "manual" in [referee], also for the robots'
        )
    bus = alone.open(settings.match or setup.match, settings.connect, WallClock(), RECONNECT_S)
    return bus, ServiceWithoutHost(bus, setup)


def _side_of(tokens: Tokens, token: str) -> Side | None:
    role = tokens.role_of(token)
    return COACHES.get(role) if role is not None else None


def _address(option: str, word: str, default: int | None) -> tuple[str, int]:
    """Host and port of HOST:PORT, where the port may be left out if there is a default."""
    host, _, port = word.rpartition(":") if ":" in word else (word, "", "" if default is None else str(default))
    if host and port.isascii() and port.isdigit() and 0 < int(port) <= _LAST_PORT and _is_name(host.strip("[]")):
        return host.strip("[]"), int(port)
    shape = "HOST:PORT" if default is None else f"HOST or HOST:PORT, by default port {default}"
    raise TouchlineError(f'{option} is "{word}"; it is {shape}')


def _is_name(host: str) -> bool:
    """Whether this is spelled like a host's address or name; an IPv6 address needs brackets before its port."""
    try:
        host.encode("idna")
    except UnicodeError:
        return False
    return not host.endswith(":")


def _server_address(word: str, listen: str) -> ServerAddress:
    """PORT, SIDE:PORT for a port that one team alone uses, either with :characters for software of before 2020."""
    place, colon, protocol = word.rpartition(":")
    if not (colon and protocol in SENT):
        place, protocol = word, BoxProtocol.JSON.value
    side, _, port = place.rpartition(":")
    known = [known.value for known in Side]
    if port.isascii() and port.isdigit() and int(port) <= _LAST_PORT and (not side or side in known):
        return ServerAddress(int(port), Side(side) if side else None, listen, BoxProtocol(protocol))
    raise TouchlineError(
        f'--refbox-server is "{word}"; it is PORT, or cyan:PORT or magenta:PORT for one team alone; '
        "PORT:characters is for software of before 2020"
    )


def _league_address(word: str) -> tuple[Side, str]:
    """SIDE=ADDRESS, what the side is called in the commands of our box."""
    side, _, address = word.partition("=")
    if side in [known.value for known in Side] and address.strip() and address.isprintable():
        return Side(side), address.strip()
    raise TouchlineError(f'--address is "{word}"; it is cyan=ADDRESS or magenta=ADDRESS, as in cyan=224.16.32.44')
