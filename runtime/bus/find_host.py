"""Finds the host of a client among the running matches of this user on this machine, and the client's credentials."""

from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from runtime.access.accounts import Account
from runtime.access.credentials import Credentials, account_file, read_credentials
from runtime.bus.announcement import Announcement, running_hosts
from runtime.bus.endpoint import DEFAULT_ENDPOINT
from schemas.errors import TouchlineError


class HostAddress(NamedTuple):
    """Where a host is, and what its user's clients need to join it."""

    endpoint: str
    credentials: Path | None = None
    """Folder with the credentials of all accounts; None where none are announced."""

    def credentials_of(self, account: Account) -> Credentials | None:
        """The credentials of an account; None where none are announced.

        Raises:
            TouchlineError: the file cannot be read.
        """
        if self.credentials is None:
            return None
        file = account_file(self.credentials, account)
        return read_credentials(file) if file.exists() else None


def find_host(match: str | None, connect: str | None = None) -> HostAddress:
    """The host at an endpoint; without one the running match of this name, or the only one where the name is None.

    Without a running match it is the default endpoint: a host may run there that another user or another container has
    started.

    Raises:
        TouchlineError: no endpoint is given, and several matches run, or only matches of other names.
    """
    hosts = running_hosts()
    if connect is not None:
        known = [host.credentials for host in hosts if _address(host.endpoint) == _address(connect)]
        return HostAddress(connect, _folder(known[0]) if known else None)
    found = [host for host in hosts if match in (None, host.match)]
    if len(found) == 1:
        return HostAddress(found[0].endpoint, _folder(found[0].credentials))
    if found:
        raise TouchlineError(f"{len(found)} matches run on this machine; choose one by --connect:{_lines(found)}")
    if hosts:
        raise TouchlineError(
            f'no match "{match}" runs on this machine, but these; choose one by --connect:{_lines(hosts)}'
        )
    return HostAddress(DEFAULT_ENDPOINT)


def announced_credentials(endpoint: str, account: Account) -> Path | None:
    """The file of an account's credentials that the running match at an endpoint has announced; None without one."""
    folder = find_host(None, endpoint).credentials
    file = account_file(folder, account) if folder is not None else None
    return file if file is not None and file.exists() else None


def _address(endpoint: str) -> str:
    """Host and port of an endpoint: clients with a root certificate use TLS where tcp is given."""
    return endpoint.partition("/")[2].replace("localhost:", "127.0.0.1:")


def _folder(credentials: str | None) -> Path | None:
    return Path(credentials) if credentials is not None else None


def _lines(hosts: Iterable[Announcement]) -> str:
    return "".join(
        f'\n  --connect {host.endpoint}   match "{host.match}", process {host.pid}, started in {host.folder}'
        for host in hosts
    )
