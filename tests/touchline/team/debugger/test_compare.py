"""A changed brain against a recording: a table of what differs, up to the first command that does."""

import json
from pathlib import Path

import pytest

from recordings.reading.recording import open_recording
from schemas.config.match_config import load_match
from schemas.errors import MatchFailedError, TouchlineError
from schemas.messages.command import Command, Drive, Kick, KickMode
from schemas.messages.scene import SceneOperation, SceneRequest
from touchline.commands.cli.command_line import app
from touchline.team.debugger.agent_replay import parse_agent
from touchline.verify.command_difference import differences
from touchline.verify.compare_brain import compare_brain

SIMPLE = "robot_agent.teams.simple:Simple"
FASTER = """
if sight.tick >= 50:
    command = replace(command, drive=replace(command.drive, vx=command.drive.vx + 0.5))
"""


def test_the_table_ends_with_the_first_command_that_differs(brain, replay, capsys):
    assert replay(brain(FASTER)) == 1
    out = capsys.readouterr().out.splitlines()
    assert out[0].split() == ["tick", "time", "field", "recorded", "new"]
    tick, time, s, field, recorded, unit, new, _ = out[1].split()
    assert (tick, time, s, field, unit) == ("50", "1.00", "s", "drive.vx", "m/s")
    assert float(new) - float(recorded) == pytest.approx(0.5)
    assert "50 of 51 commands of cyan2" in out[2]
    assert "first difference at tick 50 (1.00 s)" in out[2]
    assert "--from tick:50 --pdb" in out[3]


def test_it_goes_on_after_the_first_difference_if_told_to(brain, replay, capsys):
    assert replay(brain(FASTER), every_difference=True, end="tick:60") == 1
    out = capsys.readouterr().out
    assert sum("drive.vx" in line and "m/s" in line for line in out.splitlines()) == 11
    assert "50 of 61 commands of cyan2" in out


def test_the_brain_that_played_differs_nowhere(replay, capsys):
    assert replay(SIMPLE) == 0
    assert capsys.readouterr().out.startswith("identical")


def test_a_brain_that_begins_later_has_the_state_of_all_sights_before(brain, replay, capsys):
    counting = "self.acts = getattr(self, 'acts', 0) + 1\nprint('act', self.acts, 'tick', sight.tick)"
    assert replay(brain(counting), start="tick:100", end="tick:101") == 0
    out = capsys.readouterr().out.splitlines()
    assert out[:2] == ["act 101 tick 100", "act 102 tick 101"], "what it prints before is not shown"
    assert out[2] == "100 earlier sights were given to the brain for its state, without its output"


def test_an_event_or_a_tick_names_the_beginning(brain, replay, capsys):
    assert replay(brain("print(sight.tick)"), start="in_play+0.1", end="in_play+0.1") == 0
    tick = int(capsys.readouterr().out.splitlines()[0])
    assert replay(brain("print(sight.tick)"), start=f"tick:{tick}", end=f"tick:{tick}") == 0
    assert capsys.readouterr().out.splitlines()[0] == str(tick)


def test_the_result_is_one_json_object_whatever_the_brain_prints(brain, replay, capsys):
    assert replay(brain(f"print('thinking')\n{FASTER}"), json=True) == 1
    caught = capsys.readouterr()
    verdict = json.loads(caught.out)
    assert (verdict["first"]["tick"], verdict["compared"], verdict["different"]) == (50, 51, 1)
    assert "thinking" in caught.err


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"pdb": True, "json": True}, "leave one of them out"),
        ({"live": True, "every_difference": True}, "leave --every-difference out"),
        ({"out": Path("live.mcap")}, "give --live, too"),
        ({"start": "3", "end": "2"}, "end later"),
        ({"start": "900"}, "begin earlier"),
        ({"start": "gaol:1"}, "did you mean"),
        ({"start": "900", "live": True}, "cannot be repeated up to 900.00 s: its last tick is at 4.00 s"),
    ],
)
def test_options_that_make_no_sense_are_one_line(replay, options, words):
    with pytest.raises(TouchlineError, match=words):
        replay(SIMPLE, **options)


@pytest.mark.parametrize("text", ["cyan2", "=my:Brain", "cyan2="])
def test_an_agent_without_robot_or_brain_is_reported(text):
    with pytest.raises(TouchlineError, match="write it as cyan2=module:Class"):
        parse_agent(text, {})


@pytest.mark.parametrize("option", ["--web", "--rate=2", "--include=world", "--paused", "a second --agent=cyan1=a:B"])
def test_options_of_a_replay_on_the_bus_are_refused_with_an_agent(played, option, capsys, monkeypatch):
    words = ["touchline", "replay", str(played.path), "--agent", f"cyan2={SIMPLE}", option.removeprefix("a second ")]
    monkeypatch.setattr("sys.argv", words)
    with pytest.raises(SystemExit):
        app()
    assert f"without a bus; leave {option.partition('=')[0]} out" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--every-difference", "--pdb", "--live", "--out=a", "--brain-folder=."])
def test_the_debuggers_options_need_an_agent(played, option, capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["touchline", "replay", str(played.path), option])
    with pytest.raises(SystemExit):
        app()
    assert "need --agent, such as --agent cyan2=my:Brain" in capsys.readouterr().err


def test_a_brain_that_raises_is_shown_with_its_own_frames(brain, replay, capsys):
    spec = brain("if sight.tick == 30:\n    command = {}['ball']")
    with pytest.raises(
        MatchFailedError, match=rf"raised at tick 30: KeyError: 'ball' \({spec.split(':')[0]}.py, line 9\)"
    ):
        replay(spec)
    shown = capsys.readouterr().err
    assert "command = {}['ball']" in shown
    assert "compare_brain.py" not in shown


def test_a_brain_that_leaves_python_is_an_error_of_the_brain(brain, replay):
    with pytest.raises(MatchFailedError, match="raised at tick 0: SystemExit"):
        replay(brain("raise SystemExit"))


def test_values_have_as_many_decimals_as_it_takes_to_see_the_difference():
    one, other = (Command(answers_tick=1, drive=Drive(vx=vx)) for vx in (0.5, 0.50000004))
    (found,) = differences(one, other)
    assert found.texts() == ("0.50000000 m/s", "0.50000004 m/s")


def test_a_kick_that_only_one_command_has_is_one_field():
    without = Command(answers_tick=1)
    (found,) = differences(without, Command(answers_tick=1, kick=Kick(mode=KickMode.LOB, speed=4.0)))
    assert (found.field, found.texts()) == ("kick", ("None", "mode lob, speed 4.000"))
    assert differences(without, without) == []


def test_a_match_with_a_reset_is_compared_to_its_end(match_recorder, tmp_path):
    """What a reset sets down follows from the match file."""

    def reset(simulation):
        if simulation.now.tick == 60:
            assert simulation.handle_scene(SceneRequest(operation=SceneOperation.RESET)).accepted

    sides = {f"teams.{side}": {"size": 2, "brain": SIMPLE} for side in ("cyan", "magenta")}
    match_recorder(tmp_path / "reset.mcap", load_match(None, {"seed": 5, **sides}), 2.0, between=reset)
    verdict = compare_brain(open_recording(tmp_path / "reset.mcap"), "cyan2", SIMPLE)
    assert (verdict.until, verdict.different) == ("", 0)
    assert verdict.compared >= 99


def test_a_match_with_a_referee_box_is_compared_to_its_end(match_recorder, tmp_path):
    """The box alone ends halves: without it, the first one would end after a second of play."""
    sides = {f"teams.{side}": {"size": 2, "brain": SIMPLE} for side in ("cyan", "magenta")}
    config = load_match(None, {"seed": 5, "duration": 2.0, **sides})
    match_recorder(tmp_path / "box.mcap", config, 8.0, refbox=lambda _: True)
    verdict = compare_brain(open_recording(tmp_path / "box.mcap"), "cyan2", SIMPLE)
    assert (verdict.until, verdict.different) == ("", 0)


def test_what_a_brain_draws_and_plots_is_no_difference(brain, replay):
    """It is added to a brain to find out why it does what it does."""
    drawing = "command = replace(command, debug=Debug(values={'tick': float(sight.tick)}))"
    assert replay(brain(drawing, "from schemas.messages.debug import Debug")) == 0
