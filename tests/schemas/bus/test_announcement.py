"""Announcements of running hosts, and what clients without an endpoint make of them."""

import os
from contextlib import ExitStack

import pytest

from schemas.bus.announcement import Announcement, announced, announced_to_user, announcement_in, running_hosts
from schemas.bus.endpoint import DEFAULT_ENDPOINT
from schemas.bus.find_host import find_host
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
    killed.write_text(FRIENDLY.model_dump_json())
    assert running_hosts() == [CUP]
    assert not killed.exists()


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
