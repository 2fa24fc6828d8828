"""Files of credentials: who may read them, what is in them, and what is wrong with others."""

import json
import os
import stat
from pathlib import Path

import pytest

from runtime.access.accounts import Account
from runtime.access.certificates import make_certificate
from runtime.access.credentials import (
    HOST_FILE,
    account_file,
    credential_files,
    new_credentials,
    read_credentials,
    read_host_credentials,
    write_credentials,
)
from runtime.access.protection import Protection, robots_of
from schemas.config.match_config import MatchConfig, load_match
from schemas.errors import TouchlineError
from schemas.side import Side


def test_each_file_is_for_its_owner_alone_also_where_another_was_before(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "credentials"
    for _ in range(2):
        write_credentials(folder, new_credentials())
        assert stat.S_IMODE(folder.stat().st_mode) == 0o700
        assert sorted(folder.iterdir()) == sorted(credential_files(folder))
        assert {stat.S_IMODE(path.stat().st_mode) for path in folder.iterdir()} == {0o600}
        account_file(folder, Account.CYAN).chmod(0o644)


def test_an_account_s_file_has_its_own_password_and_no_other(tmp_path: Path) -> None:
    made = new_credentials("cup", make_certificate(["sim.example"]))
    write_credentials(tmp_path, made, "tls/sim.example:7447")
    assert len(set(made.passwords.values())) == len(Account)
    assert made.certificate is not None
    for account in Account:
        own = read_credentials(account_file(tmp_path, account))
        assert (own.user, own.password, own.match) == (account, made.passwords[account], "cup")
        assert (own.root_certificate, own.connect) == (made.certificate.root, "tls/sim.example:7447")
        text = account_file(tmp_path, account).read_text()
        assert not [word for other, word in made.passwords.items() if other is not account and word in text]
        assert "PRIVATE KEY" not in text
    assert read_host_credentials(tmp_path / HOST_FILE) == made


def test_a_password_has_256_random_bits_and_is_in_no_representation() -> None:
    first, second = new_credentials(), new_credentials()
    words = {*first.passwords.values(), *second.passwords.values()}
    assert len(words) == 2 * len(Account) and min(map(len, words)) >= 43
    account = first.of(Account.CYAN)
    shown = f"{first!r} {first} {account!r} {account} {make_certificate()!r}"
    assert not [word for word in words if word in shown] and "PRIVATE" not in shown


WRONG = {
    "missing": (None, "No such file or directory"),
    "no JSON": ("{", "not JSON"),
    "a list": ("[]", "not an account's file"),
    "the host's": (json.dumps({"passwords": {}}), "not an account's file"),
    "an unknown user": (json.dumps({"user": "green", "password": "x" * 20}), "user"),
    "a short password": (json.dumps({"user": "cyan", "password": "secret"}), "password"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_file_is_one_line_with_the_remedy_and_without_the_password(case: str, tmp_path: Path) -> None:
    text, words = WRONG[case]
    path = tmp_path / "cyan.json"
    if text is not None:
        path.touch(0o600)
        path.write_text(text)
    with pytest.raises(TouchlineError) as error:
        read_credentials(path)
    line = str(error.value)
    assert words in line and str(path) in line and "\n" not in line and "secret" not in line


@pytest.mark.parametrize("mode", [0o644, 0o640, 0o604, 0o620, 0o602])
def test_a_file_that_other_users_may_read_or_change_is_refused_with_its_mode_and_the_remedy(
    mode: int, tmp_path: Path
) -> None:
    write_credentials(tmp_path, new_credentials())
    for name, read in (("cyan.json", read_credentials), (HOST_FILE, read_host_credentials)):
        path = tmp_path / name
        path.chmod(mode)
        with pytest.raises(TouchlineError) as error:
            read(path)
        assert str(error.value) == f"--credentials {path} may be read by others (mode {mode:o}); chmod 600 {path}"
        path.chmod(0o400)
        read(path)


@pytest.mark.skipif(os.geteuid() != 0, reason="root alone can give a file to another user")
def test_a_file_of_another_user_is_read_as_ssh_reads_it(tmp_path: Path) -> None:
    """Secrets that are mounted into a container are files of root that a group may read."""
    write_credentials(tmp_path, new_credentials())
    path = account_file(tmp_path, Account.CYAN)
    os.chown(path, 65534, 65534)
    path.chmod(0o444)
    assert read_credentials(path).user is Account.CYAN


def test_a_host_needs_the_passwords_of_all_accounts(tmp_path: Path) -> None:
    made = new_credentials()
    content = json.loads(made.model_dump_json())
    del content["passwords"]["viewer"]
    path = tmp_path / HOST_FILE
    path.touch(0o600)
    path.write_text(json.dumps(content))
    with pytest.raises(TouchlineError, match="no password for viewer"):
        read_host_credentials(path)


def test_a_match_without_a_file_is_unprotected_and_one_of_another_match_is_refused(tmp_path: Path) -> None:
    config = MatchConfig()
    assert Protection.from_file(None, config) is None
    write_credentials(tmp_path, new_credentials("final"))
    with pytest.raises(TouchlineError, match='for the match "final", not for "friendly"'):
        Protection.from_file(tmp_path / HOST_FILE, config)


def test_robots_that_a_scene_may_add_are_their_side_s_unless_the_other_side_has_the_name() -> None:
    config = load_match(None, {"teams.magenta.robots": ["cyan7", "m2"], "teams.magenta.size": 2})
    robots = robots_of(config)
    assert robots[Side.MAGENTA][:3] == ["cyan7", "m2", "magenta1"]
    assert "cyan7" not in robots[Side.CYAN] and {"cyan1", "cyan11"} <= set(robots[Side.CYAN])
    assert not set(robots[Side.CYAN]) & set(robots[Side.MAGENTA])
