"""Settings of a process: written for it, read from a file or from standard input, refused in one line."""

import io
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from coach_gateway.settings import BridgeOptions, GatewaySettings
from coach_gateway.web.settings import WebSettings
from recordings.recorder.settings import RecorderSettings
from robot_agent.process.settings import AgentSettings
from runtime.bus.settings import ListenSettings
from runtime.process.settings_file import read_settings, run_process, write_settings
from schemas.config.match_config import MatchConfig
from schemas.config.settings import RecordOptions, Settings
from schemas.errors import TouchlineError
from schemas.side import Side
from sim_host.server.settings import HostSettings

EXAMPLES: dict[str, Settings] = {
    "sim_host": HostSettings(config=MatchConfig(seed=7), listen="tcp/0.0.0.0:7447", insecure=True),
    "robot_agent": AgentSettings(robot="cyan1", brain="my_team:Brain", patience=2.5),
    "recordings": RecorderSettings(
        out=Path("final.mcap"), record=RecordOptions(include=["world"], part_size=5), config=MatchConfig()
    ),
    "coach_gateway": GatewaySettings(
        tokens=Path("tokens.json"),
        web=WebSettings(port=0),
        bridges=BridgeOptions(udp=0, team=[Side.CYAN], refbox="box"),
    ),
}
"""Module → settings that it may be started with."""


@pytest.mark.parametrize("module", EXAMPLES)
def test_settings_that_are_written_are_read_again_also_from_standard_input(
    module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "settings.json"
    write_settings(EXAMPLES[module], file)
    assert read_settings(type(EXAMPLES[module]), str(file)) == EXAMPLES[module]
    monkeypatch.setattr(sys, "stdin", io.StringIO(file.read_text()))
    assert read_settings(type(EXAMPLES[module]), "-") == EXAMPLES[module]


def test_a_path_that_is_no_utf_8_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match=r"is no UTF-8; rename that \(.*'\\udcff'"):
        write_settings(RecorderSettings(out=tmp_path / "\udcff.mcap"), tmp_path / "settings.json")


def test_a_settings_file_is_for_its_owner_alone(tmp_path: Path) -> None:
    file = tmp_path / "settings.json"
    file.touch(0o644)
    write_settings(EXAMPLES["robot_agent"], file)
    assert file.stat().st_mode & 0o777 == 0o600


WRONG: dict[str, tuple[type[Settings], object, str]] = {
    "a field that is not known": (WebSettings, {"prot": 80}, 'prot is not known; did you mean "port"?'),
    "a field that is missing": (AgentSettings, {"brain": "a:B"}, "robot is missing"),
    "a name that is none": (AgentSettings, {"robot": "Cyan 1", "brain": "a:B"}, "robot is 'Cyan 1'; text of the form"),
    "an endpoint that is none": (ListenSettings, {"listen": "here"}, "listen is 'here'; write it as tcp/"),
    "a match that is none": (RecorderSettings, {"match": "a/*", "out": "a"}, "match is 'a/*'; a match name is"),
    "text for a number": (WebSettings, {"port": "80"}, "port is '80'; a whole number"),
    "a number beyond its limits": (WebSettings, {"port": 70000}, "port is 70000; at most 65535"),
    "a field of a part": (
        RecorderSettings,
        {"out": "a", "record": {"sight": True}},
        "record.sight is not known; did you mean",
    ),
    "a key of the match": (HostSettings, {"config": {"seed": -1}}, "config.seed is -1; at least 0"),
    "a list": (ListenSettings, [], "not settings; write a JSON object of listen, credentials, insecure"),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_settings_are_reported_with_file_field_value_and_expectation(case: str, tmp_path: Path) -> None:
    model, content, words = WRONG[case]
    file = tmp_path / "wrong.json"
    file.write_text(json.dumps(content))
    with pytest.raises(TouchlineError) as raised:
        read_settings(model, str(file))
    assert str(raised.value).startswith(f"{file}: ")
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match=r"--settings .*/no\.json: No such file or directory; give the path"):
        read_settings(AgentSettings, str(tmp_path / "no.json"))
    (tmp_path / "half.json").write_text('{"robot": ')
    with pytest.raises(TouchlineError, match=r"half\.json: not JSON: "):
        read_settings(AgentSettings, str(tmp_path / "half.json"))


def run_with(arguments: list[str], run: Any) -> int:
    return run_process("robot_agent", AgentSettings, run, arguments)


def test_a_process_runs_with_its_settings_and_has_their_exit_status(tmp_path: Path) -> None:
    file, seen = tmp_path / "settings.json", []
    write_settings(EXAMPLES["robot_agent"], file)
    assert run_with(["--settings", str(file)], lambda settings: seen.append(settings) or 3) == 3
    assert seen == [EXAMPLES["robot_agent"]]


def test_what_a_person_can_mend_is_one_line_and_status_2(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    def run(settings: AgentSettings) -> int:
        raise TouchlineError(f"{settings.brain} is not there")

    file = tmp_path / "settings.json"
    write_settings(EXAMPLES["robot_agent"], file)
    assert run_with(["--settings", str(file)], run) == 2
    assert run_with(["--settings", str(tmp_path / "no.json")], run) == 2
    first, second = capsys.readouterr().err.splitlines()
    assert first == "touchline: my_team:Brain is not there"
    assert "No such file" in second


@pytest.mark.processes
@pytest.mark.parametrize("module", EXAMPLES)
def test_each_kind_of_process_reads_its_settings_and_refuses_wrong_ones(module: str) -> None:
    ended = subprocess.run(
        [sys.executable, "-m", module, "--settings", "-"],
        input='{"log_format": "loud"}',
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert (ended.returncode, ended.stdout) == (2, "")
    (line,) = ended.stderr.splitlines()
    assert line.startswith("touchline: standard input: ")
    assert "log_format is 'loud'" in line


@pytest.mark.parametrize("module", EXAMPLES)
def test_what_runs_a_process_is_imported_without_anything_heavy(module: str) -> None:
    code = f"import sys; from {module} import run; print(*{{'zenoh', 'pybullet', 'mcap', 'numpy'}} & set(sys.modules))"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.split() == []
