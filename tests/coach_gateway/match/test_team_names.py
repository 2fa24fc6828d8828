import pytest

from coach_gateway.match.lines import event_line, state_line
from coach_gateway.match.team_names import SIDES_ALONE, TeamNames
from schemas.config.match_config import load_match
from schemas.config.profile import load_profile
from schemas.config.soccer.rule_book import load_rule_book
from schemas.config.task import GameName, TaskConfig
from schemas.messages.setup import Setup
from schemas.messages.soccer.game import GameEvent, GameState
from schemas.side import Side
from schemas.soccer.game import EventKind, Phase, Score
from support.messages import make_event


def named(cyan: str, magenta: str) -> TeamNames:
    return TeamNames.of({Side.CYAN: cyan, Side.MAGENTA: magenta})


@pytest.mark.parametrize(
    ("cyan", "magenta", "score"),
    [
        ("Lions", "NuBot", "Lions 2 : 0 NuBot"),
        ("", "", "cyan 2 : 0 magenta"),
        ("Lions", "", "Lions 2 : 0 magenta"),
        ("Simple", "Simple", "Simple (cyan) 2 : 0 Simple (magenta)"),
        ("Simple", "simple ", "Simple (cyan) 2 : 0 simple (magenta)"),
        ("Magenta", "Lions", "Magenta (cyan) 2 : 0 Lions"),
        ("Magenta", "Cyan", "Magenta (cyan) 2 : 0 Cyan (magenta)"),
        ("Cyan", "", "Cyan 2 : 0 magenta"),
        ("Lions\x1b[2J", "NuBot", "Lions\N{REPLACEMENT CHARACTER}[2J 2 : 0 NuBot"),
    ],
)
def test_a_score_names_two_different_teams(cyan: str, magenta: str, score: str) -> None:
    assert named(cyan, magenta).score(Score(cyan=2, magenta=0)) == score


@pytest.mark.parametrize(
    ("game", "value", "score"),
    [
        (GameName.SOCCER, 6.74, "Simple 0 : 0 NuBot, score 6.74 s"),
        (GameName.SOCCER, None, "Simple 0 : 0 NuBot"),
        (GameName.FREE, 6.74, "score 6.74 s"),
        (GameName.FREE, None, "score –"),
    ],
)
def test_the_score_of_a_task_has_its_unit_and_stands_after_goals(
    game: GameName, value: float | None, score: str
) -> None:
    task = TaskConfig(score="a:b", unit="s")
    config = load_match(None).model_copy(update={"game": game, "task": task, "duration": 9.0})
    setup = Setup.of(config, load_profile(config.profile), load_rule_book(config.rules))
    for names in (TeamNames.of_match(config), TeamNames.of_setup(setup)):
        assert names.score(Score(), value) == score


@pytest.mark.parametrize(
    ("names", "with_sides"),
    [
        (named("Lions", "NuBot"), ("Lions (cyan)", "NuBot (magenta)")),
        (named("Simple", "Simple"), ("Simple (cyan)", "Simple (magenta)")),
        (SIDES_ALONE, ("cyan", "magenta")),
    ],
)
def test_a_team_with_its_side_has_it_once(names: TeamNames, with_sides: tuple[str, str]) -> None:
    assert tuple(names.with_side(side) for side in Side) == with_sides
    assert str(names) == " – ".join(with_sides)


def test_the_default_match_has_the_names_of_its_teams() -> None:
    assert TeamNames.of_match(load_match(None)) == TeamNames("Simple", "NuBot")
    brains = {"teams.cyan.brain": "my_team:Striker", "teams.magenta.name": "Lions"}
    assert TeamNames.of_match(load_match(None, brains)) == TeamNames("cyan", "Lions")


def test_the_text_of_an_event_has_the_teams_names_and_robots_keep_theirs() -> None:
    text = "goal, counts for magenta: last touched by cyan3; kick-off for cyan follows, cyan 0 : 1 magenta"
    assert named("Lions", "NuBot").in_text(text) == (
        "goal, counts for NuBot: last touched by cyan3; kick-off for Lions follows, Lions 0 : 1 NuBot"
    )
    assert SIDES_ALONE.in_text(text) == text


def test_names_that_contain_a_side_are_not_replaced_again() -> None:
    assert named("magenta fans", "cyan\\1").in_text("cyan and magenta") == "magenta fans and cyan\\1"


def test_a_line_of_a_state_and_of_an_event_has_the_names() -> None:
    names = named("Lions", "NuBot")
    state = GameState(tick=9, time=61.0, clock=61.0, phase=Phase.CORNER, side=Side.MAGENTA, proposal="corner for cyan")
    assert state_line(state, names) == " 1:01.0  half 1  Lions 0 : 0 NuBot  corner, NuBot  proposed: corner for Lions"
    goal = state.replace(proposal="goal: goal, counts for cyan: ball over the goal line")
    assert state_line(goal, names).endswith("  proposed: goal, counts for Lions: ball over the goal line")
    event = GameEvent(tick=9, time=61.0, clock=61.0, kind=EventKind.RESTART, rule="out", text="corner for magenta")
    assert event_line(event, names) == " 1:01.0  restart: corner for NuBot"


def test_an_event_is_one_sentence_that_does_not_repeat_its_kind() -> None:
    goal = make_event(1, "goal, counts for cyan: ball over the goal line", EventKind.GOAL)
    assert event_line(goal) == " 0:00.0  goal: counts for cyan: ball over the goal line"
    assert event_line(make_event(1, "goal by cyan3", EventKind.GOAL)) == " 0:00.0  goal: goal by cyan3"
