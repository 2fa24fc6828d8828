"""Certificates for TLS at a private event: a root of its own, and one certificate for the host."""

from collections.abc import Sequence

from pydantic import Field

from runtime.process.installed import need
from schemas.config.config_model import ConfigModel
from schemas.errors import TouchlineError

LOOPBACK_NAMES = ("localhost", "127.0.0.1", "::1")
"""Names of the host for clients of its own machine, which every certificate has."""


class Certificate(ConfigModel):
    """The certificate of a host."""

    root: str
    """Root certificate, PEM; clients get it."""
    chain: str
    """Certificate of the host, PEM."""
    private_key: str = Field(repr=False)
    """Its private key, PEM."""


def need_trustme() -> None:
    """Check that certificates can be made.

    Raises:
        TouchlineError: the package is missing; names the command that installs it.
    """
    need("certificates for TLS need trustme", "tls", "trustme")


def make_certificate(names: Sequence[str] = ()) -> Certificate:
    """A certificate for loopback and for the host names and addresses by which clients connect.

    Raises:
        TouchlineError: the package for certificates is missing, or a name is none.
    """
    need_trustme()
    import trustme

    root = trustme.CA(organization_name="Touchline", organization_unit_name="private event")
    identities = list(dict.fromkeys((*names, *LOOPBACK_NAMES)))
    try:
        issued = root.issue_cert(*identities)
    except (ValueError, UnicodeError):
        raise TouchlineError(
            f"--host-name {', '.join(names)}: not a host name or address; write sim-host.local or 192.168.1.5"
        ) from None
    return Certificate(
        root=root.cert_pem.bytes().decode(),
        chain="".join(blob.bytes().decode() for blob in issued.cert_chain_pems),
        private_key=issued.private_key_pem.bytes().decode(),
    )
