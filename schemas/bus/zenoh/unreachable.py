"""Why no host can be reached at an endpoint: an unknown name, a closed or filtered port, no way there."""

import socket

from schemas.bus.endpoint import parse_endpoint

_CONNECT_S = 1.0
"""Wall time for a connection; longer than one packet that is lost and sent again takes."""


def why_unreachable(connect: str) -> str:
    """The fault and the remedy, in one line."""
    protocol, host, port = parse_endpoint(connect)
    try:
        addresses = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    except OSError as error:
        return (
            f'--connect {connect}: the name "{host}" has no address here ({error.strerror}); '
            "give the host's address, or add the name to /etc/hosts"
        )
    if protocol in ("tcp", "tls", "ws"):
        try:
            socket.create_connection((str(addresses[0][4][0]), port), timeout=_CONNECT_S).close()
        except TimeoutError:
            return (
                f"--connect {connect}: nothing answers there, not even with a refusal; is the address right, and does "
                f"the firewall of that machine let TCP port {port} in?"
            )
        except ConnectionRefusedError:
            pass  # the machine is there, and no host
        except OSError as error:
            return (
                f"--connect {connect}: no way there from this machine ({error.strerror}); "
                "check its network, and the address"
            )
    return f"--connect {connect}: no host answers there; start one with `touchline host`, or name its endpoint"
