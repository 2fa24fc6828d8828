"""Each check passes a brain that keeps the contract, and names what one does that breaks it."""

import itertools
from collections.abc import Callable
from pathlib import Path

import pytest

from runtime.process.clock import Clock
from schemas.config.match_config import load_match
from schemas.config.shipped_teams import SHIPPED_TEAMS, brain_of
from support.stepped_clock import SteppedClock
from touchline.team.check import play as play_module
from touchline.team.check.checks import CHECKS, CheckResult, run_check, run_checks
from touchline.team.check.examination import Examination
from touchline.team.check.fresh_checks import run_fresh
from touchline.team.check.subject import Subject

MODULE = "checked_team"
BRAINS = """
import itertools, os, re, time
from touchline import Command, Drive, Kick, KickMode, Radio

GROUND = KickMode.GROUND

class Keeps:
    def __init__(self, briefing):
        self.briefing = briefing

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=1.0), dribble=True)

class Unbuildable(Keeps):
    def __init__(self, briefing):
        raise KeyError("model.bin")

class Slow(Keeps):
    def act(self, sight):
        time.sleep(0.03)
        return super().act(sight)

class HangsInInit(Keeps):
    def __init__(self, briefing):
        while True:
            pass

class HangsInAct(Keeps):
    def act(self, sight):
        while sight.tick == 3:
            try:
                pass
            except:
                pass
        return super().act(sight)

class HangsInC(Keeps):
    def act(self, sight):
        if sight.tick == 3:
            re.match("(a+)+b", 40 * "a")
        return super().act(sight)

class Crashes(Keeps):
    def act(self, sight):
        if sight.tick == 3:
            os.abort()
        return super().act(sight)

class Misspells(Keeps):
    def act(self, sight):
        return Command(answers_tick=self.breifing)

class NeedsBall(Keeps):
    def act(self, sight):
        if sight.tick > 200:
            sight.ball.x
        return super().act(sight)

class Counts(Keeps):
    count = itertools.count()

    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(omega=next(self.count) % 3))

class Speeds(Keeps):
    def act(self, sight):
        return Command(answers_tick=sight.tick, drive=Drive(vx=15.0))

class Kicks(Keeps):
    def act(self, sight):
        return Command(answers_tick=sight.tick, kick=Kick(mode=GROUND, speed=5.0))

class SeesAlways(Keeps):
    def act(self, sight):
        if sight.tick > 100:
            sight.ball.x
        return super().act(sight)

class KicksHeld(Keeps):
    def act(self, sight):
        kick = Kick(mode=GROUND, speed=5.0) if sight.holding else None
        return Command(answers_tick=sight.tick, kick=kick)

class PlaysAlone(Keeps):
    def act(self, sight):
        if sight.game.robots:
            raise RuntimeError("a robot is missing")
        return super().act(sight)

class KicksTheirs(Keeps):
    def act(self, sight):
        near = sight.ball is not None and sight.game.phase.theirs
        return Command(answers_tick=sight.tick, kick=Kick(mode=GROUND, speed=5.0) if near else None)

class ReadsPlan(Keeps):
    def act(self, sight):
        for mate in sight.radio.values():
            mate.extra["plan"]
        return Command(answers_tick=sight.tick, radio=Radio(extra={"plan": 3}))

class ReadsNumber(Keeps):
    def act(self, sight):
        plans = [mate.extra["plan"] + 1 for mate in sight.radio.values() if "plan" in mate.extra]
        return Command(answers_tick=sight.tick, radio=Radio(extra={"plan": 3}))

class OnceEach(Keeps):
    last = -1

    def act(self, sight):
        assert sight.tick == self.last + 1 or sight.tick % 500 < 490 and sight.tick != self.last
        self.last = sight.tick
        return super().act(sight)

class OtherTick(Keeps):
    def act(self, sight):
        return Command(answers_tick=7)

class Nothing(Keeps):
    def act(self, sight):
        if sight.tick == 3:
            return None
        return super().act(sight)
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("brains")
    (folder / f"{MODULE}.py").write_text(BRAINS)
    return folder


@pytest.fixture
def examine(folder: Path) -> Callable[[str, str], CheckResult]:
    """Runs one check on a brain of the module."""

    def run(check: str, brain: str) -> CheckResult:
        clock = {"clock": SteppedClock()} if brain != "Slow" else {}
        seconds = 2.0 if brain != "Slow" else 0.2
        config = load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 1, "teams.cyan.remote": True})
        examination = Examination(Subject(config, f"{MODULE}:{brain}", folder=folder), seconds, **clock)
        return run_check(next(row for row in CHECKS if row.name == check), examination)

    return run


@pytest.mark.parametrize("check", [row.name for row in CHECKS])
def test_a_brain_that_keeps_the_contract_passes(examine: Callable[[str, str], CheckResult], check: str) -> None:
    result = examine(check, "Keeps")
    assert result.kept, result.sentence
    assert "{" not in result.sentence and result.figures


BROKEN = [
    ("build", "Unbuildable", "Unbuildable(briefing) raised KeyError: 'model.bin'"),
    ("time", "Slow", " ms or more, and a tick lasts 20 ms"),
    ("repeatable", "Counts", "decides differently at tick 0 of two equal runs: {"),
    ("limits", "Speeds", "cyan1 at tick 0: drive is 15.00 m/s, the limit is 4"),
    ("limits", "Kicks", "kick"),
    ("ball_unseen", "SeesAlways", "the ball never seen, play: cyan1: act raised at tick"),
    ("stopped", "KicksHeld", "pre_game: cyan1 kicks the ball although the game does not run"),
    ("sent_off", "PlaysAlone", "the robot off the field (second_yellow): cyan1: act raised"),
    ("set_pieces", "KicksTheirs", "before START: cyan1 kicks the ball although the game does not run"),
    ("radio_fields", "ReadsPlan", "radio without fields: cyan1: act raised"),
    ("radio_fields", "ReadsNumber", "radio with text in place of each value in extra: cyan1: act raised"),
    ("twice", "OnceEach", "a sight twice: cyan1: act raised"),
    ("answers", "OtherTick", "answers_tick is 7 for the sight of tick 0; return Command(answers_tick=sight.tick"),
    ("answers", "Nothing", "act returned None at tick 3"),
]


@pytest.mark.parametrize(("check", "brain", "words"), BROKEN, ids=lambda value: str(value).split()[0])
def test_a_brain_that_breaks_the_contract_is_named_with_the_remedy(
    examine: Callable[[str, str], CheckResult], check: str, brain: str, words: str
) -> None:
    result = examine(check, brain)
    assert not result.kept
    assert words in result.sentence
    assert result.sentence.endswith(next(row.remedy for row in CHECKS if row.name == check))
    assert "\n" not in result.sentence


def test_every_check_has_a_brain_that_breaks_it() -> None:
    assert {check for check, _, _ in BROKEN} == {row.name for row in CHECKS}


@pytest.fixture
def run_all(folder: Path) -> Callable[..., list[CheckResult]]:
    """Runs all checks on a brain of the module, by a clock that stands unless another is given."""

    def run(brain: str, clock: Clock | None = None) -> list[CheckResult]:
        config = load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 1, "teams.cyan.remote": True})
        subject = Subject(config, f"{MODULE}:{brain}", folder=folder)
        return list(run_checks(Examination(subject, 2.0, clock or SteppedClock())))

    return run


def assert_only_fault(results: list[CheckResult], name: str, words: str) -> None:
    """The check `name` is broken, those before it are kept, and those after it are not judged."""
    at = [row.name for row in CHECKS].index(name)
    assert [result.kept for result in results] == [True] * at + [False] + [None] * (len(CHECKS) - at - 1)
    assert words in results[at].sentence
    assert not any(result.sentence for result in results[at + 1 :])


def test_without_a_brain_no_other_check_is_judged(run_all: Callable[..., list[CheckResult]]) -> None:
    assert_only_fault(run_all("Unbuildable"), "build", "KeyError")


def test_an_exception_in_every_sight_is_one_line_and_the_rest_is_not_judged(
    run_all: Callable[..., list[CheckResult]],
) -> None:
    assert_only_fault(run_all("Misspells"), "answers", "AttributeError: 'Misspells' object has no attribute 'breifing'")


def test_an_exception_that_an_earlier_check_reported_is_not_reported_again(
    run_all: Callable[..., list[CheckResult]],
) -> None:
    results = {result.name: result.kept for result in run_all("NeedsBall")}
    assert (results["ball_unseen"], results["twice"], results["stopped"]) == (False, None, True)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("brain", "check", "words"),
    [
        ("HangsInInit", "build", f"cyan1: building {MODULE}:HangsInInit has not returned after 4 s ("),
        ("HangsInAct", "answers", "cyan1: act at tick 3 has not returned after 3 s ("),
        ("HangsInC", "answers", "cyan1: act at tick 3 has not returned after 3 s ("),
        ("Crashes", "answers", "cyan1: act at tick 3: its process was ended by SIGABRT"),
    ],
)
def test_a_brain_that_never_returns_or_ends_its_process_ends_the_check_with_its_line(
    folder: Path, brain: str, check: str, words: str
) -> None:
    config = load_match(None, {"teams.cyan.size": 2, "teams.magenta.size": 1, "patience.attendance": 4.0})
    subject = Subject(config, f"{MODULE}:{brain}", folder=folder)
    results = list(run_fresh(subject, 2.0, hang_s=3.0))
    assert_only_fault(results, check, words)
    sentence = next(result.sentence for result in results if result.kept is False)
    assert brain == "Crashes" or f"{MODULE}.py, line" in sentence


@pytest.mark.parametrize("quick", [0, 400], ids=["in both matches", "in the second"])
def test_a_brain_much_slower_than_its_ticks_is_judged_slow_before_the_match_ends(
    run_all: Callable[..., list[CheckResult]], monkeypatch: pytest.MonkeyPatch, quick: int
) -> None:
    monkeypatch.setattr(play_module, "HANG_S", 1.0)
    times = itertools.accumulate(itertools.chain(itertools.repeat(0.02, quick), itertools.repeat(0.05)))

    class Clock50ms(SteppedClock):
        def now(self) -> float:
            return next(times)

    assert_only_fault(
        run_all("Keeps", Clock50ms()), "time", "a decision takes 50.0 ms on average, and a tick lasts 20 ms"
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "team", [pytest.param(team, marks=() if team == "simple" else pytest.mark.long) for team in SHIPPED_TEAMS]
)
def test_the_teams_that_ship_keep_the_contract(team: str) -> None:
    subject = Subject(load_match(None, {"teams.cyan.remote": True}), brain_of(team))
    examination = Examination(subject, 6.0, SteppedClock())
    assert [result.sentence for result in run_checks(examination) if not result.kept] == []
