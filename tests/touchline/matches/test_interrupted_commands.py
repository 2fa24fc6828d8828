"""Commands that play many matches: Ctrl-C ends each with its own words, and with the status of SIGINT."""

import signal
from pathlib import Path
from typing import Never

import pytest
from typer.testing import CliRunner

from touchline.commands.cli.command_line import app
from touchline.matches.engine.fresh_process import FreshProcesses

COMMANDS = {
    "task run keepaway_3v2 --seeds 1-2": "2 not played",
    "drill one_against_keeper --seeds 1-2": "2 not played",
    "series --seeds 1-2": "0 of 2 matches, 2 not played",
    "experiment studies/sides.toml --out out": "interrupted; the matches played so far are in out: run it again",
    "tournament matches/cup.toml --out out": "interrupted; --resume goes on with the matches that are missing in out",
}


@pytest.mark.parametrize("words", COMMANDS)
def test_an_interrupted_command_says_what_is_missing(
    words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> Never:
        raise KeyboardInterrupt

    monkeypatch.setattr(FreshProcesses, "submit", interrupted)
    files = [str(Path(word).resolve()) if word.endswith(".toml") else word for word in words.split()]
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, files)
    assert COMMANDS[words] in result.output
    assert result.exit_code == 128 + signal.SIGINT
