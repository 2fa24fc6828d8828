"""Names of a recording's numbered files: which belong to it and in what order."""

from pathlib import Path

import pytest

from recordings.container.numbering import (
    check_free,
    files_at,
    numbered,
    numbered_files,
    unfinished_at,
    unfinished_files,
)
from schemas.errors import TouchlineError


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "final.mcap"


def made(*files: Path) -> list[Path]:
    for file in files:
        file.touch()
    return list(files)


def test_a_recording_is_its_file_where_there_is_one_and_else_its_numbered_files(path):
    assert files_at(path) == unfinished_at(path) == []
    parts = made(numbered(path, 2), numbered(path, 1))
    assert files_at(path) == parts[::-1] == numbered_files(path)
    made(path)
    assert files_at(path) == [path]


def test_unfinished_files_are_those_named_part(path):
    parts = made(*(file.with_name(file.name + ".part") for file in (numbered(path, 1), numbered(path, 2))))
    made(numbered(path, 3))
    assert unfinished_files(path) == unfinished_at(path) == parts
    (whole,) = made(path.with_name("final.mcap.part"))
    assert unfinished_at(path) == [whole]
    assert numbered_files(path) == [numbered(path, 3)]


def test_files_are_in_the_order_of_their_numbers_beyond_ten_thousand_too(path):
    assert numbered(path, 7).name == "final.0007.mcap"
    files = made(*(numbered(path, number) for number in (9999, 10000, 10001)))
    assert numbered_files(path) == files


def test_files_of_other_names_are_not_this_recording_s(path):
    made(
        *(
            path.with_name(name)
            for name in ("final.001.mcap", "final.0001.mcapx", "semifinal.0001.mcap", "finalx0001.mcap")
        )
    )
    assert numbered_files(path) == []
    check_free(path)
    made(numbered(path, 4))
    with pytest.raises(TouchlineError, match=r"final\.0004\.mcap: already exists"):
        check_free(path)


def test_a_recording_in_no_folder_has_no_files(path):
    assert numbered_files(path.parent / "none" / "final.mcap") == []
