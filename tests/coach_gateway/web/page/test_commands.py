"""Commands from the page: accepted ones are carried out, refused ones have their reason, and roles are kept."""

import math

import pytest

from coach_gateway.match.host_client import HostClient
from runtime.process.clock import WallClock
from schemas.messages.command import Kick, KickMode
from schemas.messages.soccer.game import RefereeAction
from schemas.side import Side
from schemas.soccer.game import ActionName, Phase
from schemas.topics import MANUAL
from support.brisk import BRISK


def test_the_space_bar_stops_the_match_wherever_the_focus_is(officiated, visit) -> None:
    match = officiated(rules=str(BRISK))
    tab = visit(match, "referee")
    places = ["#moving", "[data-action=corner][data-side=cyan]", "#to-log", "#layer-roles", "#place-x"]
    tab.open("settings")
    for place in places:
        match.until(lambda: match.state.phase is not Phase.STOPPED or match.state.running)
        if "action" in place:
            tab.open("match")
        if place == "#place-x":
            tab.open("settings")
        tab.page.locator(place).focus()
        tab.page.keyboard.press("Space")
        match.until(lambda: match.state.phase is Phase.STOPPED)
        tab.wait_for_log("Stop accepted")
        assert tab.page.locator("#layer-roles").is_checked()  # it had the focus, and was not switched
        tab.open("match")
        tab.press("drop_ball")
        tab.wait_for_log("Drop ball accepted")
        tab.open("settings")
    assert "Corner" not in tab.page.locator("#log").inner_text()


def test_buttons_show_why_the_referee_has_refused(match, visit) -> None:
    tab = visit(match, "referee")
    tab.button("enter").page.locator("[data-robot=cyan1] .who").click()
    tab.press("enter")
    tab.until("document.querySelector('.verdict.refused')?.textContent.includes('cyan1 is on the field')")
    button, verdict = tab.button("enter").bounding_box(), tab.page.locator(".verdict").bounding_box()
    assert button and verdict
    assert abs(verdict["x"] - button["x"]) < 400 and abs(verdict["y"] - button["y"]) < 60  # beside what was pressed
    tab.wait_for_log("Come back, cyan1 refused: enter: cyan1 is on the field")


@pytest.mark.parametrize("side", [Side.CYAN, pytest.param(Side.MAGENTA, marks=pytest.mark.long)])
def test_every_restart_can_be_given_to_either_side(officiated, visit, side: Side) -> None:
    match = officiated(rules=str(BRISK))
    tab = visit(match, "referee")
    for phase in (Phase.KICK_OFF, Phase.FREE_KICK, Phase.GOAL_KICK, Phase.THROW_IN, Phase.CORNER, Phase.PENALTY):
        tab.press(phase.value, side.value)
        match.until(lambda phase=phase: match.state.phase is phase and match.state.side is side)
    tab.press("drop_ball")
    match.until(lambda: match.state.phase is Phase.DROP_BALL)
    tab.until_seen("ball", match.state.spot.x, match.state.spot.y)
    tab.press("start")
    match.until(lambda: match.state.running)


def test_cards_are_for_the_robot_that_is_chosen(match, visit) -> None:
    tab = visit(match, "referee")
    assert tab.button("yellow_card").is_disabled()
    assert tab.button("yellow_card").get_attribute("title") == "choose a robot first"
    tab.page.locator("#robot").select_option("magenta2")
    tab.press("yellow_card")
    match.until(lambda: "magenta2" in match.state.robots and match.state.robots["magenta2"].yellow == 1)


PATIENT = """
extends = "friendly"
version = 1

[stall]
still_duration = { value = 120, unit = "s", origin = "for tests" }
progress_duration = { value = 120, unit = "s", origin = "for tests" }
"""
"""A ball that lies still while a busy machine opens the page's settings is no proposal."""


def test_a_proposal_is_confirmed_or_overruled(match_of, visit, tmp_path) -> None:
    (tmp_path / "patient.toml").write_text(PATIENT)
    match = match_of(still=True, rules=str(tmp_path / "patient.toml"), referee={"mode": "mixed", "proposal": 60.0})
    tab = visit(match, "referee")
    match.until(lambda: match.state.phase is not Phase.PRE_GAME)
    tab.press("drop_ball")
    match.until(lambda: match.state.phase in (Phase.DROP_BALL, Phase.PLAY))
    tab.until_seen("ball", 0.0, 0.0)
    tab.press("start")
    match.until(lambda: match.state.phase is Phase.PLAY)
    tab.open("settings")
    tab.page.locator("#freely").check()
    tab.open("match")
    tab.drag((match.world["ball"]["x"], match.world["ball"]["y"]), (0.0, 7.6))
    match.until(lambda: match.state.proposal is not None)
    tab.until("!document.getElementById('proposal').hidden")
    assert tab.page.locator("#proposed").inner_text() == "Ball out?"
    tab.page.locator("#overrule").click()
    tab.wait_for_log("Overrule accepted")
    match.until(lambda: match.state.proposal is not None)  # the ball is still out
    tab.until("!document.getElementById('proposal').hidden")
    tab.page.locator("#confirm").click()
    tab.wait_for_log("Confirm accepted")
    match.until(lambda: match.state.phase is not Phase.PLAY)
    tab.until("document.getElementById('proposal').hidden")


def test_the_log_lists_the_requests_of_other_pages_too_and_each_request_once(resting, visit) -> None:
    tab, other = visit(resting, "referee"), visit(resting, "referee")
    tab.press("stop")
    tab.wait_for_log("Stop accepted")
    other.wait_for_log("referee's page requests: stop")
    other.press("drop_ball")
    other.wait_for_log("Drop ball accepted")
    tab.wait_for_log("referee's page requests: drop ball")
    for page in (tab, other, visit(resting, "cyan")):
        page.until("document.querySelectorAll('#log li').length >= 2")
        page.page.wait_for_timeout(200)
        requests = [line for line in page.page.locator("#log li").all_text_contents() if "start" not in line]
        assert len(requests) == 2, requests


def test_a_token_is_taken_from_the_address_kept_and_given_up(match, visit) -> None:
    tab = visit(match, "referee")
    assert tab.ask("location.href") == f"{tab.origin}/"
    tab.page.reload()
    tab.until("window.touchline?.match.role === 'referee'")
    tab.page.locator("#role").click()
    tab.page.locator("#leave").click()
    tab.until("window.touchline.match.role === 'spectator'")
    tab.page.reload()
    tab.until("window.touchline?.match.setup && window.touchline.match.role === 'spectator'")
    tab.page.locator("#role").click()
    tab.page.locator("#token").fill("nonsense")
    tab.page.keyboard.press("Enter")
    tab.until("document.getElementById('token-says').textContent.startsWith('refused: unknown token')")
    tab.page.locator("#token").fill("cyans-coach")
    tab.page.keyboard.press("Enter")
    tab.until("window.touchline.match.role === 'cyan'")


def test_the_ball_is_placed_by_dragging_where_the_referee_allows_it(resting, visit) -> None:
    match = resting
    tab = visit(match, "referee")
    tab.press("start")
    tab.until("window.touchline.match.state?.running")
    ball = match.world["ball"]
    tab.drag((ball["x"], ball["y"]), (3.0, 2.0))
    tab.wait_for_log("the game is running; stop it first")
    tab.press("drop_ball")
    match.until(lambda: match.state.phase is Phase.DROP_BALL)
    spot = match.state.spot
    assert spot is not None
    tab.until("window.touchline.match.state?.phase === 'drop_ball'")
    tab.until_seen("ball", spot.x, spot.y)
    tab.drag((spot.x, spot.y), (3.0, 2.0))
    tab.wait_for_log("Ball to (3.00, 2.00) accepted")
    assert (match.state.spot.x, match.state.spot.y) == pytest.approx((3.0, 2.0), abs=0.06)


def test_a_robot_is_moved_by_dragging_while_the_game_is_stopped(resting, visit) -> None:
    match = resting
    tab = visit(match, "referee")
    tab.page.keyboard.press("Space")
    tab.until("window.touchline.match.state?.phase === 'stopped'")
    match.until(lambda: math.hypot(*(match.world["robots"]["cyan1"][axis] for axis in ("vx", "vy"))) < 0.02)
    x, y = match.where("cyan1")
    tab.until_seen("robots.cyan1", x, y)
    tab.drag((x, y), (-6.0, 5.0))
    tab.wait_for_log("cyan1 to (−6.00, 5.00) accepted")
    match.until(lambda: math.dist(match.where("cyan1"), (-6.0, 5.0)) < 1.5)
    left, top = tab.ask("[drop.getBoundingClientRect().left, drop.getBoundingClientRect().top]")  # the next press
    assert tab.page.evaluate("([x, y]) => document.elementFromPoint(x + 0.5, y + 0.5).id", [left, top]) == "moving"


def test_a_body_is_set_down_by_numbers_too(match, visit) -> None:
    tab = visit(match, "referee")
    tab.press("stop")
    match.until(lambda: match.state.phase is Phase.STOPPED)
    tab.open("settings")
    tab.page.locator("#place").click()
    tab.wait_for_log("x and y are missing")
    tab.page.locator("#place-body").select_option("magenta2")
    for field, value in (("x", "5"), ("y", "-4"), ("heading", "90")):
        tab.page.locator(f"#place-{field}").fill(value)
    tab.page.locator("#place").click()
    tab.wait_for_log("magenta2 to (5.00, −4.00) accepted")


def test_a_scene_is_loaded_and_left(match, visit) -> None:
    tab = visit(match, "referee")
    tab.open("settings")
    tab.page.locator("#scene").select_option("penalty")
    assert tab.page.locator("#scene-says").inner_text()
    tab.page.locator("#scene-load").click()
    match.until(lambda: match.world["episode"] == 2)
    tab.until("window.touchline.pitchCanvas.world?.episode === 2")
    while match.world["episode"] == 2:  # two presses, no double click, and on a busy machine not too far apart
        tab.page.locator("#match-reset").click()
        tab.page.wait_for_timeout(600)
    assert match.world["episode"] == 3


def test_speed_and_noise_are_set_within_their_range_and_reset(match, visit) -> None:
    tab = visit(match, "referee")
    tab.open("settings")
    row = tab.page.locator("[data-parameter='drive.max_speed']")
    row.wait_for()
    assert "m/s" in row.inner_text()
    before = match.host.simulation.profile.drive.max_speed
    for wrong, why in (("fast", "refused: fast is not a number"), ("1000", "refused: drive.max_speed is 1000")):
        row.locator("input").fill(wrong)
        row.get_by_role("button", name="Set drive.max_speed", exact=True).click()
        tab.wait_for_log(why)
    assert match.host.simulation.profile.drive.max_speed == before
    row.locator("input").fill("1.5")
    row.get_by_role("button", name="Set drive.max_speed", exact=True).click()
    match.until(lambda: match.host.simulation.profile.drive.max_speed == 1.5)
    tab.until("document.querySelector('[data-parameter=\"drive.max_speed\"]').classList.contains('changed')")
    row.get_by_role("button", name="Reset drive.max_speed").click()
    match.until(lambda: match.host.simulation.profile.drive.max_speed == before)
    tab.page.locator("#parameter-filter").fill("noise")
    tab.page.locator("[data-parameter='noise.preset'] select").select_option("perfect")
    tab.page.locator("[data-parameter='noise.preset']").get_by_role(
        "button", name="Set noise.preset", exact=True
    ).click()
    tab.wait_for_log("noise.preset = perfect accepted")


@pytest.mark.parametrize("side", [pytest.param(Side.CYAN, marks=pytest.mark.long), Side.MAGENTA])
def test_an_order_takes_its_points_and_angles_from_the_field(match, visit, side: Side) -> None:
    tab = visit(match, "referee")
    sign = 1 if side is Side.CYAN else -1  # magenta attacks −x, and believes that it is +x
    tab.open("coach")
    tab.page.locator("#order-side").select_option(side.value)
    tab.page.locator("#order-mode").select_option("test")
    tab.page.locator("#order-test").select_option("move")
    tab.page.locator("#order-robot_a").select_option(f"{side.value}2")
    tab.page.locator("#order-max_speed").fill("1.5")
    tab.page.locator("#order-point_a-pick").click()
    assert tab.page.locator("#hint").is_visible()
    tab.drag((2.0, 3.0), (2.0, 5.0))  # a point, and the direction +y
    tab.page.locator("#order-give").click()
    tab.wait_for_log(f"Test move, {side.value} accepted")
    order = match.host.simulation.orders[side]
    assert (order.mode, order.test, order.robot_a, order.max_speed) == ("test", "move", f"{side.value}2", 1.5)
    assert (order.point_a.x, order.point_a.y) == pytest.approx((2.0 * sign, 3.0 * sign), abs=0.06)
    assert order.angle_a == pytest.approx(sign * math.pi / 2, abs=0.05)
    tab.until("document.querySelectorAll('#active-orders .ack.accepted').length === 2")


def test_an_order_that_lacks_something_is_refused_with_the_reason(match, visit) -> None:
    tab = visit(match, "magenta")
    tab.open("coach")
    assert tab.page.locator("#order-side option").count() == 1
    tab.page.locator("#order-mode").select_option("test")
    tab.page.locator("#order-test").select_option("circle")
    tab.page.locator("#order-give").click()
    tab.wait_for_log("Circle needs Robot A, Point A, and Radius (m)")


def test_a_robot_is_driven_by_keys_in_place_of_its_brain_and_given_back(match, visit) -> None:
    tab = visit(match, "cyan")
    tab.open("drive")
    options = tab.page.locator("#drive-robot option")
    assert [options.nth(number).get_attribute("value") for number in range(options.count())] == ["", "cyan1", "cyan2"]
    tab.page.locator("#drive-robot").select_option("cyan2")
    tab.page.locator("#drive-take").click()
    match.until(lambda: match.said("cyan2 is under manual control"))
    match.until(lambda: abs(match.world["robots"]["cyan2"]["vx"]) < 0.02)
    heading = match.world["robots"]["cyan2"]["heading"]
    tab.page.keyboard.down("w")
    match.until(lambda: ahead(match, "cyan2", heading) > 1.0)
    tab.page.keyboard.up("w")
    match.until(lambda: abs(ahead(match, "cyan2", heading)) < 0.05)
    tab.page.keyboard.down("q")
    match.until(lambda: match.world["robots"]["cyan2"]["omega"] > 1.0)
    tab.page.keyboard.up("q")
    tab.page.keyboard.press("Escape")
    match.until(lambda: match.said("cyan2 is controlled by its brain again"))
    assert tab.page.locator("#drive-take").inner_text() == "Take over"


def test_a_gamepad_drives_kicks_and_dribbles(match, visit) -> None:
    tab = visit(match, "referee")
    tab.page.evaluate(
        """() => {
            const buttons = Array.from({ length: 8 }, () => ({ pressed: false }));
            window.pad = { connected: true, axes: [0, 0, 0, 0], buttons };
            navigator.getGamepads = () => [null, window.pad];
        }"""
    )
    hands = match.hear(MANUAL)
    tab.open("drive")
    tab.page.locator("#drive-robot").select_option("cyan2")
    tab.page.locator("#drive-take").click()
    tab.ask("window.pad.axes[1] = -0.5, window.pad.axes[2] = 0.05")
    match.until(lambda: any(hand.drive.vx == pytest.approx(0.75) and hand.drive.omega == 0.0 for hand in hands()))
    tab.ask("window.pad.axes[1] = 0, window.pad.axes[2] = -1")
    match.until(lambda: any(hand.drive.omega == pytest.approx(2.0) for hand in hands()))
    tab.ask("window.pad.buttons[4].pressed = true")
    match.until(lambda: any(hand.dribble for hand in hands()))
    tab.ask("window.pad.buttons[1].pressed = true")
    match.until(lambda: any(hand.kick == Kick(mode=KickMode.LOB, speed=8.0) for hand in hands()))
    assert tab.page.locator("#dribble").get_attribute("aria-pressed") == "true"


def ahead(match, robot: str, heading: float) -> float:
    truth = match.world["robots"][robot]
    return float(truth["vx"] * math.cos(heading) + truth["vy"] * math.sin(heading))


def test_a_page_takes_over_from_another_referee_and_leaves_the_seat(match, visit) -> None:
    tab = visit(match, "referee")
    with match.medium.open_bus("friendly", WallClock()) as bus:
        other = HostClient(bus)
        assert other.act(RefereeAction(action=ActionName.DROP_BALL, source="another page")).accepted
        tab.press("corner", "cyan")
        tab.wait_for_log(f"Corner, cyan refused: another page (gateway_{bus.name}) officiates; press Take over")
        tab.press("take_seat")
        tab.wait_for_log("Take over accepted")
        tab.press("goal_kick", "cyan")  # another button: a second press right after the first does not count
        tab.wait_for_log("Goal kick, cyan accepted")
        match.until(lambda: match.state.phase is Phase.GOAL_KICK)
        refused = other.act(RefereeAction(action=ActionName.DROP_BALL, source="another page"))
        assert refused.reason.startswith("referee's page (gateway_")
        tab.press("leave_seat")
        tab.wait_for_log("Leave accepted")
        assert other.act(RefereeAction(action=ActionName.DROP_BALL, source="another page")).accepted


def test_the_host_panel_names_the_numbers_of_the_match_with_their_versions(match, visit) -> None:
    tab = visit(match, "referee")
    tab.open("host")
    tab.until("document.querySelector('#health').textContent.includes('profilemsl (version ')")
    tab.until("/rules[a-z]+ \\(version \\d+\\)/.test(document.querySelector('#health').textContent)")
