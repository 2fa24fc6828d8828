"""A program of lines and its agent: what it is given, what its answers and its faults lead to."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest

from robot_agent.process.stdio.answers import AnswerFault
from robot_agent.process.stdio.child import Child
from robot_agent.process.stdio.program import ProgramEndedError, StdioProgram, briefing_line
from robot_agent.sdk.contract import Briefing
from schemas.errors import TouchlineError
from schemas.messages.command import Command, Drive
from schemas.messages.setup import Setup
from schemas.wire.message import VERSION
from support.process_story import descendants, is_running, wait_for

ANSWERS = "for line in sys.stdin: answer(json.loads(line)['tick'], drive={'vx': 0.5})"


def test_the_first_line_is_the_briefing_with_the_whole_setup(briefing: Briefing, setup: Setup) -> None:
    line = briefing_line(briefing)
    content = json.loads(line)
    assert b"\n" not in line
    assert (content["robot"], content["side"], content["number"]) == ("cyan2", "cyan", 2)
    assert content["teammates"] == list(briefing.teammates)
    assert content["version"] == VERSION
    assert Setup.decode(json.dumps(content["setup"]).encode()) == setup.for_robot("cyan2")


def test_each_sight_is_answered_with_the_programs_command(bench, sight_of) -> None:
    one = bench(ANSWERS)
    for tick in range(5):
        found = one.answered(sight_of(tick))
        assert found.tick == tick
        assert Command.decode(found.answer) == Command(answers_tick=tick, drive=Drive(vx=0.5))
    assert not one.log


def test_the_program_gets_the_sight_as_the_host_has_sent_it(bench, sight_of) -> None:
    seen = bench(
        "sight = json.loads(sys.stdin.readline())\n"
        "answer(sight['tick'], radio={'extra': {'fields': len(sight), 'x': sight['self']['x']}})"
    )
    sight = sight_of(3)
    extra = Command.decode(seen.answered(sight).answer).radio.extra
    assert extra == {"fields": len(json.loads(sight.encode())), "x": sight.self.x}


def test_an_invalid_answer_lets_the_robot_rest_for_its_tick(bench, sight_of) -> None:
    one = bench(
        "for line in sys.stdin:\n"
        "    tick = json.loads(line)['tick']\n"
        '    print(\'{"answers_tick": %d, "drive": {"vx": NaN}}\' % tick, flush=True)'
    )
    for tick in range(12):
        assert Command.decode(one.answered(sight_of(tick)).answer) == Command(answers_tick=tick)
    assert one.program.faults.counts == {AnswerFault.INVALID: 12}
    assert len(one.log) == 2
    assert one.log[0].startswith('cyan2: the program wrote \'{"answers_tick": 0, "drive": {"vx": NaN}}\': Command:')
    assert "(10 lines that were no command so far)" in one.log[1]


def test_some_lines_that_are_no_commands_are_sent_to_the_host_which_counts_them(bench, sight_of) -> None:
    one = bench("for line in sys.stdin:\n    print('thinking\\n' * 50)\n    answer(json.loads(line)['tick'])")
    assert one.answered(sight_of(0)).others == (b"thinking",)
    one.pass_time(0.04)
    assert one.answered(sight_of(2)).others == ()
    one.pass_time(0.04)
    assert one.answered(sight_of(4)).others == (b"thinking",)


def test_lines_for_people_are_named_and_the_answer_after_them_counts(bench, sight_of) -> None:
    one = bench("for line in sys.stdin:\n    print('thinking')\n    answer(json.loads(line)['tick'], dribble=True)")
    assert Command.decode(one.answered(sight_of(0)).answer).dribble
    assert one.log == [
        "cyan2: the program wrote 'thinking': no JSON object; write commands alone to standard output, "
        "and messages to standard error"
    ]


def test_a_second_answer_is_counted_and_not_sent(bench, sight_of) -> None:
    one = bench(
        "for line in sys.stdin:\n    tick = json.loads(line)['tick']\n    answer(tick)\n    answer(tick, dribble=True)"
    )
    answers = [one.answered(sight_of(tick)) for tick in range(3)]
    assert [Command.decode(found.answer).dribble for found in answers] == [False] * 3
    assert [found.others for found in answers] == [()] * 3
    assert set(one.program.faults.counts) == {AnswerFault.SECOND}


def test_a_silent_program_is_named_and_gets_the_newest_sight_after_a_while(bench, sight_of) -> None:
    one = bench(
        "first = sys.stdin.readline()\n"
        "tick = json.loads(sys.stdin.readline())['tick']\n"
        "answer(json.loads(first)['tick'])\nanswer(tick)\nsys.stdin.readline()"
    )
    assert one.ask(sight_of(0)).answer is None
    one.pass_time(0.9)
    assert one.ask(sight_of(45)).answer is None
    assert not one.log
    one.pass_time(0.2)
    found = one.until(lambda: found if (found := one.ask(sight_of(55))).answer is not None else None)
    assert found.tick == 55
    assert "has not answered the sight of tick 0 for 1 s; does it write one line" in one.log[0]
    assert one.program.faults.counts[AnswerFault.SILENT] == 1
    assert one.program.faults.counts[AnswerFault.LATE] == 1


def test_a_program_that_does_not_read_blocks_nothing_and_gets_no_pile_of_sights(bench, sight_of) -> None:
    one = bench("signal.pause()")
    for tick in range(0, 5000, 50):
        assert one.ask(sight_of(tick)).answer is None
        one.pass_time(1.0)
    counts = one.program.faults.counts
    assert counts[AnswerFault.UNREAD] >= 95
    assert len(vars(vars(one.program)["_child"])["_unwritten"]) == 0


def test_a_flood_of_lines_keeps_no_answer_from_coming(bench, sight_of) -> None:
    one = bench(
        "for line in sys.stdin:\n"
        "    print('x' * 100_000 + '\\n' + 'y\\n' * 10_000)\n"
        "    answer(json.loads(line)['tick'])"
    )
    for tick in range(3):
        assert one.answered(sight_of(tick)).tick == tick
    assert one.program.faults.counts[AnswerFault.STRAY] == 3 * 10_001
    assert len(one.log) == 5


@pytest.mark.parametrize(
    ("code", "how"),
    [
        ("sys.exit(3)", "ended with status 3"),
        ("os.kill(os.getpid(), signal.SIGSEGV)", "was ended by SIGSEGV"),
        ("pass", "ended with status 0"),
        ("os.close(1); signal.pause()", "closed its standard output"),
    ],
)
def test_a_program_that_ends_is_named_with_its_end_and_the_tick(bench, sight_of, code: str, how: str) -> None:
    one = bench(code)
    with pytest.raises(ProgramEndedError) as ended:
        one.answered(sight_of(7))
    assert ended.value.report().rstrip().endswith(f"{how} at tick 7")
    assert ended.value.report().startswith(f"the program `{sys.executable} -I -S -c ")


def test_the_last_line_of_a_program_that_ends_after_it_still_counts(bench, sight_of) -> None:
    one = bench("answer(json.loads(sys.stdin.readline())['tick'], dribble=True)")
    assert Command.decode(one.answered(sight_of(2)).answer).dribble
    with pytest.raises(ProgramEndedError, match="at tick 3"):
        one.answered(sight_of(3))


def test_in_one_process_it_is_a_brain_that_waits_for_its_program(bench, sight_of, briefing: Briefing) -> None:
    one = bench(ANSWERS)
    assert one.program.act(sight_of(4)) == Command(answers_tick=4, drive=Drive(vx=0.5))
    assert one.program.act(sight_of(4)) == Command(answers_tick=4, drive=Drive(vx=0.5))
    gone = bench("sys.exit(3)")
    with pytest.raises(TouchlineError, match=r"cyan2: the program .* ended with status 3 at tick 0"):
        gone.program.act(sight_of(0))


def test_it_ends_with_its_input_and_otherwise_by_signal(bench) -> None:
    for code in ("sys.stdin.read()", "signal.signal(signal.SIGTERM, signal.SIG_IGN)\nwhile True: signal.pause()"):
        one = bench(code)
        pid = vars(vars(one.program)["_child"])["_popen"].pid
        assert is_running(pid)
        one.program.close()
        assert not is_running(pid)


def test_it_has_no_secrets_of_the_network_in_its_environment(
    briefing: Briefing, sight_of, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [name for name in os.environ if name.startswith("TOUCHLINE_")]:
        monkeypatch.delenv(name)
    monkeypatch.setenv("TOUCHLINE_LAUNCH_TOKEN", "secret")
    monkeypatch.setenv("TOUCHLINE_CREDENTIALS", "cyan.json")
    monkeypatch.setenv("TOUCHLINE_ROBOT", "cyan2")
    code = (
        "import json, os, sys; sys.stdin.readline(); tick = json.loads(sys.stdin.readline())['tick']\n"
        "names = sorted(name for name in os.environ if name.startswith('TOUCHLINE_'))\n"
        "print(json.dumps({'answers_tick': tick, 'refuses_order': ' '.join(names)}), flush=True)"
    )
    program = StdioProgram([sys.executable, "-I", "-S", "-c", code], briefing)
    assert program.act(sight_of(0)).refuses_order == "TOUCHLINE_ROBOT"
    program.close()


@pytest.mark.processes
def test_it_ends_with_its_agent_also_when_that_is_killed(tmp_path: Path) -> None:
    agent = tmp_path / "agent.py"
    agent.write_text(
        "import signal, sys\n"
        "from robot_agent.process.stdio.child import Child\n"
        "child = Child([sys.executable, '-c', 'import signal; signal.pause()'])\n"
        "signal.pause()\n"
    )
    pid = os.spawnv(os.P_NOWAIT, sys.executable, [sys.executable, str(agent)])
    (child,) = wait_for(lambda: descendants(pid), "the program")
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    wait_for(lambda: not is_running(child), "the end of the program")


def test_a_program_that_runs_as_another_user_is_left_to_end_with_its_input(monkeypatch: pytest.MonkeyPatch) -> None:
    child = Child([sys.executable, "-c", "import signal; signal.pause()"])
    with monkeypatch.context() as patched:
        patched.setattr(subprocess.Popen, "send_signal", Mock(side_effect=PermissionError))
        child.close()
    child.close()
