"""The replay of files that are no recordings of a match, with what stands beside it."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest
import typer

from coach_gateway.web.settings import WebSettings
from recordings.replay.log_replay import Keys
from recordings.replay.replay import ReplaySettings
from runtime.access.accounts import Account
from runtime.access.credentials import account_file, new_credentials, write_credentials
from schemas.messages.replay import ReplayReply
from support.foreign import drive, write_mcap
from touchline.launch import log_replay
from touchline.launch.page import open_page
from touchline.launch.processes.programs import Page


def replayed(folder: Path, credentials: Path | None = None, page: Page | None = None) -> ReplayReply:
    file = write_mcap(folder / "log.mcap", drive(50))
    settings = ReplaySettings(file, rate=None)
    options: dict[str, Any] = {"name": "replay", "connect": None, "listen": "tcp/127.0.0.1:0", "viewers": None}
    return log_replay.replay_log(
        [file], settings, Keys(settings), **options, credentials=credentials, page=page, quiet=True
    )


@pytest.mark.parametrize("has_passwords", [False, True])
def test_the_page_beside_a_replay_has_the_operator_s_account_where_there_are_passwords(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, has_passwords: bool
) -> None:
    supervised = Mock(**{"return_value.check.return_value": []})
    monkeypatch.setattr("touchline.launch.page.Supervisor", supervised)
    write_credentials(tmp_path, new_credentials())
    served = open_page(WebSettings(port=0))
    with served.listener:
        replayed(tmp_path, tmp_path / "host.json" if has_passwords else None, served)
    ((page,), *_), _ = supervised.call_args
    assert page.settings.credentials == (account_file(tmp_path, Account.OPERATOR) if has_passwords else None)


def test_a_replay_that_a_signal_ends_has_the_status_of_the_signal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    @contextmanager
    def serve(*_: Any) -> Iterator[Any]:
        def look_after() -> list[Any]:
            signal.raise_signal(signal.SIGTERM)
            return []

        yield look_after

    monkeypatch.setattr(log_replay, "serve_page_beside", serve)
    with pytest.raises(typer.Exit) as ended:
        replayed(tmp_path)
    assert ended.value.exit_code == 128 + signal.SIGTERM
