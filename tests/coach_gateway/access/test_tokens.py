"""Tokens outlast the process that made them, are for their owner's eyes alone, and stand for one role each."""

import json
import stat
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import astuple
from pathlib import Path
from typing import Any

import pytest

from coach_gateway.access.roles import TokenRole
from coach_gateway.access.tokens import Tokens, page_address, tokens_of
from schemas.errors import TouchlineError


def test_tokens_that_were_made_once_are_the_same_when_they_are_read(tmp_path: Path) -> None:
    file = tmp_path / "tokens.json"
    made = tokens_of(file)
    assert tokens_of(file) == made
    assert stat.S_IMODE(file.stat().st_mode) == 0o600


def test_two_that_make_the_same_file_at_once_have_the_same_tokens(tmp_path: Path) -> None:
    """As a page and a bridge that are started beside each other with one file."""
    file = tmp_path / "tokens.json"
    start = threading.Barrier(8)

    def make(_: int) -> Tokens:
        start.wait()
        return tokens_of(file)

    for _ in range(20):
        with ThreadPoolExecutor(8) as threads:
            made = list(threads.map(make, range(8)))
        assert len(set(made)) == 1
        assert [path.name for path in tmp_path.iterdir()] == ["tokens.json"]
        file.unlink()


def test_new_tokens_are_long_and_all_different() -> None:
    some = [token for _ in range(20) for token in astuple(Tokens.random())]
    assert len(set(some)) == 60
    assert min(map(len, some)) >= 22


@pytest.mark.parametrize("role", list(TokenRole))
def test_a_token_stands_for_its_role(role: TokenRole) -> None:
    tokens = Tokens.random()
    assert tokens.role_of(tokens.of(role)) is role


def test_an_unknown_token_has_no_role() -> None:
    tokens = Tokens("the-referee", "the-coach-1", "the-coach-2")
    for forged in ("the-refere", "the-referee ", "THE-REFEREE", "the-coach-", "ö", " ", "\ud800"):
        assert tokens.role_of(forged) is None


def test_a_token_stands_behind_the_sign_that_no_browser_sends() -> None:
    assert page_address("http://127.0.0.1:8080", "abc") == "http://127.0.0.1:8080/#token=abc"
    assert page_address("http://127.0.0.1:8080", "") == "http://127.0.0.1:8080/"


@pytest.mark.parametrize(
    ("content", "why"),
    [
        ("no json", "is not JSON; delete it"),
        ({}, "need a token each"),
        ([], "need a token each"),
        ({"referee": "short", "cyan": "long-enough-1", "magenta": "long-enough-2"}, "8 characters or longer"),
        ({"referee": "the-same-token", "cyan": "the-same-token", "magenta": "another-token"}, "all different"),
        ({"referee": 12345678, "cyan": "long-enough-1", "magenta": "long-enough-2"}, "need a token each"),
    ],
)
def test_a_file_that_holds_no_tokens_is_refused_with_what_to_do(content: Any, why: str, tmp_path: Path) -> None:
    file = tmp_path / "tokens.json"
    file.touch(0o600)
    file.write_text(content if isinstance(content, str) else json.dumps(content))
    with pytest.raises(TouchlineError, match=why):
        tokens_of(file)


def test_a_file_that_others_may_read_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "tokens.json"
    tokens_of(file)
    file.chmod(0o644)
    with pytest.raises(TouchlineError, match=r"may be read by others \(mode 644\); chmod 600"):
        tokens_of(file)


def test_a_place_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match=r"nowhere/tokens.json cannot be written \(No such file or directory\)"):
        tokens_of(tmp_path / "nowhere" / "tokens.json")
