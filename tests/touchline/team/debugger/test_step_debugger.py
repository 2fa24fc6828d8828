"""Python's debugger around the calls of a brain; the commands are typed by the test."""

import pytest

from schemas.errors import MatchFailedError

SLOWER = """
if sight.tick >= 50:
    command = replace(command, drive=Drive())
"""


def test_it_stops_before_act_at_the_given_tick(brain, replay, typed, capsys):
    spec = brain("answer = 1")
    left = typed("p sight.tick, type(self).__name__", "p command", "c")
    assert replay(spec, pdb=True, start="tick:100") == 0
    out = capsys.readouterr().out
    assert "(100, 'Mine')" in out
    assert "NameError: name 'command' is not defined" in out, "act has not begun"
    assert f"{spec.split(':')[0]}.py(7)act()" in out
    assert left == []


def test_with_a_player_it_stops_in_the_users_play_and_steps_from_one_to_the_next(player, replay, typed, capsys):
    left = typed("p 'in', belief.tick", "n", "n", "n", "p 'in', belief.tick", "c")
    spec = player("answer = 1\nreturn Action('', 'wait', Drive())")
    assert replay(spec, pdb=True, start="tick:100", every_difference=True) == 1
    out = capsys.readouterr().out
    stops = [line for line in out.splitlines() if line.startswith("> ")]
    assert all("brain_of_test" in stop and "play()" in stop for stop in stops), stops
    assert "-> answer = 1" in out and "--Call--" not in out
    first, second = (int(line.split(", ")[1][:-1]) for line in out.splitlines() if line.startswith("('in'"))
    assert 100 <= first < second
    assert left == []


def test_a_failure_in_library_code_opens_the_debugger_in_the_users_code_that_called_it(player, replay, typed, capsys):
    typed("p mine", "q")
    with pytest.raises(MatchFailedError, match="AttributeError"):
        replay(player("mine = None\nskills.go_to(mine, 0.0, 0.0, 0.0, self.limits)"), pdb=True, start="tick:40")
    assert capsys.readouterr().out.splitlines()[-2:] == ["-> skills.go_to(mine, 0.0, 0.0, 0.0, self.limits)", "None"]


def test_it_stops_before_the_first_difference_in_a_brain_that_has_seen_the_same(brain, replay, typed, capsys):
    counting = f"self.acts = getattr(self, 'acts', 0) + 1{SLOWER}"
    typed("p sight.tick, self.acts", "c")
    assert replay(brain(counting), pdb=True) == 1
    assert "(50, 50)" in capsys.readouterr().out


def test_a_difference_that_does_not_come_again_is_reported(brain, replay, typed, capsys):
    once = "if sight.tick == 20 and not SEEN:\n    SEEN.append(1)\n    command = replace(command, drive=Drive())"
    typed("c")
    assert replay(brain(once, "SEEN = []"), pdb=True) == 1
    assert "depends on more than its sights" in capsys.readouterr().out


def test_next_past_the_end_of_act_stops_in_the_next_one(brain, replay, typed, capsys):
    typed("r", "n", "p 'now at', sight.tick", "c")
    assert replay(brain("pass"), pdb=True, start="tick:100", end="tick:110") == 0
    assert "('now at', 101)" in capsys.readouterr().out


def test_a_breakpoint_that_was_typed_stops_in_later_ticks_too(brain, replay, typed, capsys):
    spec = brain("if sight.tick % 4 == 0:\n    found = sight.tick")
    typed(f"b {spec.split(':')[0]}:9", "c", "p 'at', sight.tick", "c", "p 'at', sight.tick", "clear 1", "c")
    assert replay(spec, pdb=True, start="tick:101", end="tick:120") == 0
    out = capsys.readouterr().out
    assert "('at', 104)" in out and "('at', 108)" in out


def test_quitting_the_debugger_ends_without_a_traceback(brain, replay, typed, capsys):
    typed("q")
    assert replay(brain("pass"), pdb=True, start="tick:100") == 0
    caught = capsys.readouterr()
    assert caught.out.splitlines()[-1] == "the debugger was quit"
    assert caught.err == ""


def test_a_failure_opens_the_debugger_where_it_was_raised(brain, replay, typed, capsys):
    typed("p places", "q")
    with pytest.raises(MatchFailedError, match="ZeroDivisionError"):
        replay(brain("places = sight.tick - 30\n1 / places"), pdb=True, start="tick:40")
    assert "> 1 / places" in capsys.readouterr().out.replace("->", ">")


def test_breakpoints_of_the_code_work_from_the_given_tick_on(brain, replay, monkeypatch, capsys):
    stopped = []
    monkeypatch.setattr("sys.breakpointhook", lambda: stopped.append(1))
    assert replay(brain("breakpoint()"), start="tick:100", end="tick:104") == 0
    assert len(stopped) == 5
