"""`touchline health` of a running match and of a recording."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from recordings.container.key_selection import EVERYTHING
from recordings.recorder.part_sink import PartSink
from recordings.recorder.recorder import Recorder
from schemas.config.match_config import MatchConfig
from schemas.messages.health import AccountHealth, Health, RobotHealth, TeamRadio
from schemas.side import Side
from schemas.topics import HEALTH
from support.fake_host import FakeHost
from support.host_rig import TEAMS, HostRig
from support.in_process_bus import SharedState
from support.stepped_clock import SteppedClock
from support.terminal import Terminal
from touchline.commands.cli.command_line import app


class PlayingClock(SteppedClock):
    """The host publishes the next report whenever a client waits, and leaves after the last."""

    __slots__ = ("host", "reports")

    def sleep_until(self, moment: float) -> None:
        super().sleep_until(moment)
        report = next(self.reports, None)
        if report is None:
            self.host.close()
        else:
            self.host.put(HEALTH, report)


def report(tick: int) -> Health:
    cyan1 = RobotHealth(
        alive=True,
        answering=True,
        answers=tick,
        missed=4,
        sights=tick + 4,
        unanswered=4,
        late=2,
        lost_commands=3,
        radio_bytes=tick * 100,
        radio_refused=0,
        latencies=[0, 0, tick],
    )
    silent = RobotHealth(alive=True, missed=tick, fault="answers tick 0, the match is at 50; use sight.tick")
    return Health(
        tick=tick,
        time=tick * 0.02,
        pace="realtime",
        real_time_factor=1.0,
        robots={"cyan1": cyan1, "magenta1": silent},
        radio={Side.CYAN: TeamRadio(budget=2e5, busiest=5e4)},
        accounts={
            "cyan": AccountHealth(messages=tick, size=tick * 100),
            "magenta": AccountHealth(messages=5, size=500, dropped={"above the rate": 44}),
        },
        strangers={"robot/x/command": 7},
    )


@pytest.fixture
def host(terminal: Terminal) -> FakeHost:
    there = FakeHost(SharedState(), clock=SteppedClock(), in_threads=True)

    def make_clock() -> PlayingClock:
        clock = PlayingClock()
        clock.host, clock.reports = there, iter([report(50), report(100), report(200)])
        return clock

    return terminal.join(there, make_clock)


def touchline(*words: str) -> Result:
    return CliRunner().invoke(app, ["health", *words], prog_name="touchline")


def test_a_running_match_is_one_row_for_each_robot(host: FakeHost) -> None:
    result = touchline()
    assert result.exit_code == 0
    lines = result.stdout.splitlines()
    assert lines[0].startswith("0.0 s to 1.0 s, 50 ticks  realtime  ×1.00")
    cyan1 = next(line for line in lines if line.startswith("cyan1"))
    assert cyan1.split()[1:10] == ["answers", "54", "48", "2", "4", "0", "0", "1", "3"]
    assert next(line for line in lines if line.startswith("magenta1")).split()[1] == "silent"
    assert ["cyan", "50", "5.0", "0"] in [line.split() for line in lines]
    assert "magenta 5 0.5 44 above the rate" in [" ".join(line.split()) for line in lines]
    assert "magenta1: answers tick 0, the match is at 50; use sight.tick" in lines
    assert "radio cyan: busiest second 25 % of the budget" in lines
    assert "7 messages on robot/x/command, which is no robot's of this match" in lines


def test_without_a_terminal_there_are_no_escape_sequences(host: FakeHost) -> None:
    assert "\x1b" not in touchline().stdout


def test_as_json_it_is_one_object(host: FakeHost) -> None:
    shown = json.loads(touchline("--json").stdout)
    (cyan1, _) = shown["robots"]
    assert (cyan1["robot"], cyan1["on_time"], cyan1["late"], cyan1["missing"]) == ("cyan1", 48, 2, 4)
    assert cyan1["radio_share"] == pytest.approx(8 * 5000 / 1.0 / 2e5)


def test_watched_it_is_shown_with_every_report_until_the_host_leaves(host: FakeHost) -> None:
    result = touchline("--watch", "--json")
    assert [json.loads(line)["ticks"] for line in result.stdout.splitlines()] == [50, 100, 200]
    assert (result.exit_code, result.stderr) == (0, "the host is gone\n")


def test_options_of_a_recording_need_one_and_those_of_a_match_need_none(host: FakeHost) -> None:
    assert "give its file" in touchline("--from", "3").stderr
    assert "leave them out with a file" in touchline("some.mcap", "--watch").stderr


@pytest.fixture
def recording(tmp_path: Path) -> Path:
    """A match in real time, recorded from its host: cyan2 misses the sights after tick 50."""
    rig = HostRig(MatchConfig.model_validate({"seed": 7, "teams": TEAMS, "pace": "realtime"}))
    path, clock = tmp_path / "match.mcap", SteppedClock()
    sink = PartSink(path, clock)
    recorder = Recorder(rig.seat(), sink, name="recorder", sights=False, config=rig.config, selection=EVERYTHING)
    rig.idle.append(recorder.pump)
    rig.join_all()
    rig.begin()
    rig.ticks(50)
    rig.agents["cyan2"].frozen = True
    rig.ticks(50)
    rig.health()
    rig.ticks(10)
    recorder.pump()
    recorder.finish()
    rig.host.simulation.close()
    return path


def test_a_recording_has_the_counts_of_the_whole_match(recording: Path) -> None:
    shown = json.loads(touchline(str(recording), "--json").stdout)
    cyan1, cyan2, _ = shown["robots"]
    assert (shown["start"], shown["ticks"]) == (0.0, 101)
    assert (cyan1["on_time"], cyan1["missing"]) == (101, 0)
    assert (cyan2["on_time"], cyan2["missing"]) == (50, 51)


def test_a_stretch_of_a_recording_has_its_own_counts(recording: Path) -> None:
    shown = json.loads(touchline(str(recording), "--json", "--from", "1.3").stdout)
    cyan2 = shown["robots"][1]
    assert 0.9 < shown["start"] <= 1.3
    assert (cyan2["on_time"], cyan2["missing"]) == (0, shown["ticks"])


def test_a_stretch_without_a_report_is_refused(recording: Path) -> None:
    result = touchline(str(recording), "--from", "500")
    assert result.exit_code == 2
    assert "no report of the host's health after 500 s; reports come four times a second" in result.stderr
    assert "--from is 2 and --to is 1; give" in touchline(str(recording), "--from", "2", "--to", "1").stderr
