"""The network that a page is counted for: one IPv4 address, or one IPv6 /64 network."""

from ipaddress import IPv6Address, ip_address

_NETWORK_BITS = 64
"""Bits of an IPv6 address that one client shares with all its other addresses."""


def client_network(address: str | None) -> str | None:
    """The address or network that a page is counted for; None for this machine itself.

    A proxy on this machine forwards pages from everywhere, so pages from this machine are not counted.
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
