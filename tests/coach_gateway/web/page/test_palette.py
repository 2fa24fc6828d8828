"""Every mark on the field stands out from the grass by at least 3 : 1, the contrast that WCAG 2.2 asks of graphics."""

from typing import Any

import pytest

LEAST = 3.0


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
def palette(watched: Any) -> dict[str, Any]:
    _, tab = watched
    colours: dict[str, Any] = tab.page.evaluate('async () => ({ ...await import("/shared/palette.js") })')
    return colours


def test_every_mark_stands_out_from_every_shade_of_the_grass(palette: dict[str, Any]) -> None:
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


def test_the_number_of_a_robot_stands_out_from_its_hull(palette: dict[str, Any]) -> None:
    for colours in (*palette["SIDES"].values(), palette["NEUTRAL"]):
        assert contrast(colours["ink"], colours["fill"]) >= 4.5
