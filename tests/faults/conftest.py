"""A match for the faults of a file, all of which end well."""

from collections.abc import Iterator

import pytest

from support.faulty_match import CYAN, Match
from support.machines import machines


@pytest.fixture(scope="module")
def match(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Match]:
    """Five robots on the machine `cyan`, one on the machine `magenta`."""
    names = ("host", "cyan", "magenta", "coach")
    with machines(names, tmp_path_factory.mktemp("match"), **{"teams.cyan.robots": list(CYAN)}) as field:
        yield Match(field)
