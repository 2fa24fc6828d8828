import io
import json
from dataclasses import replace
from pathlib import Path

from rich.console import Console

from coach_gateway.match.team_names import TeamNames
from schemas.messages.health import Health, RobotHealth
from schemas.messages.soccer.game import DisciplinaryRecord, GameEvent, GameState
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from touchline.launch.recording_outcome import RecordingOutcome
from touchline.launch.result import MatchResult
from touchline.launch.terminal.agent_faults import disturbance, missed_sights


def event(kind: EventKind, text: str) -> GameEvent:
    return GameEvent(
        tick=500, time=10.0, clock=9.5, kind=kind, rule=kind.value, side=Side.CYAN, robot="cyan3", text=text
    )


def result(recording: Path | None = Path("runs/a/match.mcap"), losses: dict[str, int] | None = None) -> MatchResult:
    score, cards = Score(cyan=2, magenta=1), {"cyan3": DisciplinaryRecord(yellow=1)}
    return MatchResult(
        GameState(tick=6000, time=120.0, phase=Phase.FULL_TIME, score=score, effective=80.0, robots=cards),
        duration_s=120.0,
        ticks=6000,
        events=(
            event(EventKind.GOAL, "goal by cyan3"),
            event(EventKind.STOP, "STOP; kick-off follows"),
            event(EventKind.FULL_TIME, "half 2 ends").replace(score=score),
        ),
        real_time_factor=6.0,
        wall_s=20.0,
        recording=RecordingOutcome(recording, losses or {}),
    )


def render(shown: MatchResult) -> str:
    out = io.StringIO()
    Console(file=out, width=100).print(shown.render())
    return out.getvalue()


def test_the_json_holds_everything_a_program_asks_for() -> None:
    content = json.loads(result().json())
    assert content.pop("events")[0] == {
        **{"tick": 500, "time": 10.0, "clock": 9.5, "kind": "goal", "rule": "goal", "side": "cyan"},
        **{"robot": "cyan3", "robots": [], "place": None, "score": None, "text": "goal by cyan3"},
        **{"measured": None, "limit": None, "unit": "", "card": None},
    }
    assert content == {
        "teams": {"cyan": "cyan", "magenta": "magenta"},
        "score": {"cyan": 2, "magenta": 1},
        "value": None,
        "halves": [{"cyan": 2, "magenta": 1}],
        "shoot_out": None,
        "cards": {"cyan3": {"yellow": 1, "red": 0}},
        "duration_s": 120.0,
        "effective_s": 80.0,
        "ticks": 6000,
        "real_time_factor": 6.0,
        "wall_s": 20.0,
        "recording": "runs/a/match.mcap",
        "recording_fault": None,
        "losses": {},
        "missed": {},
    }


def test_a_shoot_out_is_no_half() -> None:
    level = Score(cyan=1, magenta=1)
    ends = [event(kind, "ends").replace(score=level) for kind in (*[EventKind.HALF_TIME] * 2, EventKind.FULL_TIME)]
    state = result().state.replace(score=level, shoot_out=Score(cyan=3, magenta=2))
    assert replace(result(), state=state, events=tuple(ends)).halves == [level, level]


def test_a_match_without_recording_has_the_path_null() -> None:
    assert json.loads(result(recording=None).json())["recording"] is None


def test_the_picture_shows_score_goals_and_recording_and_leaves_stops_out() -> None:
    shown = render(result())
    assert "cyan 2 : 1 magenta" in shown
    assert "halves 2:1; ball in play 80.0 s; cyan3 1 yellow" in shown
    assert "goal by cyan3" in shown
    assert "kick-off follows" not in shown
    assert "recording  runs/a/match.mcap" in shown
    assert "did not reach" not in shown


def test_the_teams_names_are_those_of_the_match_file() -> None:
    goal = event(EventKind.GOAL, "goal, counts for cyan: last touched by cyan3")
    named = replace(result(), names=TeamNames("Lions", "NuBot"), events=(goal,))
    shown = render(named)
    assert "Lions 2 : 1 NuBot" in shown
    assert "Lions (cyan) – NuBot (magenta); halves" in shown
    assert "goal, counts for Lions: last touched by cyan3" in shown
    content = json.loads(named.json())
    assert content["teams"] == {"cyan": "Lions", "magenta": "NuBot"}
    assert content["events"][0]["text"] == goal.text  # for programs, which know sides


def test_losses_are_shown_when_there_are_any() -> None:
    shown = render(result(losses={"robot/cyan1/command": 2}))
    assert "messages that did not reach the host: {'robot/cyan1/command': 2}" in shown


def test_the_json_says_what_a_recording_misses() -> None:
    shown = replace(result(), recording=RecordingOutcome(None, {}, "the recording is lost"))
    content = json.loads(shown.json())
    assert (content["recording"], content["recording_fault"]) == (None, "the recording is lost")
    assert content["score"] == {"cyan": 2, "magenta": 1}


def test_sights_without_an_answer_are_counted_in_lockstep_alone() -> None:
    robots = {"cyan1": RobotHealth(missed=3), "cyan2": RobotHealth(), "magenta1": RobotHealth(missed=1)}
    health = Health(tick=9, time=0.18, pace="lockstep", real_time_factor=1.0, robots=robots)
    assert missed_sights(health) == {"cyan1": 3, "magenta1": 1}
    assert missed_sights(health.replace(pace="realtime")) == missed_sights(None) == {}
    assert json.loads(replace(result(), missed=missed_sights(health)).json())["missed"] == {"cyan1": 3, "magenta1": 1}
    assert disturbance(missed_sights(health)).endswith("sights without an answer: cyan1 3, magenta1 1")
    assert not disturbance({})


def test_what_people_have_written_into_an_event_is_shown_as_it_is() -> None:
    """A bracket in the name of who asked would be markup, and one that closes nothing the end of the command."""
    asked = event(EventKind.ACTION, "[/b] asks: stop [bold]now[0.1, 0.2]")
    shown = render(replace(result(Path("runs/[/a]/m.mcap")), events=(asked,)))
    assert "[/b] asks: stop [bold]now[0.1, 0.2]" in shown
    assert "runs/[/a]/m.mcap" in shown


def test_the_score_of_a_game_without_goals_is_shown_in_their_place() -> None:
    names = TeamNames(has_goals=False)
    shown = render(replace(result(), names=names, state=result().state.replace(value=0.953)))
    assert "score 0.953   120.0 s played" in shown and "2 : 1" not in shown and "halves" not in shown
