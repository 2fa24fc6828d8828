"""The readings of the chosen robot's sensors, drawn on the page."""

from pathlib import Path

PROFILE = """
extends = "msl"
[robot.sensors.front]
kind = "range"
beams = { value = 1, unit = "1", origin = "test" }
span = { value = 0.1, unit = "rad", origin = "test" }
max_distance = { value = 100.0, unit = "m", origin = "test" }
"""

DRAWN = """(away) => {
    const { projection, world } = window.touchline.pitchCanvas, canvas = document.getElementById("moving");
    const { x, y, heading } = world.robots.magenta1;
    const spot = [projection.x(x + away * Math.cos(heading)), projection.y(y + away * Math.sin(heading))];
    const [left, top] = spot.map((at) => Math.round(at * projection.density));
    const { data } = canvas.getContext("2d").getImageData(left - 2, top - 2, 5, 5);
    return [...Array(25).keys()].some((pixel) => data[4 * pixel + 3] > 40);
}"""


def test_a_beam_is_drawn_from_the_chosen_robot_to_what_it_met(officiated, visit, tmp_path: Path) -> None:
    (tmp_path / "sensing.toml").write_text(PROFILE)
    tab = visit(officiated(still=True, profile=str(tmp_path / "sensing.toml")))
    tab.until("window.touchline.pitchCanvas.world !== null")
    assert not tab.page.evaluate(DRAWN, 3.0)
    tab.page.locator("[data-robot=magenta1] .who").click()
    tab.until(f"({DRAWN})(3.0) && ({DRAWN})(0.8)")
    tab.page.locator("[data-robot=magenta1] .who").click()
    tab.until(f"!({DRAWN})(3.0)")
