"""Announcements of running hosts, and what clients without an endpoint make of them."""

import os
from contextlib import ExitStack

import pytest

from runtime.access.accounts import Account
from runtime.access.credentials import HOST_FILE, account_file, new_credentials, write_credentials
from runtime.bus.announcement import Announcement, announced, announced_to_user, announcement_in, running_hosts
from runtime.bus.endpoint import DEFAULT_ENDPOINT
from runtime.bus.find_host import find_host
from schemas.errors import TouchlineError

FRIENDLY = Announcement.of("friendly", "tcp/0.0.0.0:7001")
CUP = Announcement.of("cup", "tcp/127.0.0.1:7002")


@pytest.fixture(autouse=True)
def runtime(tmp_path, monkeypatch):
    """The user's folder for files of running programs."""
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path / "runtime"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "runtime" / "touchline" / "hosts"


@pytest.fixture
def run():
    """Announces hosts until the end of the test."""
    with ExitStack() as stack:
        yield lambda announcement: stack.enter_context(announced_to_user(announcement))


def test_an_announcement_names_the_endpoint_for_clients_of_this_machine():
    assert (FRIENDLY.endpoint, FRIENDLY.pid) == ("tcp/127.0.0.1:7001", os.getpid())


def test_a_host_is_found_while_it_runs(runtime):
    with announced_to_user(FRIENDLY):
        assert running_hosts() == [FRIENDLY]
    assert running_hosts() == []
    assert list(runtime.iterdir()) == []


def test_only_its_user_may_read_an_announcement(runtime, run):
    run(FRIENDLY)
    (file,) = runtime.iterdir()
    assert (file.stat().st_mode & 0o777, runtime.stat().st_mode & 0o777) == (0o600, 0o700)


def test_the_file_of_a_host_that_was_killed_is_ignored_and_removed(runtime, run):
    run(CUP)
    killed = runtime / "1.json"
    killed.write_text(FRIENDLY.json())
    assert running_hosts() == [CUP]
    assert not killed.exists()
    (running,) = runtime.iterdir()
    running.write_text('{"port": 7447}')  # of a host of another version
    assert running_hosts() == [] and running.exists()


def test_a_launcher_reads_the_announcement_of_its_own_host(tmp_path):
    path = tmp_path / "run" / "endpoint.json"
    assert announcement_in(path) is None
    with announced(FRIENDLY, path):
        assert announcement_in(path) == FRIENDLY
    assert announcement_in(path) is None


def test_where_the_runtime_folder_cannot_be_written_the_state_folder_is_used(tmp_path, run):
    (tmp_path / "runtime").write_text("a file")
    run(FRIENDLY)
    assert running_hosts() == [FRIENDLY]
    assert len(list((tmp_path / "state" / "touchline" / "hosts").iterdir())) == 1


def test_where_no_folder_can_be_written_that_is_an_error(tmp_path, run):
    for name in ("runtime", "state"):
        (tmp_path / name).write_text("a file")
    with pytest.raises(OSError, match=r"runtime|state"):
        run(FRIENDLY)


def test_the_running_match_is_found_whatever_its_port_and_name(run):
    run(CUP)
    assert find_host(None).endpoint == find_host("cup").endpoint == "tcp/127.0.0.1:7002"


def test_one_of_two_running_matches_is_found_by_its_name(run):
    run(CUP)
    run(FRIENDLY)
    assert find_host("friendly").endpoint == "tcp/127.0.0.1:7001"


@pytest.mark.parametrize("name", [None, "final"])
def test_where_it_is_not_clear_which_match_is_meant_they_are_listed(run, name):
    run(CUP)
    run(FRIENDLY)
    with pytest.raises(TouchlineError) as error:
        find_host(name)
    first, *lines = str(error.value).splitlines()
    assert first.endswith("choose one by --connect:")
    assert sorted(line.partition(", process")[0].strip() for line in lines) == [
        '--connect tcp/127.0.0.1:7001   match "friendly"',
        '--connect tcp/127.0.0.1:7002   match "cup"',
    ]


def test_without_an_announcement_a_client_tries_the_default_endpoint():
    assert find_host(None).endpoint == find_host("cup").endpoint == DEFAULT_ENDPOINT


@pytest.mark.parametrize("connect", [None, "tcp/127.0.0.1:7003", "tls/127.0.0.1:7003", "tcp/localhost:7003"])
def test_a_client_of_the_user_finds_the_credentials_of_its_account_with_and_without_an_endpoint(tmp_path, run, connect):
    made = new_credentials()
    write_credentials(tmp_path, made)
    run(Announcement.of("cup", "tls/127.0.0.1:7003", tmp_path / HOST_FILE))
    run(FRIENDLY)
    found = find_host("cup" if connect is None else None, connect)
    assert found.endpoint == (connect or "tls/127.0.0.1:7003")
    for account in Account:
        credentials = found.credentials_of(account)
        assert credentials is not None and credentials.password == made.passwords[account]


def test_a_host_without_credentials_and_one_that_is_not_announced_give_none(run):
    run(FRIENDLY)
    for connect in (None, "tcp/192.0.2.1:7001"):
        assert find_host(None, connect).credentials_of(Account.VIEWER) is None


def test_accounts_whose_file_was_given_away_are_joined_without_credentials(tmp_path, run):
    write_credentials(tmp_path, new_credentials())
    account_file(tmp_path, Account.CYAN).unlink()
    run(Announcement.of("cup", "tcp/127.0.0.1:7003", tmp_path / HOST_FILE))
    assert find_host(None).credentials_of(Account.CYAN) is None
