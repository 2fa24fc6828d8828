import errno
import re
import socket
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from coach_gateway.settings import BridgeOptions, GatewaySettings
from coach_gateway.web.settings import WebSettings
from recordings.recorder.settings import RecorderSettings
from robot_agent.process.settings import AgentSettings
from schemas.config.match_config import load_match
from schemas.config.settings import RecordOptions
from schemas.errors import TouchlineError, os_errors
from schemas.side import Side
from sim_host.server.settings import HostSettings
from support.stepped_clock import SteppedClock
from touchline.launch.processes.process_table import PROCESSES, Process, ProcessKind
from touchline.launch.processes.programs import MatchPlan, Page, check_robot_names, client_processes, host_process
from touchline.launch.run_folder import prepare_run

JOINED = {"connect": "tcp/127.0.0.1:7447", "match": "friendly"}


def plan(
    recording: Path | None = Path("match.mcap"), listen: str = "tcp/127.0.0.1:7447", **overrides: object
) -> MatchPlan:
    return MatchPlan(load_match(None, overrides), listen, Path("runs/one"), recording, launch_token="secret")


def by_name(plan: MatchPlan) -> dict[str, Process]:
    return {process.name: process for process in (host_process(plan), *client_processes(plan))}


def test_a_friendly_has_a_host_a_recorder_and_ten_agents() -> None:
    names = [process.name for process in (host_process(plan()), *client_processes(plan()))]
    assert names == ["host", "recorder", *(f"{side}{n}" for side in ("cyan", "magenta") for n in range(1, 6))]


FILES = ("credentials", "endpoint", "outcome", "result", "tokens")


@pytest.mark.parametrize("name", ["host", "recorder", "page", "bridges", *FILES])
def test_no_robot_is_called_as_another_process_or_a_file_of_the_match(name: str) -> None:
    """The supervisor knows processes by their names: such a robot took the host's place, and no match was played."""
    with pytest.raises(TouchlineError, match=f'a robot is named "{name}", as a process or a file of the match is'):
        check_robot_names(load_match(None, {"teams.magenta.robots": ["magenta1", name]}))
    check_robot_names(load_match(None))


def test_every_process_is_launched_with_a_settings_file_of_its_own_in_the_run_s_folder() -> None:
    for name, process in by_name(plan()).items():
        module = PROCESSES[process.kind].module
        assert process.command == (sys.executable, "-P", "-m", module, "--settings", f"runs/one/{name}.json")
        assert process.settings_file == Path(f"runs/one/{name}.json")


def test_the_settings_of_a_host_are_its_match_and_its_endpoint() -> None:
    host = by_name(plan(seed=7))["host"].settings
    assert isinstance(host, HostSettings)
    assert (host.config.seed, host.listen, host.insecure) == (7, "tcp/127.0.0.1:7447", False)
    assert (host.launch_token, host.announcement) == ("secret", Path("runs/one/endpoint.json"))
    open_host = by_name(plan(listen="tcp/0.0.0.0:7447"))["host"].settings
    assert isinstance(open_host, HostSettings) and open_host.insecure


def test_the_settings_of_an_agent_are_its_match_its_robot_and_its_brain() -> None:
    agent = by_name(plan())["magenta2"]
    assert agent.settings == AgentSettings(
        **JOINED,
        robot="magenta2",
        brain="robot_agent.teams.nubot:NuBot",
        launch_folder=Path.cwd(),
        recording=Path("match.mcap"),
        launch_token="secret",
    )
    assert agent.environment["TOUCHLINE_SIDE"] == "magenta"
    assert agent.environment["PYTHONHASHSEED"] == "0"
    assert agent.restarts == PROCESSES[ProcessKind.AGENT].restarts == 3


def test_a_team_in_one_process_has_the_name_of_its_side_and_all_robots() -> None:
    processes = by_name(plan(None, **{"teams.cyan": {"brain": "nubot", "process": "team"}}))
    assert list(processes) == ["host", "cyan", *(f"magenta{n}" for n in range(1, 6))]
    settings = processes["cyan"].settings
    assert isinstance(settings, AgentSettings)
    assert [settings.robot, *settings.mates] == [f"cyan{n}" for n in range(1, 6)]
    named = {"teams.cyan": {"brain": "nubot", "process": "team"}, "teams.magenta.robots": ["cyan"]}
    with pytest.raises(TouchlineError, match='a robot is named "cyan", as a process or a file of the match is'):
        check_robot_names(load_match(None, named))


def test_agents_reload_code_in_a_match_that_does() -> None:
    settings = by_name(replace(plan(), reload=True))["cyan1"].settings
    assert isinstance(settings, AgentSettings) and settings.reload


def test_a_team_with_a_command_gets_its_robot_in_environment_variables() -> None:
    agent = by_name(plan(**{"teams.cyan.command": ["./robot", "--fast"], "teams.cyan.size": 1}))["cyan1"]
    assert agent.command == (f"{Path.cwd()}/robot", "--fast")
    assert agent.settings is None
    assert {
        key: agent.environment[f"TOUCHLINE_{key}"] for key in ("CONNECT", "MATCH", "ROBOT", "SIDE", "LAUNCH_TOKEN")
    } == {
        "CONNECT": "tcp/127.0.0.1:7447",
        "MATCH": "friendly",
        "ROBOT": "cyan1",
        "SIDE": "cyan",
        "LAUNCH_TOKEN": "secret",
    }


def test_a_page_is_launched_where_one_is_wanted_with_its_tokens_in_a_file() -> None:
    assert "page" not in by_name(plan())
    web = WebSettings(port=8081)
    with socket.socket() as listener:
        page = by_name(replace(plan(), page=Page(web, listener)))["page"]
    assert page.sockets == (listener,)
    result = Path("runs/one/result")
    assert page.settings == GatewaySettings(**JOINED, tokens=Path("runs/one/tokens.json"), web=web, result=result)
    assert page.restarts == 3


def test_bridges_are_launched_where_they_are_wanted_with_the_options_that_were_given() -> None:
    assert "bridges" not in by_name(plan())
    options = BridgeOptions(udp=28090, refbox_server=["cyan:28097"], refbox="10.0.0.2", team=[Side.MAGENTA])
    bridges = by_name(replace(plan(), bridges=options))["bridges"]
    assert bridges.settings == GatewaySettings(**JOINED, tokens=Path("runs/one/tokens.json"), bridges=options)
    assert bridges.restarts == 3


def test_no_recorder_is_launched_when_no_recording_is_wanted() -> None:
    assert "recorder" not in by_name(plan(recording=None))


def test_the_settings_of_a_recorder_have_the_record_options_of_the_match_file() -> None:
    wanted = {"include": ["world"], "part_duration": 60.0, "sights": True, "viz": False}
    planned = plan(**{f"record.{key}": value for key, value in wanted.items()})
    written = by_name(planned)["recorder"].settings
    assert isinstance(written, RecorderSettings)
    recorder = RecorderSettings.model_validate_json(written.model_dump_json())
    assert recorder.record == RecordOptions.model_validate(wanted)
    assert (recorder.out, recorder.config) == (Path("match.mcap"), planned.config)


@pytest.mark.parametrize(
    ("listen", "connect"),
    [
        ("tcp/0.0.0.0:7447", "tcp/127.0.0.1:7447"),
        ("tcp/[::]:7447", "tcp/[::1]:7447"),
        ("tcp/[fe80::1]:7447", "tcp/[fe80::1]:7447"),
        ("tls/10.0.0.5:7000", "tls/10.0.0.5:7000"),
    ],
)
def test_a_host_on_every_address_is_reached_by_loopback(listen: str, connect: str) -> None:
    assert plan(listen=listen).connect == connect


def test_two_runs_of_one_second_get_different_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    clock = SteppedClock()
    config = load_match(None, {"seed": 7})
    first, second = (prepare_run(config, "tcp/127.0.0.1:7447", None, clock) for _ in range(2))
    assert [str(run.folder) for run in (first, second)] == [
        "runs/friendly-19700101T000000Z-seed7",
        "runs/friendly-19700101T000000Z-seed7-2",
    ]
    assert first.recording == first.folder / "match.mcap"


def test_a_fault_of_the_system_that_names_no_file_is_one_of_a_file() -> None:
    fault = "a file: No space left on device; host needs it"
    with pytest.raises(TouchlineError, match=fault), os_errors(None, "host needs it"):
        raise OSError(errno.ENOSPC, "No space left on device")


def test_a_link_to_a_disk_that_is_not_there_is_no_folder_for_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("runs").symlink_to("/nonexistent/disk")
    with pytest.raises(TouchlineError, match="runs: File exists; a match writes its logs"):
        prepare_run(load_match(None), None, None, SteppedClock())


def test_a_recording_goes_into_a_folder_that_exists(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("finals").mkdir()
    run = prepare_run(load_match(None), "tcp/127.0.0.1:7447", Path("finals/a.mcap"), SteppedClock())
    assert (run.recording, run.warning) == (Path("finals/a.mcap"), "")


def test_a_folder_that_does_not_exist_is_not_made_for_a_recording_but_the_command_that_makes_it_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    run = prepare_run(load_match(None), "tcp/127.0.0.1:7447", Path("final/s/a.mcap"), SteppedClock())
    assert run.recording == run.folder / "match.mcap"
    assert run.warning == (
        "--record final/s/a.mcap: the folder final/s does not exist; make it with: mkdir -p final/s. "
        f"The match is played, its recording goes to {run.recording}"
    )
    assert not Path("final").exists()


def test_a_recording_that_cannot_be_written_goes_into_the_folder_of_the_run_with_a_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("file").write_text("")
    played = "The match is played, its recording goes to runs/"
    for path, why in (
        (Path("file/a.mcap"), "Not a directory; give a path that can be written"),
        (tmp_path, "is a folder; name another file, or move that one away"),
    ):
        run = prepare_run(load_match(None), "tcp/127.0.0.1:7447", path, SteppedClock())
        assert run.recording == run.folder / "match.mcap"
        assert re.search(rf"--record .*: {why}. {played}", run.warning)


def test_a_recording_that_is_there_is_left_as_it_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    other = Path("a.mcap")
    other.write_bytes(b"another one's")
    run = prepare_run(load_match(None), "tcp/127.0.0.1:7447", Path("a.mcap"), SteppedClock())
    assert run.recording == run.folder / "match.mcap"
    assert "--record a.mcap: already exists; name another file, or move that one away. The match is" in run.warning
    assert other.read_bytes() == b"another one's"


def test_a_run_without_recording_has_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert prepare_run(load_match(None), "tcp/127.0.0.1:7447", None, SteppedClock(), recorded=False).recording is None


def test_a_team_of_lines_has_agents_with_its_command_line_for_any_working_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "team").mkdir()
    (tmp_path / "team" / "robot.js").touch()
    whole = replace(plan(**{"teams.cyan": {"stdio": ["node", "robot.js", "--fast"]}}), brain_folder=Path("team"))
    settings = by_name(whole)["cyan1"].settings
    assert isinstance(settings, AgentSettings)
    assert settings.stdio == ["node", str(tmp_path / "team" / "robot.js"), "--fast"]
    assert settings.brain == ""
