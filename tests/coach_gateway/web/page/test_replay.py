"""A recording on the same page: scrubbed, stepped, at another rate, from event to event."""

import threading

import pytest

from coach_gateway.web.pages.broadcaster import PageBroadcaster
from schemas.messages.replay import ReplayReply
from schemas.messages.world import World
from schemas.soccer.game import EventKind


def world_at(replayed, time: float) -> World:
    return next(world for _, world in replayed.programme.recording.decoded("world", start=time - 0.011))


def time_of(tab) -> float:
    return float(tab.ask("window.touchline.pitchCanvas.world.time"))


def scrub(tab, time: float) -> None:
    tab.page.locator("#scrub").fill(str(time))
    tab.until(f"Math.abs(window.touchline.pitchCanvas.world.time - {time}) < 0.021")


def test_the_bar_leads_to_any_moment_and_back(replayed, visit) -> None:
    tab = visit(replayed, "referee")
    tab.until("document.getElementById('role').textContent === 'recording'")
    assert tab.page.locator("#replay").is_visible()
    for time in (8.0, 3.0, 11.5, 1.5):
        scrub(tab, time)
        world = world_at(replayed, time_of(tab))
        shown = tab.ask("window.touchline.pitchCanvas.world.robots")
        for name, robot in world.robots.items():  # paused, so to the millimetre as recorded
            assert (shown[name]["x"], shown[name]["y"]) == pytest.approx((robot.x, robot.y), abs=0.00051)


def test_a_recording_that_is_begun_paused_shows_its_first_picture(recorded, replay_file, visit) -> None:
    replay = replay_file(recorded, start=None)
    tab = visit(replay)
    first = next(world for _, world in replay.programme.recording.decoded("world"))
    assert time_of(tab) == first.time
    tab.until("window.touchline.match.replay?.paused")
    tab.page.reload()
    tab.until(f"window.touchline?.pitchCanvas.world?.time === {first.time}")


def test_a_replay_is_controlled_when_it_is_known_how_it_stands(replayed, visit, monkeypatch) -> None:
    """Until then the bar has no length: its middle would be the beginning."""
    ask, told = PageBroadcaster._ask_replay, threading.Event()

    def late(broadcaster: PageBroadcaster) -> ReplayReply:
        told.wait(30.0)
        return ask(broadcaster)

    monkeypatch.setattr(PageBroadcaster, "_ask_replay", late)
    tab = visit(replayed, "referee")
    for control in ("scrub", "play", "step", "rate", "loop", "next"):
        assert tab.page.locator(f"#{control}").is_disabled()
    tab.page.locator("#marks").click()
    tab.page.keyboard.press("Space")
    assert tab.ask("window.touchline.match.replay") is None
    told.set()
    scrub(tab, 8.0)
    assert tab.page.locator("#log li").count() == 0


def test_it_plays_pauses_steps_and_changes_its_rate(replayed, visit) -> None:
    tab = visit(replayed, "referee")
    scrub(tab, 2.0)
    tab.page.keyboard.press("Space")
    tab.until("window.touchline.pitchCanvas.world?.time > 2.5")
    assert tab.page.locator("#play").get_attribute("aria-label") == "Pause (space)"
    tab.page.locator("#play").click()
    tab.until("window.touchline.match.replay.paused")
    tab.until("Math.abs(window.touchline.pitchCanvas.world.time - window.touchline.match.replay.time) < 0.03")
    before = time_of(tab)
    tab.page.locator("#step").click()
    tab.until(f"window.touchline.pitchCanvas.world?.time > {before}")
    assert time_of(tab) == pytest.approx(before + 0.02, abs=1e-6)
    tab.page.locator("#rate").select_option("4")
    tab.until("window.touchline.match.replay.rate === 4")
    tab.page.locator("#loop").click()
    tab.until("window.touchline.match.replay.loop && document.getElementById('loop').ariaPressed === 'true'")
    tab.page.locator("#moving").focus()
    before = time_of(tab)
    tab.page.keyboard.press("ArrowRight")
    tab.until(f"window.touchline.pitchCanvas.world?.time > {before + 0.9}")


def test_each_event_of_the_list_and_each_mark_leads_to_its_moment(replayed, visit) -> None:
    tab = visit(replayed, "referee")
    tab.page.locator("#all-events").click()
    told = [event for _, event in replayed.programme.recording.decoded("game/event")]
    tab.until(f"document.querySelectorAll('#events button').length === {len(told)}")
    number = max(place for place, event in enumerate(told) if event.kind is not EventKind.PARAMETERS)
    tab.page.locator("#events button").nth(number).click()
    wanted = max(told[number].time - 2.0, 0.0)
    tab.until(f"Math.abs(window.touchline.pitchCanvas.world.time - {wanted}) < 0.021")
    marks = tab.page.locator("#marks").bounding_box()
    assert marks is not None
    tab.page.mouse.click(marks["x"] + 0.25 * marks["width"], marks["y"] + 5)
    start, end = tab.ask("[window.touchline.match.replay.start, window.touchline.match.replay.end]")
    tab.until(f"Math.abs(window.touchline.pitchCanvas.world.time - {start + 0.25 * (end - start)}) < 0.1")
    tab.page.keyboard.press("n")
    tab.until(f"window.touchline.pitchCanvas.world?.time > {start + 0.3 * (end - start)}")


def test_the_result_of_a_replay_is_that_of_the_shown_moment_and_promises_no_end(replayed, visit) -> None:
    tab = visit(replayed, "referee")
    tab.page.locator("#to-result").click()
    tab.until("document.querySelector('#result-figures td') !== null")
    assert not tab.page.locator("#result-later").is_visible()
    later = {"tick": 9000, "time": 180.0, "clock": 180.0, "kind": "foul", "rule": "pushing", "side": "cyan", "text": ""}
    fouls = tab.page.locator("#result-figures td").first.inner_text()
    tab.page.evaluate("(event) => window.touchline.match.receive({ kind: 'event', event })", later)
    tab.page.wait_for_timeout(200)
    assert tab.page.locator("#result-figures td").first.inner_text() == fouls


def test_a_spectator_of_a_replay_watches_and_sees_no_controls_of_it(replayed, visit) -> None:
    tab = visit(replayed)
    tab.until("document.getElementById('play').disabled && document.getElementById('scrub').disabled")
    before = time_of(tab)
    for key in ("n", "ArrowRight", "Space"):
        tab.page.keyboard.press(key)
    tab.page.locator("#events li").last.click()
    for control in ("#play", "#step", "#rate", "#loop", "#events button"):
        assert not tab.page.locator(control).first.is_visible()
    assert tab.page.locator("#moment").is_visible()
    assert tab.page.locator("#log li").count() == 0
    assert time_of(tab) == before


def test_a_recording_is_played_and_not_commanded(replayed, visit) -> None:
    tab = visit(replayed, "referee")
    tab.until("document.querySelector('[data-action=start]').title === 'this is a recording'")
    for panel in ("match", "coach", "drive", "settings"):
        assert not tab.page.locator(f"#to-{panel}").is_visible()
    assert not tab.page.locator("#stop").is_visible()
    assert tab.button("start").is_disabled() and tab.button("start").get_attribute("title") == "this is a recording"
