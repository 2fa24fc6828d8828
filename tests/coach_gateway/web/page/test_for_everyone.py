"""The page on a phone, by keyboard, with other colour vision, in light and in dark."""

import pytest

from support.brisk import BRISK

TABS = ("robots", "events", "match", "coach", "drive", "settings", "host", "log")

UNNAMED = """[...document.querySelectorAll("button, input, select, canvas, [role=tab], [tabindex='0']")]
    .filter((one) => one.id !== "ground")
    .filter((one) => !(one.textContent.trim() || one.getAttribute("aria-label") || one.labels?.length
        || one.getAttribute("aria-labelledby")))
    .map((one) => one.outerHTML)"""

CONTRASTS = """() => {
    const light = ([r, g, b]) => [r, g, b].map((c) => c / 255)
        .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
        .reduce((sum, c, place) => sum + c * [0.2126, 0.7152, 0.0722][place], 0);
    const canvas = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
    const rgba = (colour) => {
        canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1);
        return [...canvas.getImageData(0, 0, 1, 1).data];
    };
    const behind = (node) => {
        const under = node.parentElement ? null : [255, 255, 255];
        const [r, g, b, a] = rgba(getComputedStyle(node).backgroundColor);
        if (a === 255) return [r, g, b];
        const below = under ?? behind(node.parentElement);
        return [r, g, b].map((c, place) => c * (a / 255) + below[place] * (1 - a / 255));
    };
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const poor = [];
    for (let text = texts.nextNode(); text; text = texts.nextNode()) {
        const node = text.parentElement;
        if (!text.textContent.trim() || !node.checkVisibility() || node.closest(":disabled")) continue;
        const style = getComputedStyle(node), [a, b] = [light(rgba(style.color)), light(behind(node))];
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        const large = parseFloat(style.fontSize) >= (style.fontWeight >= 700 ? 18.6 : 24);
        if (ratio < (large ? 3 : 4.5)) poor.push([text.textContent.trim(), node.className, ratio.toFixed(2)]);
    }
    return poor;
}"""


def test_a_phone_shows_everything_without_scrolling_sideways(officiated, visit, tmp_path) -> None:
    rules = tmp_path / "the_rules_of_our_own_league.toml"  # whose whole path the page shows
    rules.write_text(BRISK.read_text("utf-8"), "utf-8")
    tab = visit(officiated(rules=str(rules)), "referee", width=320, height=780, has_touch=True)
    for width in (320, 360, 768):
        tab.resize(width, 780)
        for name in TABS:
            tab.open(name)
            panel = tab.page.locator(f"#to-{name}").get_attribute("aria-controls")
            assert tab.page.locator(f"#{panel}").is_visible()
            assert tab.ask("document.documentElement.scrollWidth") <= width
            for place in ("#moving", "#stop", "#score", "#clock"):
                box = tab.page.locator(place).bounding_box()
                assert box is not None and box["x"] >= 0 and box["x"] + box["width"] <= width
        tab.page.evaluate("window.scrollTo(0, 10000)")
        assert tab.page.locator("#stop").is_visible()
        box = tab.page.locator("#stop").bounding_box()
        assert box is not None and 0 <= box["y"] < 780  # stopping is never scrolled away


def test_a_replay_fits_a_phone_too(replayed, visit) -> None:
    tab = visit(replayed, "referee")
    for width, height in ((360, 780), (844, 390)):
        tab.resize(width, height)
        assert tab.ask("document.documentElement.scrollWidth") <= width
        for place in ("#moving", "#scrub", "#play", "#next", "#rate"):
            box = tab.page.locator(place).bounding_box()
            assert box is not None and box["x"] >= 0 and box["x"] + box["width"] <= width
            assert box["y"] >= 0 and box["y"] + box["height"] <= height


def test_every_text_stands_out_from_what_is_behind_it(match, visit) -> None:
    tab = visit(match, "referee")
    schemes = ("light", "dark")
    for name in TABS[2:]:
        tab.open(name)
        for scheme in schemes:
            tab.page.emulate_media(color_scheme=scheme)
            assert tab.ask(CONTRASTS) == [], scheme
    tab.page.locator("[data-robot=cyan1] .who").click()
    tab.open("match")
    tab.button("enter").click()
    tab.until("document.querySelector('.verdict') !== null")
    for scheme in schemes:
        tab.page.emulate_media(color_scheme=scheme)
        assert tab.ask(CONTRASTS) == [], scheme


def test_every_control_has_a_name(watched) -> None:
    _, tab = watched
    for name in TABS[2:]:
        tab.open(name)
    tab.until("document.querySelectorAll('.parameter').length > 0")
    assert tab.ask(UNNAMED) == []
    ids = tab.ask("[...document.querySelectorAll('[id]')].map((one) => one.id)")
    assert len(ids) == len(set(ids))


def test_a_page_has_one_main_heading_and_names_only_what_may_have_a_name(watched) -> None:
    _, tab = watched
    assert tab.ask("[...document.querySelectorAll('h1')].map((one) => one.textContent)") == ["Blues – Reds"]
    nameless = "p:not([role]), span:not([role]), div:not([role])"  # ARIA allows these no name
    assert tab.ask(f"[...document.querySelectorAll({nameless!r})].filter((one) => one.ariaLabel).length") == 0


def test_sides_differ_in_shape_as_well_as_in_colour(watched) -> None:
    _, tab = watched
    radii = [
        tab.ask(f"getComputedStyle(document.querySelector('.mark.{side}')).borderRadius")
        for side in ("cyan", "magenta")
    ]
    assert radii[0] != radii[1]


def test_everything_is_reached_and_used_by_keyboard(match, visit) -> None:
    tab = visit(match, "referee")
    reached = set()
    tab.page.locator("#stop").focus()
    for _ in range(80):
        tab.page.keyboard.press("Tab")
        name, outline = tab.ask(
            "[document.activeElement.id || document.activeElement.dataset.action || document.activeElement.className, "
            "getComputedStyle(document.activeElement).outlineStyle]"
        )
        if name:
            assert outline != "none", name  # one sees where the focus is
        reached.add(name)
    assert {"moving", "layer-trails", "to-match", "start", "kick_off", "robot", "all-events", "who"} <= reached
    tab.page.locator("#to-match").focus()
    tab.page.keyboard.press("ArrowRight")
    assert tab.page.locator("#host").is_visible() and tab.ask("document.activeElement.id") == "to-host"
    tab.page.keyboard.press("?")
    assert tab.page.locator("#help").is_visible()
    assert "stop" in tab.page.locator("#keys").inner_text()
    tab.page.keyboard.press("Escape")
    assert not tab.page.locator("#help").is_visible()
    tab.page.locator("#layer-roles").focus()
    tab.page.keyboard.press("Enter")
    assert not tab.page.locator("#layer-roles").is_checked()


def test_what_gets_the_focus_on_a_phone_is_not_behind_the_field(match, replayed, visit) -> None:
    covered = """(() => {
        const one = document.activeElement, { x, y, width, height } = one.getBoundingClientRect();
        return !one.contains(document.elementFromPoint(x + width / 2, y + height / 2));
    })()"""
    for place in (match, replayed):
        tab = visit(place, "referee", width=390, height=844)
        tab.page.locator("#to-robots").click()
        for key in ("Tab", "Shift+Tab"):
            for _ in range(4):
                tab.page.keyboard.press(key)
                assert not tab.ask(covered), tab.ask("document.activeElement.outerHTML")


def test_what_the_field_shows_is_kept_for_the_next_visit(match, visit) -> None:
    tab = visit(match)
    tab.page.locator("#layer-passes").uncheck()
    tab.page.locator("#layer-trails").select_option("all")
    tab.page.reload()
    tab.until("window.touchline?.pitchCanvas.world")
    assert not tab.page.locator("#layer-passes").is_checked()
    assert tab.page.locator("#layer-trails").input_value() == "all"


LEAST = 3.0
"""The contrast that WCAG 2.2 asks of graphics."""


def luminance(colour: str) -> float:
    """Relative luminance of a colour `#rrggbb`, by WCAG 2.2."""
    parts = [int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return sum(share * part for share, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: str, other: str) -> float:
    dark, light = sorted((luminance(one), luminance(other)))
    return (light + 0.05) / (dark + 0.05)


def over(colour: str, ground: str, opacity: float) -> str:
    """What is seen of a colour that lets its ground through."""
    mixed = [
        round(opacity * int(colour[place : place + 2], 16) + (1 - opacity) * int(ground[place : place + 2], 16))
        for place in (1, 3, 5)
    ]
    return "#" + "".join(f"{part:02x}" for part in mixed)


@pytest.fixture(scope="module")
def palette(watched):
    _, tab = watched
    return tab.page.evaluate('async () => ({ ...await import("/shared/palette.js") })')


def test_every_mark_stands_out_from_every_shade_of_the_grass(palette) -> None:
    for ground in (*palette["GRASS"], palette["GROUND"], palette["PLAIN"]):
        marks = {"lines": palette["INK"], "ring": palette["RING"], "nose": palette["NOSE"], "holds": palette["HOLDS"]}
        marks |= {"ball": palette["BALL"]["fill"], "neutral": palette["NEUTRAL"]["fill"]}
        for side, colours in palette["SIDES"].items():
            marks |= {f"{side} hull": colours["fill"], f"{side} line": colours["line"]}
        for kept, opacity in palette["TRAIL_ALPHA"].items():
            for side, colours in palette["SIDES"].items():
                marks[f"{side} trail, {kept}"] = over(colours["line"], ground, opacity)
            marks[f"ball trail, {kept}"] = over(palette["BALL"]["trail"], ground, opacity)
        assert {name: contrast(mark, ground) for name, mark in marks.items() if contrast(mark, ground) < LEAST} == {}


def test_the_number_of_a_robot_stands_out_from_its_hull(palette) -> None:
    for colours in (*palette["SIDES"].values(), palette["NEUTRAL"]):
        assert contrast(colours["ink"], colours["fill"]) >= 4.5
