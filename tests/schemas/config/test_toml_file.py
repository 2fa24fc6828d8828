"""A file that cannot be read as TOML is one line."""

import os
from pathlib import Path

import pytest

from schemas.config.toml_file import read_tables
from schemas.errors import TouchlineError


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"x = ", "not TOML: Invalid value"),
        (b"x = \xff", "not TOML: 'utf-8' codec"),
        (b"x = " + b"[" * 20_000 + b"]" * 20_000, "not TOML: maximum recursion depth exceeded"),
        (b"x = " + b"9" * 100_000, "not TOML: Exceeds the limit"),
    ],
    ids=["no value", "no UTF-8", "nested", "digits"],
)
def test_a_file_that_is_no_toml_is_one_line_with_the_reason(tmp_path: Path, content: bytes, sentence: str) -> None:
    path = tmp_path / "match.toml"
    path.write_bytes(content)
    with pytest.raises(TouchlineError) as caught:
        read_tables(path, "a match file")
    assert str(caught.value).startswith(f"{path}: ")
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_pipe_is_refused_without_waiting_for_its_writer(tmp_path: Path) -> None:
    path = tmp_path / "match.toml"
    os.mkfifo(path)
    with pytest.raises(TouchlineError, match="a pipe or a device; give the path of a match file"):
        read_tables(path, "a match file")
