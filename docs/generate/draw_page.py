"""Takes a screenshot of the page: `python docs/generate/draw_page.py ADDRESS PICTURE [WIDTH HEIGHT [WORDS [TRAILS]]]`.

ADDRESS is printed by `touchline match --web` or `touchline replay FILE --web`. The screenshot is taken when the page's
phase, score or event list contains WORDS, or at once without WORDS; trails are `off`, `short` or `all`. In
`docs/images`, `page_live.png` and `page_phone.png` show a match with seed 9 and `--referee mixed`, `page_replay.png` a
recording of one, and `coverage.png` `examples/coverage/coverage.toml`: `ADDRESS coverage.png 1366 768 0.7 all`.
"""

import os
import shutil
import sys
import time

from playwright.sync_api import sync_playwright

PATIENCE_S = 300.0
DRAWN = "window.touchline?.pitchCanvas.world != null && window.touchline.pitchCanvas.drawn > 60"
CONTAINS = (
    "(words) => ['phase', 'score', 'events'].some((id) => document.getElementById(id).textContent.includes(words))"
)


def main(
    address: str, picture: str, width: str = "1440", height: str = "900", words: str = "", trails: str = "short"
) -> None:
    """Open the page, wait for the words, take the screenshot."""
    names = ("chromium-headless-shell", "chromium", "google-chrome")
    chromium = next(filter(None, map(shutil.which, names)), None)
    with sync_playwright() as playwright:
        root = ["--no-sandbox"] if os.geteuid() == 0 else []
        browser = playwright.chromium.launch(executable_path=chromium, args=root)
        page = browser.new_page(viewport={"width": int(width), "height": int(height)})
        page.goto(address)
        page.locator("#layer-trails").select_option(trails)
        deadline = time.monotonic() + PATIENCE_S
        while not (page.evaluate(DRAWN) and page.evaluate(CONTAINS, words)):
            if time.monotonic() > deadline:
                sys.exit(f"the page did not show {words!r} within {PATIENCE_S:.0f} s")
            page.wait_for_timeout(50)
        page.wait_for_timeout(1200)
        page.screenshot(path=picture)
        browser.close()


if __name__ == "__main__":
    if len(sys.argv) not in (3, 5, 6, 7):
        sys.exit(__doc__)
    main(*sys.argv[1:])
