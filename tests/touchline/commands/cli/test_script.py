"""The entry of the command line: what it does before any other module is imported."""

import io
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import touchline
from touchline.commands.cli import command_line
from touchline.commands.cli.script import put_current_directory_last

LIBRARY = str(Path(touchline.__file__).resolve().parents[1])


@pytest.mark.parametrize("entry", ["{here}", ""])
def test_the_current_directory_comes_last_on_the_module_path(
    entry: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    here = entry.format(here=tmp_path)
    path = [here, "/lib/python", LIBRARY, here]
    put_current_directory_last(path)
    assert path == ["/lib/python", LIBRARY, here]


def test_a_module_path_without_the_current_directory_stays_as_it_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    path = ["/lib/python", LIBRARY]
    put_current_directory_last(path)
    assert path == ["/lib/python", LIBRARY]


def test_a_checkout_that_is_the_current_directory_stays_first_and_later_processes_find_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(LIBRARY)
    monkeypatch.setenv("PYTHONPATH", "/lib/a")
    path = [LIBRARY, "/lib/python"]
    for _ in range(2):
        put_current_directory_last(path)
        assert path == [LIBRARY, "/lib/python"]
        assert os.environ["PYTHONPATH"] == f"{LIBRARY}:/lib/a"


def test_what_the_encoding_of_a_terminal_has_not_is_printed_as_a_question_mark(monkeypatch: pytest.MonkeyPatch) -> None:
    with io.TextIOWrapper(io.BytesIO(), encoding="latin-1", write_through=True) as out:
        monkeypatch.setattr(sys, "stdout", out)
        monkeypatch.setattr(command_line, "app", lambda prog_name: out.write(f"{prog_name}: München – Porto"))
        command_line.main()
        monkeypatch.undo()
        assert out.buffer.getvalue().decode("latin-1") == "touchline: München ? Porto"


@pytest.mark.processes
def test_ctrl_c_in_a_command_ends_its_process_without_a_word_and_with_the_status_of_sigint(tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text(
        "import signal, sys\n"
        "class Finder:\n"
        "    def find_spec(name, path=None, target=None):\n"
        "        if name == 'touchline.commands.topics':\n"
        "            signal.raise_signal(signal.SIGINT)\n"
        "sys.meta_path.insert(0, Finder)\n"
    )
    command = [sys.executable, "-m", "touchline", "topics"]
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (128 + signal.SIGINT, "", "")
