"""The gateway's page in a real browser."""

import json
import time
from typing import Any

from playwright.sync_api import BrowserContext, Locator, Page

from support.page_gateway import SOON, TOKENS

_APART_S = 0.5
"""Above `APART_MS` of `coach_gateway/web/page/deeds/presses.js`, s."""

_SLOW_SCREEN = "window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 50)"
"""A screen of 20 pictures a second: at 60, half the CPU time of a test is that of drawing the field."""


_DRAWN = "window.touchline.pitchCanvas.world !== null"


class Tab:
    """The page in a browser, with its errors."""

    def __init__(self, context: BrowserContext, origin: str, role: str = "spectator", shown: str = _DRAWN) -> None:
        """`shown` holds once the page shows what is played."""
        self.context = context
        context.add_init_script(_SLOW_SCREEN)
        self.page: Page = context.new_page()
        self.faults: list[str] = []
        self._pressed: dict[tuple[str, str], float] = {}
        self.loses_its_server = False
        """Whether errors about a missing server are expected."""
        self.origin = origin
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("console", lambda line: self._note(line.text) if line.type == "error" else None)
        self.page.on("dialog", lambda dialog: self.faults.append(dialog.message))
        self.page.goto(f"{origin}/#token={TOKENS[role]}" if role in TOKENS else f"{origin}/")
        self.until(f"window.touchline?.match.role === '{role}' && {shown}")

    def _note(self, fault: str) -> None:
        if not (self.loses_its_server and "WebSocket connection to" in fault):
            self.faults.append(fault)

    def until(self, holds: str) -> None:
        """Wait for the page; its policy forbids to evaluate a text inside, so it is polled from outside."""
        deadline = time.monotonic() + SOON
        while not self.page.evaluate(holds):
            assert time.monotonic() < deadline, f"never came true: {holds}"
            self.page.wait_for_timeout(40)

    def until_seen(self, body: str, x: float, y: float) -> None:
        """Until the page draws a body, `ball` or `robots.cyan1`, at a place."""
        there = f"window.touchline.pitchCanvas.world.{body}"
        self.until(f"Math.hypot({there}.x - {x}, {there}.y - {y}) < 0.05")

    def wait_until_laid_out(self) -> None:
        """Until the field stays where it is for two frames: a press on another place may have scrolled the page."""
        place = "Object.values(document.getElementById('moving').getBoundingClientRect().toJSON()).join()"
        later = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
        self.until(f"(async () => {{ const there = {place}; await {later}; return {place} === there; }})()")

    def resize(self, width: int, height: int = 900) -> None:
        """Give the window another size, and wait until the field has that of its new place."""
        self.page.set_viewport_size({"width": width, "height": height})
        self.wait_until_laid_out()

    def ask(self, what: str) -> Any:
        return self.page.evaluate(what)

    def open(self, tab: str) -> None:
        """Open a tab; with the referee's token it may be on the operator's page."""
        opener = self.page.locator(f"#to-{tab}")
        if not opener.is_visible():
            self.page.evaluate("document.getElementById('seat').click()")  # from the referee's page, or back to it
        opener.click()

    def button(self, action: str, side: str = "") -> Locator:
        return self.page.locator(f'[data-action="{action}"][data-side="{side}"]')

    def press(self, action: str, side: str = "") -> None:
        """Press a button; not so soon after its last press that the page takes both for a double click."""
        apart = self._pressed.get((action, side), -_APART_S) + _APART_S - time.monotonic()
        if apart > 0:
            self.page.wait_for_timeout(1000 * apart)
        self.button(action, side).click()
        self._pressed[action, side] = time.monotonic()

    def wait_for_log(self, text: str) -> None:
        """Until the newest line of the log has this text."""
        try:
            self.until(f"document.querySelector('#log li')?.textContent.includes({json.dumps(text)})")
        except AssertionError:
            log = self.ask("[...document.querySelectorAll('#log li')].slice(0, 5).map((line) => line.textContent)")
            raise AssertionError(f"{text!r} is not the newest line of {log}") from None

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Where a point of the field is in the window, in pixels."""
        left, top = self.ask(
            f"[window.touchline.pitchCanvas.projection.x({x}), window.touchline.pitchCanvas.projection.y({y})]"
        )
        box = self.page.locator("#moving").bounding_box()
        assert box is not None
        return box["x"] + left, box["y"] + top

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Drag from a point of the field to another."""
        mouse = self.page.mouse
        mouse.move(*self.at(*start))
        mouse.down()
        for share in (0.3, 0.7, 1.0):
            mouse.move(*self.at(*(a + share * (b - a) for a, b in zip(start, end, strict=True))))
        self.page.evaluate("new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))")
        mouse.up()

    def touch(self, kind: str, *fingers: tuple[float, float], first: int = 0) -> None:
        """Fingers in the window, in pixels, from number `first` on: `Start`, `Move`, or `End`, of all without any."""
        if not hasattr(self, "_touching"):
            self._touching = self.context.new_cdp_session(self.page)
        points = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(fingers, first)]
        self._touching.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": points})
