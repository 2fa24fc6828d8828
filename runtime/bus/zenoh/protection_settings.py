"""Zenoh's settings for credentials: users and access control of a router, user and root certificate of a client."""

import base64
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from runtime.access.credentials import Credentials
from runtime.access.protection import Protection

_PASSWORDS = "transport/auth/usrpwd/"
_TLS = "transport/link/tls/"


@contextmanager
def router_settings(protection: Protection | None) -> Iterator[dict[str, object]]:
    """The settings of a router, which is opened within the block: Zenoh reads passwords from a file, once."""
    if protection is None:
        yield {}
        return
    credentials = protection.credentials
    handle, name = tempfile.mkstemp(prefix="touchline-")  # only its owner may read it
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.writelines(f"{account.value}:{password}\n" for account, password in credentials.passwords.items())
        settings: dict[str, object] = {_PASSWORDS + "dictionary_file": name, "access_control": dict(protection.rules)}
        if (certificate := credentials.certificate) is not None:
            settings[_TLS + "listen_certificate_base64"] = _base64(certificate.chain)
            settings[_TLS + "listen_private_key_base64"] = _base64(certificate.private_key)
        yield settings
    finally:
        Path(name).unlink()


def client_settings(credentials: Credentials | None) -> dict[str, object]:
    """The settings of a client."""
    if credentials is None:
        return {}
    settings: dict[str, object] = {
        _PASSWORDS + "user": credentials.user.value,
        _PASSWORDS + "password": credentials.password,
    }
    if credentials.root_certificate is not None:
        settings[_TLS + "root_ca_certificate_base64"] = _base64(credentials.root_certificate)
    return settings


def _base64(text: str) -> str:
    return base64.b64encode(text.encode()).decode()
