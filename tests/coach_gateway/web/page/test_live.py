"""A live match in a real browser: what is drawn is what is played."""

import itertools
import math
import re

import pytest

FILLS = {"cyan": (0x28, 0xB9, 0xDC), "magenta": (0xEF, 0x4F, 0xA0)}

PIXEL = """([x, y]) => {
    const { projection } = window.touchline.pitchCanvas, canvas = document.getElementById("moving");
    const at = [projection.x(x) * projection.density, projection.y(y) * projection.density].map(Math.round);
    return [...canvas.getContext("2d").getImageData(...at, 1, 1).data];
}"""


def shows(tab, robot: str, x: float, y: float) -> bool:
    """Whether a robot of this side is drawn there: its fill beside the number."""
    side = "cyan" if robot.startswith("cyan") else "magenta"
    around = [(0.21, 0.12), (-0.21, 0.12), (0.21, -0.12), (-0.21, -0.12)]
    pixels = [tab.page.evaluate(PIXEL, [x + dx, y + dy]) for dx, dy in around]
    return sum(all(abs(a - b) < 14 for a, b in zip(pixel, FILLS[side], strict=False)) for pixel in pixels) >= 2


def test_robots_are_drawn_where_they_are(resting, visit) -> None:
    match = resting
    tab = visit(match, "referee")
    tab.ask("window.touchline.layers.velocities = window.touchline.layers.roles = false")
    for robot in ("cyan1", "magenta1"):
        match.until(lambda robot=robot: math.hypot(*speed(match, robot)) < 0.02)
        x, y = match.where(robot)
        tab.until(f"Math.abs(window.touchline.pitchCanvas.world.robots.{robot}.x - {x}) < 0.1")
        match.until(lambda robot=robot, x=x, y=y: shows(tab, robot, x, y))  # with the picture after the message
        assert not shows(tab, robot, x, -y + 3.0)


def test_a_field_that_is_turned_shows_each_point_on_the_other_side(match, visit) -> None:
    tab = visit(match)
    as_it_lies = tab.ask("[window.touchline.pitchCanvas.projection.x(3), window.touchline.pitchCanvas.projection.y(2)]")
    tab.page.keyboard.press("v")
    tab.until("window.touchline.pitchCanvas.projection.sign === -1")
    turned = tab.ask("[window.touchline.pitchCanvas.projection.x(-3), window.touchline.pitchCanvas.projection.y(-2)]")
    assert turned == pytest.approx(as_it_lies)
    tab.page.locator("#layer-seenFrom").select_option("magenta")  # attacks −x in the first half
    tab.until("window.touchline.pitchCanvas.projection.sign === -1")
    tab.page.locator("#layer-seenFrom").select_option("cyan")
    tab.until("window.touchline.pitchCanvas.projection.sign === 1")


def test_score_clock_phase_and_half_are_those_of_the_match(match, visit) -> None:
    tab = visit(match, "referee")
    assert tab.page.locator("#cyan-name").inner_text() == "Blues"
    tab.button("goal", "magenta").click()
    tab.until("document.getElementById('score').textContent === '0 : 1'")
    tab.button("throw_in", "cyan").click()
    tab.until("document.getElementById('phase').textContent.startsWith('Throw in, Blues')")
    tab.until_seen("ball", match.state.spot.x, match.state.spot.y)
    assert tab.page.locator("#half").inner_text() == "Half 1"
    tab.button("start").click()
    match.until(lambda: match.state.running)
    before = tab.page.locator("#clock").inner_text()
    tab.until(f"document.getElementById('clock').textContent !== {before!r}")


def test_each_robot_has_a_panel(watched) -> None:
    _, tab = watched
    tab.until("document.querySelectorAll('.panel').length === 4")
    panels = tab.page.locator(".panel")
    assert [panels.nth(number).get_attribute("data-robot") for number in range(panels.count())] == [
        "cyan1", "cyan2", "magenta1", "magenta2",
    ]  # fmt: skip
    tab.until("document.querySelector('[data-robot=cyan2] .does').textContent !== ''")
    tab.until("document.querySelector('[data-robot=cyan2] [data-is=latency]').textContent.endsWith('ms')")
    tab.until("/^at .* m.s, .* has it$/.test(document.getElementById('ball-says').textContent)")
    for line, ending in (("pose", "°"), ("speed", "m/s"), ("intention", "")):
        text = tab.ask(f"document.querySelector('[data-robot=cyan2] [data-is={line}]').textContent")
        assert text and text.endswith(ending)


def test_a_robot_off_the_field_is_shown_with_the_reason(match, visit) -> None:
    tab = visit(match, "referee")
    tab.button("stop").click()
    tab.page.locator("[data-robot=magenta2] .who").click()
    tab.button("repair").click()
    tab.until("document.querySelector('[data-robot=magenta2] .badge').textContent === 'repair'")
    tab.until("document.getElementById('people').textContent.startsWith('magenta2 off: repair')")
    tab.until("document.querySelector('[data-robot=magenta2] [data-is=cards]').textContent.startsWith('off: repair')")


def test_a_robot_on_the_bench_is_drawn_beside_the_field_within_the_picture(match, visit) -> None:
    tab = visit(match, "referee")
    tab.ask("window.touchline.layers.velocities = window.touchline.layers.roles = false")
    tab.button("stop").click()
    tab.page.locator("[data-robot=magenta2] .who").click()
    tab.button("red_card").click()
    tab.until("window.touchline.pitchCanvas.world.robots.magenta2.off_field !== null")
    pitch = match.host.simulation.setup().pitch
    x, y = match.where("magenta2")
    assert abs(y) > pitch.width / 2 + pitch.border  # it stands beyond the border
    tab.until(f"Math.abs(window.touchline.pitchCanvas.world.robots.magenta2.x - {x}) < 0.05")
    drawn = tab.ask(
        """(async () => {
            const { inPicture } = await import("/shared/bodies.js");
            const { projection, world } = window.touchline.pitchCanvas;
            const { x, y } = inPicture(projection, world.robots.magenta2, 0.25);
            return [projection.x(x), projection.y(y), projection.width, projection.height, Math.abs(y)];
        })()"""
    )
    left, top, width, height, beside = drawn
    assert 8 < left < width - 8 and 8 < top < height - 8
    assert beside > pitch.width / 2  # beside the field
    tab.page.locator("[data-robot=magenta2] .who").click()  # nothing is chosen
    tab.page.evaluate("window.scrollTo(0, 0)")
    box = tab.page.locator("#moving").bounding_box()
    tab.page.mouse.click(box["x"] + left, box["y"] + top)
    assert tab.ask("window.touchline.selection.robot") == "magenta2"


def test_events_are_listed_in_their_order_and_the_newest_is_in_view(match, visit) -> None:
    tab = visit(match, "referee")
    tab.button("goal", "cyan").click()
    tab.until("document.querySelector('#events li:last-child')?.textContent.includes('Goal')")
    few = tab.page.locator("#events li").count()
    tab.page.locator("#all-events").click()
    tab.until(f"document.querySelectorAll('#events li').length > {few}")
    tab.button("goal", "magenta").click()
    tab.until(
        "[...document.querySelectorAll('#events li:has(.magenta)')]"
        ".some((line) => /Goal .*Reds/.test(line.textContent))"
    )
    texts = tab.ask("[...document.querySelectorAll('#events .what')].map((line) => line.textContent)")
    assert [text for text in texts if re.search(r"\b(cyan|magenta)\b", text)] == []  # teams are called by their names


def test_what_a_robot_believes_is_drawn_beside_what_is_true(match, visit) -> None:
    tab = visit(match, "referee")
    tab.until("window.touchline.match.radioOf('cyan2')?.self !== undefined")
    tab.until("[...document.getElementById('layer-beliefs').options].some((option) => option.value === 'cyan2')")
    tab.ask("window.touchline.layers.roles = false")
    tab.button("stop").click()
    match.until(lambda: math.hypot(*speed(match, "cyan2")) < 0.02)
    drawn = """async () => {
        const { projection, world } = window.touchline.pitchCanvas, { x, y } = world.robots.cyan2;
        const size = 60 * projection.density;
        const at = [projection.x(x), projection.y(y)].map((pixel) => Math.round(pixel * projection.density - size / 2));
        const select = document.getElementById("layer-beliefs"), canvas = document.getElementById("moving");
        const pixels = [];
        for (const whose of ["none", "cyan2", "magenta1"]) {
            select.value = whose;
            select.dispatchEvent(new Event("change"));
            for (let frame = 0; frame < 2; frame += 1) await new Promise(requestAnimationFrame);
            const { data } = canvas.getContext("2d").getImageData(...at, size, size);
            pixels.push(data.filter((value, place) => place % 4 === 3 && value > 40).length);
        }
        return pixels;
    }"""
    nothing, own, others = tab.ask(drawn)
    assert own > nothing + 20
    assert others < own - 20


def test_restart_distances_are_those_of_the_rules_while_they_matter(watched) -> None:
    match, tab = watched
    circles = """async () => {
        const { circlesOf } = await import("/field/distances.js"), { setup } = window.touchline.match;
        const of = (phase, side) => circlesOf({ phase, side }, setup);
        return { free: of("free_kick", "cyan"), drop: of("drop_ball", null), play: of("play", null) };
    }"""
    shown = tab.ask(circles)
    restarts = match.host.simulation.setup().restarts
    assert [radius for radius, _, _ in shown["free"]] == [restarts.opponent_distance, restarts.teammate_distance]
    assert [side for _, _, side in shown["free"]] == ["magenta", "cyan"]
    assert [radius for radius, _, _ in shown["drop"]] == [restarts.drop_ball_distance]
    assert shown["play"] == []


def test_the_labels_of_restart_distances_are_within_the_picture(watched) -> None:
    script = """async () => {
        const { drawDistances } = await import("/field/distances.js"), { setup } = window.touchline.match;
        const { Projection } = await import("/shared/projection.js"), projection = new Projection();
        const context = document.createElement("canvas").getContext("2d"), ends = [];
        const half = (text) => context.measureText(text).width / 2;
        context.fillText = (text, left) => ends.push(left - half(text), left + half(text));
        projection.fit(setup.pitch, 360);
        const corner = (x) => ({ setup, state: { phase: "corner", side: "cyan", spot: { x, y: 7 } } });
        for (const x of [-11, 11]) drawDistances(context, projection, corner(x));
        return [projection.width, ...ends];
    }"""
    width, *ends = watched[1].ask(script)
    assert len(ends) == 8 and all(0.0 <= end <= width for end in ends)


def test_between_two_pictures_bodies_move_evenly_and_those_set_down_jump(watched) -> None:
    script = """async () => {
        const { FrameBuffer } = await import("/link/frame_buffer.js"), frames = new FrameBuffer();
        const wrapped = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));
        const world = (tick) => ({ tick, time: 0.02 * tick, episode: 1, ball: { x: tick < 20 ? 0 : 9, y: 0, z: 0 },
            robots: { a: { x: 0.08 * tick, y: 0, z: 0, heading: wrapped(0.2 * tick) } } });
        const shown = [];
        for (let tick = 0; tick < 40; tick += 1) {
            frames.add(world(tick), 20 * tick);
            for (const later of [5, 12]) shown.push(frames.at(20 * tick + later));
        }
        const off = ({ x, heading }) => wrapped(heading - 2.5 * x);
        return shown.slice(-50).map(({ robots: { a }, ball }) => [a.x, off(a), ball.x]);
    }"""
    shown = watched[1].ask(script)
    steps = [after[0] - before[0] for before, after in itertools.pairwise(shown)]
    assert all(0.01 < step < 0.08 for step in steps)  # 0.08 m are one picture
    assert all(abs(off) < 0.01 for _, off, _ in shown)  # a heading goes the short way round
    assert {ball for _, _, ball in shown} == {0, 9}


def speed(match, robot: str) -> tuple[float, float]:
    truth = match.world["robots"][robot]
    return truth["vx"], truth["vy"]


def test_a_page_that_is_open_for_long_still_shows_new_events(match, visit) -> None:
    tab = visit(match)
    tab.page.locator("#all-events").click()
    tab.page.evaluate(
        """() => {
            for (let number = 1; number <= 5100; number += 1) {
                const text = `number ${number}.`;
                const event = { tick: number, time: 0, clock: 0, kind: "action", rule: "test", text };
                window.touchline.match.receive({ kind: "event", event });
            }
        }"""
    )
    tab.until("document.querySelector('#events').textContent.includes('number 5100.')")
    tab.page.evaluate(
        """() => window.touchline.match.receive({ kind: "event", event: {
            tick: 1, time: 0, clock: 0, kind: "action", rule: "test", text: "and one more" } })"""
    )
    tab.until("document.querySelector('#events li:last-child')?.textContent.includes('and one more')")
    inside = tab.ask(
        """(() => {
            const list = document.getElementById("events-panel").getBoundingClientRect();
            const newest = document.querySelector("#events li:last-child").getBoundingClientRect();
            return newest.bottom <= list.bottom && newest.top >= list.top;
        })()"""
    )
    assert inside
    assert tab.ask("document.querySelectorAll('#events li').length") == 400
