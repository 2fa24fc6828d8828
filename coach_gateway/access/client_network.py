"""Where pages come from, as far as room is shared out: one address, or one network of those given to a home."""

from ipaddress import IPv6Address, ip_address

_NETWORK_BITS = 64
"""Of an IPv6 address: whoever has one has all that begin alike."""


def client_network(address: str | None) -> str | None:
    """Whom the room that a page takes is counted for; nobody where that is this machine itself.

    A proxy on this machine brings pages of everywhere, so none are counted for it.
    """
    if address is None:
        return None
    try:
        ip = ip_address(address.partition("%")[0])
    except ValueError:
        return address
    if isinstance(ip, IPv6Address):
        if ip.ipv4_mapped is None:
            network = int(ip) >> (128 - _NETWORK_BITS) << (128 - _NETWORK_BITS)
            return None if ip.is_loopback else str(IPv6Address(network))
        ip = ip.ipv4_mapped
    return None if ip.is_loopback else str(ip)
