"""Credentials of a match: for each account a user and a password, and for the host all of them.

Each is a JSON file that only its owner may read, in a folder of its owner. Passwords are random, of 256 bits: a
connection without TLS does not show a password, but a recorded handshake allows to guess a weak one.
"""

import json
import secrets
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, TypeVar

from pydantic import Field, ValidationError

from runtime.access.accounts import Account
from runtime.access.certificates import Certificate
from runtime.access.private_file import check_private
from runtime.process.whole_file import written_whole
from schemas.config.config_model import ConfigModel
from schemas.errors import TouchlineError, os_errors

_PASSWORD_BYTES = 32
HOST_FILE = "host.json"
"""The file of the host in a folder of credentials; an account's is `{account}.json`."""

Password = Annotated[str, Field(min_length=16, max_length=200, pattern=r"^[A-Za-z0-9_\-]+$")]
"""A password, which is in no representation of its owner."""
C = TypeVar("C", bound=ConfigModel)


class Credentials(ConfigModel):
    """What one account needs to join a match."""

    user: Account
    """Name of the account."""
    password: Password = Field(repr=False)
    """Its password."""
    match: str | None = None
    """Name of the match that it is for; None for any match of the host."""
    connect: str | None = None
    """Endpoint of the host; None where it is given elsewhere."""
    root_certificate: str | None = None
    """Root certificate, PEM, by which the client knows the host; None for a host without TLS."""


class HostCredentials(ConfigModel):
    """What a host needs to know its clients, and to show that it is their host."""

    passwords: dict[Account, Password] = Field(repr=False)
    """Account → its password."""
    match: str | None = None
    """Name of the match that they are for; None for any."""
    certificate: Certificate | None = None
    """The certificate of the host; None without TLS."""

    def of(self, account: Account, connect: str | None = None) -> Credentials:
        """The credentials of an account."""
        return Credentials(
            user=account,
            password=self.passwords[account],
            match=self.match,
            connect=connect,
            root_certificate=self.certificate.root if self.certificate is not None else None,
        )


def new_credentials(match: str | None = None, certificate: Certificate | None = None) -> HostCredentials:
    """New random passwords for all accounts."""
    passwords = {account: secrets.token_urlsafe(_PASSWORD_BYTES) for account in Account}
    return HostCredentials(passwords=passwords, match=match, certificate=certificate)


def account_file(folder: Path, account: Account) -> Path:
    """The file of an account in a folder of credentials."""
    return folder / f"{account.value}.json"


def credential_files(folder: Path) -> list[Path]:
    """All files of a folder of credentials, the host's first."""
    return [folder / HOST_FILE, *(account_file(folder, account) for account in Account)]


def write_credentials(folder: Path, credentials: HostCredentials, connect: str | None = None) -> None:
    """Write the files of the host and of all accounts, which replace earlier ones; the folder is made if it is missing.

    Raises:
        OSError: the folder or a file cannot be written.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    contents: Mapping[Path, ConfigModel] = {
        folder / HOST_FILE: credentials,
        **{account_file(folder, account): credentials.of(account, connect) for account in Account},
    }
    for path, content in contents.items():
        with written_whole(path, private=True) as draft:
            draft.write_text(content.model_dump_json(indent=2) + "\n", "utf-8")


def read_credentials(path: Path) -> Credentials:
    """The credentials of an account.

    Raises:
        TouchlineError: the file cannot be read, is no file of an account, or other users may read it.
    """
    return _read(Credentials, path, "an account's file, such as cyan.json")


def read_host_credentials(path: Path) -> HostCredentials:
    """The credentials of a host.

    Raises:
        TouchlineError: the file cannot be read, is not the file of a host, or other users may read it.
    """
    credentials = _read(HostCredentials, path, f"the host's file, {HOST_FILE}")
    missing = [account.value for account in Account if account not in credentials.passwords]
    if missing:
        raise TouchlineError(f"--credentials {path}: no password for {', '.join(missing)}; {_REMEDY}")
    return credentials


_REMEDY = "`touchline credentials new` writes such files"


def _read(model: type[C], path: Path, what: str) -> C:
    try:
        with os_errors(f"--credentials {path}", _REMEDY), path.open("rb") as file:
            check_private("--credentials", path, file)
            content = json.loads(file.read())
    except ValueError:
        raise TouchlineError(f"--credentials {path}: not JSON; {_REMEDY}") from None
    if not isinstance(content, dict) or ("passwords" in content) != (model is HostCredentials):
        raise TouchlineError(f"--credentials {path}: not {what}; {_REMEDY}")
    try:
        return model.model_validate_json(json.dumps(content), strict=True)
    except ValidationError as error:
        where = ".".join(
            str(step) for step in error.errors(include_input=False)[0]["loc"]
        )  # no value: it may be secret
        raise TouchlineError(f"--credentials {path}: {where} is invalid; {_REMEDY}") from None
