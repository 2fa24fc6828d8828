"""`breakpoint()` in a robot's process, and in a match in one process."""

import io
import sys
from pathlib import Path

import pytest

from robot_agent.process.breakpoints import skip_breakpoints
from robot_agent.process.settings import AgentSettings
from robot_agent.sdk.contract import Briefing
from robot_agent.teams.simple import Simple
from schemas.config.match_config import load_match
from support.stepped_clock import SteppedClock
from touchline.play.play_match import play_match


@pytest.fixture
def settings() -> AgentSettings:
    return AgentSettings(match="m", robot="cyan2", brain="my:Brain", recording=Path("runs/one/match.mcap"))


@pytest.fixture
def clock() -> SteppedClock:
    return SteppedClock()


@pytest.fixture(autouse=True)
def no_terminal(monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO())
    monkeypatch.setattr(sys, "breakpointhook", sys.breakpointhook)
    monkeypatch.delenv("PYTHONBREAKPOINT", raising=False)


def stop():
    breakpoint()
    return True


def test_a_breakpoint_is_skipped_and_reported_once_a_line_with_the_command_that_stops_there(settings, clock, capsys):
    skipped = skip_breakpoints(settings, clock)
    skipped.tick_s = 0.02
    for tick in (812, 813):
        clock.sim_ns = tick * 20_000_000
        assert stop()
    (line,) = capsys.readouterr().err.splitlines()
    place = Path(__file__).relative_to(Path.cwd())
    assert line == (
        f"note: breakpoint() at {place}, line {stop.__code__.co_firstlineno + 1}, was skipped: cyan2 has no terminal; "
        "to stop there: touchline replay runs/one/match.mcap --agent cyan2=my:Brain --from tick:812 --pdb"
    )


def test_before_the_first_sight_the_command_begins_at_the_beginning(settings, clock, capsys):
    skip_breakpoints(settings, clock)
    stop()
    assert capsys.readouterr().err.endswith("--agent cyan2=my:Brain --pdb\n")


def test_a_brain_beside_its_match_file_and_no_recording_are_part_of_the_command(settings, clock, tmp_path, capsys):
    away = settings.model_copy(
        update={"recording": None, "launch_folder": tmp_path, "brain_folder": tmp_path / "my matches"}
    )
    skip_breakpoints(away, clock)
    stop()
    words = "touchline replay RECORDING.mcap --agent cyan2=my:Brain --brain-folder 'my matches' --pdb"
    assert capsys.readouterr().err.endswith(f"{words}\n")


def test_at_a_terminal_breakpoints_work(settings, clock, monkeypatch):
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True)
    before = sys.breakpointhook
    assert skip_breakpoints(settings, clock) is None
    assert sys.breakpointhook is before


def test_a_debugger_of_the_users_choice_is_kept(settings, clock, monkeypatch):
    monkeypatch.setenv("PYTHONBREAKPOINT", "0")
    before = sys.breakpointhook
    assert skip_breakpoints(settings, clock) is None
    assert sys.breakpointhook is before


def test_in_a_match_in_one_process_breakpoints_work(setup, monkeypatch):
    stopped = []
    monkeypatch.setattr(sys, "breakpointhook", lambda: stopped.append(1))

    class Stops(Simple):
        def act(self, sight):
            stop()
            return super().act(sight)

    brain = Stops(Briefing.of("cyan2", setup))
    teams = {f"teams.{side}": {"size": 2} for side in ("cyan", "magenta")}
    play_match(load_match(None, {"seed": 1, **teams}), {"cyan2": brain}, until=0.2)
    assert len(stopped) == 10
