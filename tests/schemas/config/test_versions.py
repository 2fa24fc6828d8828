"""The numbers of a shipped profile or rule book do not change without its version.

A recording names the version of the numbers of its match. When the numbers that a file has in the end, its own and
those of the files that it extends, are changed, `version` in the file is raised, and its row in `DIGESTS` replaced.
"""

import dataclasses
from hashlib import blake2b
from typing import Any

import pytest

from schemas.config import profile
from schemas.config.number_files import UNVERSIONED, versioned_name
from schemas.config.profile import load_profile
from schemas.config.soccer import rule_book
from schemas.config.soccer.rule_book import load_rule_book
from schemas.errors import TouchlineError

DIGESTS = {
    "profiles/differential": (1, "703bf9aef137"),
    "profiles/ideal": (2, "6f1cfd502acd"),
    "profiles/msl": (2, "cee9e941c4a0"),
    "profiles/msl-2016": (2, "1391972edd03"),
    "profiles/omni": (2, "2345a23e6588"),
    "profiles/omni3": (2, "995fc77669b8"),
    "profiles/paper": (2, "47d6fb98f5b5"),
    "rule_books/china-sim-2020": (1, "6edb07c8fe42"),
    "rule_books/eleven": (1, "13f46d6e9018"),
    "rule_books/friendly": (1, "b6ae2b5b41fe"),
    "rule_books/msl": (1, "d9b7545cc2b5"),
    "rule_books/msl-2016": (1, "8951eb2ea616"),
    "rule_books/msl-2019": (1, "8951eb2ea616"),
    "rule_books/paper": (1, "f7fcfc8be002"),
}
"""File → its version, and a digest of its numbers."""


def values_of(tables: dict[str, Any]) -> dict[str, Any]:
    """The value of each number, by the names of its tables; origins are prose, and do not count."""
    found = {}
    for key, table in tables.items():
        if isinstance(table, dict):
            inner = {"": table["value"]} if "value" in table else values_of(table)
            found |= {f"{key}.{name}".rstrip("."): value for name, value in inner.items()}
    return found


def digest(tables: dict[str, Any]) -> str:
    text = "\n".join(f"{key}={value!r}" for key, value in sorted(values_of(tables).items()))
    return blake2b(text.encode(), digest_size=6).hexdigest()


def shipped() -> dict[str, tuple[int, str]]:
    found = {}
    for files in (profile.FILES, rule_book.FILES):
        for name in files.shipped:
            tables = files.tables(name)
            found[f"{files.folder}/{name}"] = (tables["version"], digest(tables))
    return found


@pytest.mark.parametrize("file", shipped())
def test_numbers_do_not_change_without_their_version(file: str) -> None:
    version, numbers = shipped()[file]
    known_version, known_numbers = DIGESTS.get(file, (0, ""))
    row = f'"{file}": ({max(version, known_version + (numbers != known_numbers))}, "{numbers}"),'
    assert numbers == known_numbers, (
        f"the numbers of {file} have changed: raise `version` in schemas/{file}.toml, and write {row} here"
    )
    assert version == known_version, f"write {row} here"


def test_no_row_is_left_of_a_file_that_is_gone() -> None:
    assert set(DIGESTS) == set(shipped())


def test_every_number_counts_and_no_origin_does() -> None:
    tables = rule_book.FILES.tables("msl")
    before = digest(tables)
    tables["restarts"]["time_limit"]["origin"] = "another book"
    assert digest(tables) == before
    tables["restarts"]["time_limit"]["value"] = 8.0
    assert digest(tables) != before
    numbers = sum(len(dataclasses.fields(section)) for section in rule_book.SECTIONS.values())
    assert len(values_of(tables)) == numbers


def test_a_file_of_ones_own_has_its_own_version_or_none(tmp_path: Any) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('extends = "msl"\n')
    assert load_rule_book(str(path)).version == load_profile(str(path)).version == UNVERSIONED
    path.write_text('extends = "msl"\nversion = 4\n')
    assert load_rule_book(str(path)).version == load_profile(str(path)).version == 4
    assert versioned_name("mine.toml", 4) == "mine.toml (version 4)"
    assert versioned_name("mine.toml", UNVERSIONED) == "mine.toml"


@pytest.mark.parametrize("version", ["0", "-1", "1.5", '"2"', "true"])
def test_a_version_is_a_whole_number_from_1(tmp_path: Any, version: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(f'extends = "msl"\nversion = {version}\n')
    for load in (load_rule_book, load_profile):
        with pytest.raises(TouchlineError, match=r"mine\.toml: version is .*; write a whole number from 1$"):
            load(str(path))


def test_a_rule_book_of_ones_own_names_what_is_wrong(tmp_path: Any) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('extends = "msl"\n[restart]\n')
    with pytest.raises(TouchlineError, match=r'mine\.toml: section \[restart\] is not known; did you mean "restarts"'):
        load_rule_book(str(path))
    with pytest.raises(TouchlineError, match=r'rules is "gone\.toml": No such file or directory; give one of'):
        load_rule_book("gone.toml")
