"""Writes docs/layouts: layouts for recordings, to be imported into Foxglove and Lichtblick.

Run from the top folder: .venv/bin/python docs/generate/make_layouts.py
"""

import json
from pathlib import Path
from typing import Any

import foxglove.layouts as fl

from recordings.viz.drawing import BALL, DRAWINGS, EVENTS, FIELD, GAME, ROBOTS
from schemas.frames import MAP
from schemas.topics import STATE

FOLDER = Path(__file__).parents[1] / "layouts"
SCENES = (FIELD, ROBOTS, BALL, GAME, DRAWINGS)
DARK = "#15171c"
CAMERA: dict[str, Any] = {
    "distance": 27.0,
    "perspective": True,
    "phi": 52.0,
    "thetaOffset": 0.0,
    "target": [0.0, 0.0, 0.0],
    "targetOffset": [0.0, 1.0, 0.0],
    "targetOrientation": [0.0, 0.0, 0.0, 1.0],
    "fovy": 45.0,
    "near": 0.5,
    "far": 500.0,
}
"""The view from a stand beside the pitch, x to the right."""
BALL_PATH = '/tf.transforms[:]{child_frame_id=="ball"}.translation.'
PLOTTED = (("x", "ball x, m", "#4e98e2"), ("y", "ball y, m", "#f5774d"), ("z", "ball height, m", "#f7df71"))


def foxglove() -> str:
    """For Foxglove: layouts, import from file."""
    names = {"thetaOffset": "theta_offset", "targetOffset": "target_offset", "targetOrientation": "target_orientation"}
    camera: dict[str, Any] = {
        names.get(key, key): tuple(value) if isinstance(value, list) else value for key, value in CAMERA.items()
    }
    scene = fl.ThreeDeePanel(
        title="Pitch",
        config=fl.ThreeDeeConfig(
            camera_state=fl.ThreeDeeCameraState(**camera),
            follow_mode="follow-none",
            follow_tf=MAP,
            scene=fl.BaseRendererSceneSettings(
                background_color=DARK, transforms=fl.BaseRendererTransforms(visible=False)
            ),
            topics={topic: fl.BaseRendererSceneUpdateTopicSettings(visible=True) for topic in SCENES},
        ),
    )
    log = fl.LogPanel(title="Events", config=fl.LogConfig(topic_to_render=EVENTS, min_log_level=1, show_name=True))
    plot = fl.PlotPanel(
        title="Ball",
        config=fl.PlotConfig(
            paths=[fl.PlotSeries(value=BALL_PATH + axis, label=label, color=color) for axis, label, color in PLOTTED],
            show_legend=True,
        ),
    )
    state = fl.RawMessagesPanel(title="Game", config=fl.RawMessagesConfig(topic_path=STATE.key, expansion="all"))
    beside = fl.SplitContainer(direction="column", items=[fl.SplitItem(content=one) for one in (log, plot, state)])
    items = [fl.SplitItem(proportion=0.7, content=scene), fl.SplitItem(proportion=0.3, content=beside)]
    return _text(json.loads(fl.Layout(content=fl.SplitContainer(direction="row", items=items)).to_json()))


def lichtblick() -> str:
    """For Lichtblick: layouts, import from file."""
    scene = {
        "cameraState": CAMERA,
        "followMode": "follow-none",
        "followTf": MAP,
        "scene": {"backgroundColor": DARK, "transforms": {"visible": False, "showLabel": False}},
        "transforms": {},
        "topics": {topic: {"visible": True} for topic in SCENES},
        "layers": {},
        "foxglovePanelTitle": "Pitch",
    }
    paths = [
        {"value": BALL_PATH + axis, "enabled": True, "timestampMethod": "receiveTime", "label": label, "color": color}
        for axis, label, color in PLOTTED
    ]
    plot = {"paths": paths, "showLegend": True, "xAxisVal": "timestamp", "isSynced": True, "foxglovePanelTitle": "Ball"}
    log = {"searchTerms": [], "minLogLevel": 1, "topicToRender": EVENTS, "foxglovePanelTitle": "Events"}
    panels = {
        "3D!touchline": scene,
        "RosOut!touchline": log,
        "Plot!touchline": plot,
        "RawMessages!touchline": {"topicPath": STATE.key, "foxglovePanelTitle": "Game"},
    }
    scene_id, log_id, plot_id, state_id = panels
    beside = {
        "direction": "column",
        "splitPercentage": 34,
        "first": log_id,
        "second": {"direction": "column", "first": plot_id, "second": state_id, "splitPercentage": 50},
    }
    layout = {"direction": "row", "first": scene_id, "second": beside, "splitPercentage": 70}
    parts = {"configById": panels, "globalVariables": {}, "userNodes": {}, "playbackConfig": {"speed": 1}}
    return _text({**parts, "layout": layout})


def _text(layout: dict[str, Any]) -> str:
    return json.dumps(layout, indent=2) + "\n"


LAYOUTS = {"foxglove.json": foxglove, "lichtblick.json": lichtblick}


def main() -> None:
    """Write the files."""
    FOLDER.mkdir(exist_ok=True)
    for name, make in LAYOUTS.items():
        (FOLDER / name).write_text(make())


if __name__ == "__main__":
    main()
