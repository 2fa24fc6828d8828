"""Files that are whole when they have their name."""

import stat
from pathlib import Path

import pytest

from runtime.process.whole_file import written_whole


def test_a_file_replaces_the_one_before_when_it_is_complete(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("before")
    with written_whole(path) as draft:
        draft.write_text("after")
        assert path.read_text() == "before"
    assert path.read_text() == "after"
    assert [file.name for file in tmp_path.iterdir()] == ["a.txt"]


def test_an_error_leaves_what_was_there_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("before")
    with pytest.raises(ZeroDivisionError), written_whole(path) as draft:
        draft.write_text("half")
        raise ZeroDivisionError
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("a.txt", "before")]


def test_a_private_file_is_its_owners_alone(tmp_path: Path) -> None:
    with written_whole(tmp_path / "a.txt", private=True) as draft:
        draft.write_text("secret")
    assert stat.S_IMODE((tmp_path / "a.txt").stat().st_mode) == 0o600


def test_without_replacing_the_first_of_two_writers_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    with pytest.raises(FileExistsError), written_whole(path, replace=False) as draft:
        draft.write_text("second")
        path.write_text("first")
    assert path.read_text() == "first"


def test_a_folder_is_written_whole_too(tmp_path: Path) -> None:
    with written_whole(tmp_path / "tables") as draft:
        draft.mkdir()
        (draft / "ball.csv").write_text("x")
    assert (tmp_path / "tables" / "ball.csv").read_text() == "x"
