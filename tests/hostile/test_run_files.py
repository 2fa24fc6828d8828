"""Files of a run: those with secrets are for their owner alone, whatever the umask of the shell allows."""

import json
import os
import stat
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from coach_gateway.access.tokens import read_or_make
from schemas.access.accounts import Account
from schemas.access.credentials import account_file, credential_files
from schemas.config.match_config import load_match
from schemas.config.settings_file import write_settings
from schemas.process.clock import WallClock
from touchline.launch.processes import client_processes, host_process
from touchline.launch.run_folder import prepare_credentials, prepare_run

NOBODY = 65534
"""User and group without rights."""
as_root = pytest.mark.skipif(os.geteuid() != 0, reason="only root can read files as another user")


@pytest.fixture
def folder(monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A folder that every user may enter, and a shell that lets every user read new files."""
    before = os.umask(0)
    with tempfile.TemporaryDirectory(prefix="touchline-test-") as name:
        Path(name).chmod(0o755)
        monkeypatch.chdir(name)
        yield Path(name)
    os.umask(before)


def mode(path: Path) -> int:
    return stat.S_IMODE(path.stat().st_mode)


def can_be_read_by_others(path: Path) -> bool:
    read = subprocess.run(
        ["cat", str(path)], user=NOBODY, group=NOBODY, extra_groups=[], capture_output=True, check=False
    )
    return read.returncode == 0


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
    holders = [
        path
        for path in plan.folder.rglob("*")
        if path.is_file() and any(word in path.read_text() for word in (*secrets, plan.launch_token or "-"))
    ]
    assert len(holders) > len(Account)
    assert {mode(path) for path in holders} == {0o600}


@as_root
def test_another_user_reads_neither_credentials_nor_tokens_nor_settings(folder: Path) -> None:
    plan = prepare_credentials(prepare_run(load_match(None), None, None, WallClock()), tls=False)
    host = host_process(plan)
    assert host.settings is not None and host.settings_file is not None
    write_settings(host.settings, host.settings_file)
    read_or_make(plan.tokens)
    assert plan.credentials is not None
    for path in (*credential_files(plan.credentials), plan.tokens, host.settings_file):
        assert path.exists() and not can_be_read_by_others(path), path
    (plan.folder / "host.log").touch()
    assert can_be_read_by_others(plan.folder / "host.log")  # so the check can fail
