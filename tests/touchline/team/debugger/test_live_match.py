"""A recorded match that goes on live from one tick."""

import json
import os
import re
import sys
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.errors import MatchFailedError
from schemas.topics import APPLIED
from support.free_match import SCORE, free_match, record_free_match
from support.process_story import descendants, is_running
from touchline.team.debugger.agent_replay import AgentReplay
from touchline.team.debugger.live_match import LiveMatch
from touchline.verify.compare_brain import compare_brain
from touchline.verify.resimulate import verify

SIMPLE = "robot_agent.teams.simple:Simple"


def live_chain(recording, spec, start, end):
    """The hash chain at the end of a live match, and its notes."""
    chains = []
    match = LiveMatch(recording, "cyan2", spec)
    match.play(start, end, lambda tick: chains.append(tick.applied["chain"]))
    match.close()
    return chains[-1], match.notes


def recorded_chain(recording, time):
    return next(applied.chain for _, applied in recording.decoded(APPLIED.key) if applied.time >= time - 1e-6)


def test_with_the_brain_that_played_it_is_the_recorded_match_to_the_last_bit(played):
    chain, notes = live_chain(played, SIMPLE, 2.0, 4.0)
    assert chain == recorded_chain(played, 4.0)
    assert notes == []


def test_a_changed_brain_acts_from_the_given_tick_on_only(played, brain):
    spec = brain("command = replace(command, drive=Drive())")
    assert live_chain(played, spec, 2.0, 2.02)[0] != recorded_chain(played, 2.02)
    assert live_chain(played, spec, 3.98, 4.0)[0] != recorded_chain(played, 4.0)
    kept = brain("if sight.tick >= 150:\n    command = replace(command, drive=Drive())")
    assert live_chain(played, kept, 2.0, 3.0)[0] == recorded_chain(played, 3.0)


def test_the_match_can_go_on_beyond_the_end_of_the_recording(played):
    match = LiveMatch(played, "cyan2", SIMPLE)
    assert match.play(3.0, 5.0, lambda _: None).end == pytest.approx(5.0)
    match.close()


def test_a_live_match_is_recorded_from_its_first_tick(played, brain, replay, tmp_path, capsys):
    out = tmp_path / "live.mcap"
    spec = brain("if sight.tick >= 150:\n    command = replace(command, drive=Drive())")
    assert replay(spec, live=True, start="2", out=out) == 0
    assert f"recording {out}" in capsys.readouterr().out
    recording = open_recording(out, whole=True)
    chains = [applied.chain for _, applied in recording.decoded(APPLIED.key)]
    recorded = [applied.chain for _, applied in played.decoded(APPLIED.key)]
    assert len(chains) == len(recorded)
    assert chains[:151] == recorded[:151] and chains[151] != recorded[151]
    verdict = verify(out)
    assert (verdict.difference, verdict.contradictions) == (None, [])
    assert compare_brain(recording, "cyan2", spec).different == 0


def test_a_live_match_whose_brain_fails_is_recorded_up_to_there(brain, replay, tmp_path):
    out = tmp_path / "live.mcap"
    with pytest.raises(MatchFailedError, match="raised at tick 120"):
        replay(brain("if sight.tick == 120:\n    1 / 0"), live=True, start="2", out=out)
    assert open_recording(out, whole=True).result.tick == 120


def test_the_score_and_the_events_are_printed_beside_the_recorded_ones(brain, replay, capsys):
    spec = brain("command = replace(command, drive=Drive(), kick=None)")
    assert replay(spec, live=True, start="1") == 0
    out = capsys.readouterr().out.splitlines()
    assert "recorded in the same time:" in " ".join(out)
    assert out[-1].startswith("live from 1.00 s to 4.00 s: ")
    assert "; recorded: " in out[-1]
    assert replay(spec, live=True, start="1", json=True) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["score"] == result["recorded_score"] == {"cyan": 0, "magenta": 0}


@pytest.fixture
def of_users(match_recorder, brain, tmp_path):
    """A match whose magenta has a brain of the user's."""
    spec = brain("pass")
    teams = {"teams.cyan": {"size": 2, "brain": SIMPLE}, "teams.magenta": {"size": 1, "brain": spec}}
    match_recorder(tmp_path / "match.mcap", load_match(None, {"seed": 5, **teams}), 2.0)
    return open_recording(tmp_path / "match.mcap"), tmp_path / f"{spec.split(':')[0]}.py"


def with_brain(recording, spec, **program):
    """The recording of a match whose magenta had another brain, or a program."""
    teams = recording.manifest.config.teams
    magenta = teams.magenta.model_copy(update={"brain": spec, **program})
    config = recording.manifest.config.model_copy(update={"teams": teams.model_copy(update={"magenta": magenta})})
    recording.manifest = recording.manifest.replace(config=config)
    return recording


def test_a_robot_whose_brain_cannot_be_built_repeats_its_commands(of_users):
    recording, _ = of_users
    chain, notes = live_chain(with_brain(recording, "gone:Brain"), SIMPLE, 1.0, 2.0)
    assert chain == recorded_chain(recording, 2.0)
    assert len(notes) == 1
    assert notes[0].startswith("magenta1: recorded commands; ") and "no module gone" in notes[0]


def test_other_robots_whose_brain_has_changed_are_named(of_users, brain):
    recording, _ = of_users
    _, notes = live_chain(with_brain(recording, brain("command = replace(command, drive=Drive())")), SIMPLE, 1.0, 2.0)
    assert len(notes) == 1
    assert notes[0].startswith("magenta1: its brain differs from the recorded commands from tick ")


def test_another_robots_brain_that_fails_before_is_replaced_by_its_commands(of_users, brain):
    recording, _ = of_users
    spec = brain("if sight.tick == 20:\n    raise ValueError('no plan')")
    chain, notes = live_chain(with_brain(recording, spec), SIMPLE, 1.0, 2.0)
    assert chain == recorded_chain(recording, 2.0)
    assert notes[0].startswith("magenta1: recorded commands; ") and "no plan" in notes[0]


RESTS = """
import json, sys
for line in sys.stdin:
    message = json.loads(line)
    if "tick" in message:
        print(json.dumps({"answers_tick": message["tick"]}), flush=True)
"""


def test_a_program_of_lines_plays_on_live_and_ends_with_the_match(of_users, brain):
    recording, _ = of_users
    program = with_brain(recording, None, stdio=[sys.executable, "-c", RESTS])
    match = LiveMatch(program, "cyan2", SIMPLE)
    match.play(1.0, 1.2, lambda _: None)
    (child,) = [pid for pid in descendants(os.getpid()) if "answers_tick" in Path(f"/proc/{pid}/cmdline").read_text()]
    match.close()
    assert not is_running(child)
    assert match.notes[0].startswith("magenta1: its brain differs from the recorded commands from tick ")


def test_a_program_that_needs_the_bus_repeats_its_commands(of_users, brain):
    recording, _ = of_users
    chain, notes = live_chain(with_brain(recording, None, command=["./robot"]), SIMPLE, 1.0, 2.0)
    assert chain == recorded_chain(recording, 2.0)
    assert notes == ["magenta1: recorded commands; their program needs a match on the bus"]


def test_the_debugger_stops_in_a_live_match_too(brain, replay, typed, capsys):
    typed("p 'at', sight.tick", "c")
    assert replay(brain("pass"), live=True, pdb=True, start="tick:60", end="tick:65") == 0
    assert "('at', 60)" in capsys.readouterr().out


def test_a_free_game_goes_on_live_with_the_score_of_ones_own_folder(tmp_path, monkeypatch, capsys):
    path = record_free_match(tmp_path, free_match(tmp_path, duration=1.0))
    (tmp_path / "tally.py").write_text(SCORE.replace("len(inside)", "7"))
    monkeypatch.chdir(tmp_path)
    assert AgentReplay(path, "one", "support.free_match:Pusher", live=True, start="0.5").run() == 0
    says = capsys.readouterr().out.splitlines()[-1]
    assert re.fullmatch(r"live from 0.50 s to 1.00 s: score 7\.02\d+; recorded: score 0\.02\d+", says)
