"""Which endpoints a host may listen on: one that others reach is protected, or said to be open."""

from pathlib import Path

import pytest

from runtime.bus.settings import ListenSettings, check_protected
from schemas.errors import TouchlineError

FILE = Path("host.json")


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"listen": "tcp/127.0.0.1:7447"},
        {"listen": "tcp/localhost:7447"},
        {"listen": "tcp/0.0.0.0:7447", "insecure": True},
        {"listen": "tcp/0.0.0.0:7447", "credentials": FILE},
        {"listen": "tls/0.0.0.0:7447", "credentials": FILE},
    ],
)
def test_an_endpoint_for_this_machine_and_one_that_is_protected_or_said_to_be_open_are_admitted(settings) -> None:
    check_protected(ListenSettings(**settings))


@pytest.mark.parametrize(
    ("listen", "insecure", "words"),
    [
        ("tcp/0.0.0.0:7447", False, "is open to other machines; make passwords with `touchline credentials new`"),
        ("tcp/[::]:7447", False, "or add --insecure to admit everybody"),
        ("tls/127.0.0.1:7447", False, "needs a certificate; make one with `touchline credentials new --tls`"),
        ("tls/127.0.0.1:7447", True, "add --credentials credentials/host.json"),
    ],
)
def test_an_open_or_half_encrypted_endpoint_is_refused_with_the_remedy(listen: str, insecure: bool, words: str) -> None:
    with pytest.raises(TouchlineError) as refused:
        check_protected(ListenSettings(listen=listen, insecure=insecure))
    assert str(refused.value).startswith(f"--listen {listen} ") and words in str(refused.value)
