import os
from pathlib import Path

import pytest

import touchline
from touchline.launch.processes.python_process import module_path_environment

LIBRARY = Path(touchline.__file__).resolve().parents[1]


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        ("/lib/a:/lib/b", None),
        ("", None),
        (":/lib/a", "/lib/a"),
        ("/lib/a:", "/lib/a"),
        (".:/lib/a", "/lib/a"),
        ("{here}:/lib/a:{here}", "/lib/a"),
        ("{here}/below", None),
    ],
)
def test_a_process_does_not_inherit_the_current_directory_by_pythonpath(
    given: str, kept: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", given.replace(":", os.pathsep).format(here=tmp_path))
    assert module_path_environment().get("PYTHONPATH") == kept


def test_the_checkout_of_this_library_stays_on_pythonpath(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(LIBRARY)
    monkeypatch.setenv("PYTHONPATH", str(LIBRARY))
    assert module_path_environment() == {}
