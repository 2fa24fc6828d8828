"""The terminal in which the commands of a test are typed in."""

from collections.abc import Iterator

import pytest

from support.terminal import Terminal


@pytest.fixture
def terminal(monkeypatch: pytest.MonkeyPatch) -> Iterator[Terminal]:
    made = Terminal(monkeypatch)
    yield made
    for host in made.hosts:
        host.close()
