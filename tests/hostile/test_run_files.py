"""Files of a run: those with secrets are for their owner alone, whatever the umask of the shell allows."""

import json
import os
import stat
from collections.abc import Iterator
from dataclasses import astuple
from pathlib import Path

import pytest

from coach_gateway.access.tokens import tokens_of
from runtime.access.accounts import Account
from runtime.access.credentials import account_file
from runtime.process.clock import WallClock
from runtime.process.settings_file import write_settings
from schemas.config.match_config import load_match
from touchline.launch.processes.programs import client_processes, host_process
from touchline.launch.run_folder import prepare_credentials, prepare_run


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of a shell that lets every user read new files."""
    before = os.umask(0)
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    os.umask(before)


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def test_no_file_of_a_run_that_holds_a_secret_can_be_read_by_others(folder: Path) -> None:
    """Settings of all processes, credentials and tokens; without credentials the secret of the launch."""
    plan = prepare_run(load_match(None), "tcp/127.0.0.1:7447", None, WallClock())
    protected = prepare_credentials(plan, tls=True)
    for each in (plan, protected):
        for process in (host_process(each), *client_processes(each)):
            assert process.settings is not None and process.settings_file is not None
            write_settings(process.settings, process.settings_file)
        for account in Account:
            file = each.credentials_of(account)
            assert file is None or mode(file) == 0o600
    assert protected.credentials is not None
    secrets = [json.loads(account_file(protected.credentials, one).read_text())["password"] for one in Account]
    secrets += astuple(tokens_of(plan.tokens))
    holders = [
        path
        for path in plan.folder.rglob("*")
        if path.is_file() and any(word in path.read_text() for word in (*secrets, plan.launch_token or "-"))
    ]
    assert len(holders) > len(Account)
    assert {mode(path) for path in holders} == {0o600}
