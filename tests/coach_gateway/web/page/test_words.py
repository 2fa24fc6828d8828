"""What the page says in words: proposals, orders in force, the phase, the result."""

from collections.abc import Callable
from itertools import product
from typing import Any

from schemas.messages.coach import CoachMode, CoachOrder
from schemas.side import Side
from schemas.soccer.game import GameStage, Phase
from support.staged_match import StagedMatch

SIZES = [(390, 844), (844, 390), (1366, 768), (1920, 1080)]
QUESTIONS = [
    (("goal", "cyan", "cyan3", "goal, counts for cyan: ball over the goal line"), "Goal for Lions (cyan 3)?"),
    (
        ("goal", "cyan", "magenta2", "own goal, counts for cyan: ball over the goal line"),
        "Goal for Lions, an own goal of NuBot (magenta 2)?",
    ),
    (("goal", "cyan", None, "goal, counts for cyan: ball over the goal line"), "Goal for Lions?"),
    (("goal", "cyan", "cyan3", "no goal: 1 robots have touched the ball"), "No goal for Lions?"),
    (("touch_line", "cyan", "cyan3", "ball out over the touch line"), "Ball out, last touched by Lions (cyan 3)?"),
    (("goal_line", None, None, "ball out over the goal line"), "Ball out?"),
    (("double_touch", "magenta", "magenta4", "magenta4 touched it twice"), "Foul by NuBot (magenta 4): double touch?"),
    (("scrum", None, None, "scrum: both sides at the ball"), "Scrum?"),
]


def test_a_proposal_is_a_question_whose_whole_reason_is_reached_by_keyboard(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    tab = visit(staged.origin, "referee")
    staged.propose_goal()
    tab.until("document.getElementById('proposed').textContent === 'Goal for Lions (cyan 3)?'")
    assert tab.page.locator("#proposed-why").inner_text() == (
        "Ball over the goal line at (11.1, -0.8), 0.11 m high, last touched by cyan3"
    )
    staged.propose()
    tab.until("document.getElementById('proposed').textContent === 'Foul by NuBot (magenta 4): pushing?'")
    tab.until("!document.getElementById('confirm').disabled")
    for width, height in SIZES:
        tab.resize(width, height)
        tab.page.locator("#confirm").focus()
        tab.page.keyboard.press("Shift+Tab")
        assert tab.ask("document.activeElement.matches('#proposal > p')")
        tab.page.keyboard.press("End")
        tab.until(
            "(({ scrollTop, scrollHeight, clientHeight }) => scrollTop + clientHeight > scrollHeight - 2)"
            "(document.querySelector('#proposal > p'))"
        )
        says, confirm = (tab.page.locator(one).bounding_box() for one in ("#proposal > p", "#confirm"))
        assert says["x"] + says["width"] <= confirm["x"] and says["height"] > 40  # beside the buttons, not behind them


def test_each_kind_of_proposal_is_a_question(staged: StagedMatch, visit: Callable[..., Any]) -> None:
    tab = visit(staged.origin)
    asked = """async (events) => {
        const { questionOf } = await import("/parts/proposal.js");
        return events.map(([rule, side, robot, text]) =>
            questionOf({ rule, side, robot, text: `proposed, decided in 3 s: ${text}` }, window.touchline.match));
    }"""
    assert tab.page.evaluate(asked, [event for event, _ in QUESTIONS]) == [question for _, question in QUESTIONS]


def test_an_order_in_force_is_named_in_the_header_and_by_its_button(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    tabs = {role: visit(staged.origin, role, 390, 844) for role in ("spectator", "cyan", "referee")}

    def order(number: int, *modes: CoachMode) -> None:
        for side, mode in zip(Side, modes, strict=True):
            robots = staged.host.config.robots(side)
            staged.host.stand(side, CoachOrder(mode=mode, sequence=number), **dict.fromkeys(robots, True))

    def wait_for_words(**words: str) -> None:
        for role, tab in tabs.items():
            tab.until(f"document.getElementById('in-force').textContent === {words.get(role, '')!r}")

    wait_for_words()
    order(1, CoachMode.PARK, CoachMode.PARK)
    wait_for_words(cyan="Ordered: Lions park", referee="Ordered: both park")
    tab = tabs["referee"]
    assert tab.button("park_order", "magenta").get_attribute("aria-pressed") == "true"
    assert tab.button("play_order", "magenta").get_attribute("aria-pressed") == "false"
    tab.until("document.querySelector('[data-robot=cyan2] [data-is=order]')?.textContent === 'park, acknowledged'")
    order(2, CoachMode.HOLD, CoachMode.PARK)
    wait_for_words(cyan="Ordered: Lions hold", referee="Ordered: Lions hold, NuBot park")
    assert tab.ask(
        "(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(document.getElementById('in-force'))"
    )
    order(3, CoachMode.PLAY, CoachMode.PLAY)
    wait_for_words()


def test_a_spectator_reads_proposals_in_the_header_and_has_no_empty_place_for_commands(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    for width, height in SIZES[:3]:
        tab = visit(staged.origin, "spectator", width, height)
        assert not tab.page.locator("#pending").is_visible()
        assert "token" not in tab.page.locator("main").inner_text()
    staged.propose_goal()
    tab.until("document.getElementById('in-force').textContent === 'Proposed: Goal for Lions (cyan 3)?'")


def test_a_spectators_phone_shows_the_result_after_full_time(staged: StagedMatch, visit: Callable[..., Any]) -> None:
    tab = visit(staged.origin, "spectator", 390, 844)
    staged.score()
    tab.page.locator("#to-events").click()
    tab.page.locator("#to-robots").click()
    staged.end()
    for page in (tab, visit(staged.origin, "spectator", 390, 844)):  # one that is opened after it, too
        page.until("document.getElementById('result').checkVisibility()")
        assert not page.page.locator("#robots").is_visible()
        assert page.page.locator("#result-title").inner_text() == "Final result"
    tab.page.locator("#to-robots").click()
    staged.host.say(clock=1.0)
    tab.until("window.touchline.match.state.clock === 1")
    assert tab.page.locator("#robots").is_visible()  # once


def test_the_header_cuts_neither_the_phase_nor_the_half_nor_the_time_left(
    staged: StagedMatch, visit: Callable[..., Any]
) -> None:
    tab = visit(staged.origin, "referee")
    staged.host.say(stage=GameStage.EXTRA_TIME, half=3)
    for phase in (Phase.KICK_OFF, Phase.GOAL_KICK):
        staged.host.say(phase=phase, side=Side.MAGENTA, running=True, left=168.0)
        tab.until(f"document.getElementById('phase').textContent.startsWith({phase.value.capitalize()[:4]!r})")
        for (width, height), name in product(SIZES, ("phase", "half", "left")):
            tab.resize(width, height)
            cut = "(({ scrollWidth, clientWidth }) => scrollWidth - clientWidth)"
            assert tab.ask(f"{cut}(document.getElementById({name!r}))") <= 0, name
            place, field = (tab.page.locator(one).bounding_box() for one in (f"#{name}", ".pitch-section"))
            assert place["y"] + place["height"] <= field["y"] + 1, name
    names = "const { teams } = window.touchline.match.setup; teams.cyan.name = 'Tech United Eindhoven';"
    tab.ask(f"(() => {{ {names} teams.magenta.name = 'CAMBADA Aveiro Portugal'; }})()")
    staged.host.say(phase=Phase.KICK_OFF, side=Side.MAGENTA, running=True, left=9.0)
    tab.until("document.getElementById('phase').textContent === 'Kick off, CAMBADA Aveiro Portugal, started'")
    for width, height in SIZES:
        tab.resize(width, height)
        assert tab.page.locator("#phase").bounding_box()["width"] > 120  # what is played is in view
