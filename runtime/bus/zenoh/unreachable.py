"""Why no host admits a client at an endpoint: an unknown name, a closed or filtered port, no way there, a refusal.

Zenoh reports every refusal as "unable to connect", and a host that is too busy to answer looks alike.
"""

import socket

from runtime.access.credentials import Credentials
from runtime.bus.endpoint import parse_endpoint
from runtime.process.timing import REPLY_S


def why_unreachable(connect: str, credentials: Credentials | None = None) -> str:
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
            socket.create_connection((str(addresses[0][4][0]), port), timeout=REPLY_S).close()
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
        else:
            return _refused(connect, credentials)
    return f"--connect {connect}: no host answers there; start one with `touchline host`, or name its endpoint"


def _refused(connect: str, credentials: Credentials | None) -> str:
    """The line where a program listens."""
    if credentials is None:
        who, remedy = "a client without credentials", "add --credentials FILE, or set TOUCHLINE_CREDENTIALS"
    else:
        who = f'the user "{credentials.user.value}"'
        remedy = "check --credentials: the file must be of the host's own set"
    return (
        f"--connect {connect}: what listens there does not admit {who}, or is no host that is ready; {remedy} "
        f"(`touchline health --doctor --connect {connect}` examines port and certificate)"
    )
