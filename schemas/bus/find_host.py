"""Finds the host of a client without an endpoint: the running match of this user on this machine."""

from collections.abc import Iterable

from schemas.bus.announcement import Announcement, running_hosts
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.errors import TouchlineError


def endpoint_of(match: str | None) -> str:
    """The endpoint of the running match of this name, or of the only running match where the name is None.

    Without one it is the default endpoint: a host may run there that another user or another container has started.

    Raises:
        TouchlineError: several matches run, or only matches of other names.
    """
    hosts = running_hosts()
    found = [host for host in hosts if match in (None, host.match)]
    if len(found) == 1:
        return found[0].endpoint
    if found:
        raise TouchlineError(f"{len(found)} matches run on this machine; choose one by --connect:{_lines(found)}")
    if hosts:
        raise TouchlineError(
            f'no match "{match}" runs on this machine, but these; choose one by --connect:{_lines(hosts)}'
        )
    return DEFAULT_ENDPOINT


def _lines(hosts: Iterable[Announcement]) -> str:
    return "".join(
        f'\n  --connect {host.endpoint}   match "{host.match}", process {host.pid}, started in {host.folder}'
        for host in hosts
    )
