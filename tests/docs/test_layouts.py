"""The layouts that ship fit what a recorder writes."""

import json
import re
from pathlib import Path

import pytest

from recordings.viz.drawing import SCHEMAS
from recordings.viz.foxglove import LOG, SCENE_UPDATE
from schemas.topics import TOPICS

DOCS = Path(__file__).parents[2] / "docs"
FILES = sorted((DOCS / "layouts").glob("*.json"))


def panels(name: str) -> dict[str, dict]:
    """Panel type → its settings, in either of the two formats."""
    layout = json.loads((DOCS / "layouts" / name).read_text())
    if name == "lichtblick.json":
        assert set(layout) == {"configById", "globalVariables", "userNodes", "playbackConfig", "layout"}
        assert sorted(re.findall(r'"(\w+!\w+)"', json.dumps(layout["layout"]))) == sorted(layout["configById"])
        return {panel.split("!")[0]: settings for panel, settings in layout["configById"].items()}
    found, open_parts = {}, [layout["content"]]
    while open_parts:
        part = open_parts.pop()
        if part["type"] == "panel":
            found[part["panelType"]] = part["config"]
        open_parts += [item["content"] for item in part.get("items", [])]
    return found


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.name)
def test_every_scene_is_shown_and_every_topic_is_one_that_is_recorded(file):
    shown = panels(file.name)
    scene = shown.get("3D") or shown["ThreeDee"]
    scenes = [topic for topic, message in SCHEMAS.items() if message == SCENE_UPDATE]
    assert {topic: settings["visible"] for topic, settings in scene["topics"].items()} == dict.fromkeys(scenes, True)
    log = shown.get("RosOut") or shown["Log"]
    assert SCHEMAS[log["topicToRender"]] == LOG
    assert all(path["value"].startswith("/tf.") for path in shown["Plot"]["paths"])
    assert shown["RawMessages"]["topicPath"] in {topic.key for topic in TOPICS.values() if topic.recorded}


def test_the_files_are_what_their_script_writes(generator):
    layouts = generator("make_layouts").LAYOUTS
    assert {file.name for file in FILES} == set(layouts)
    for file in FILES:
        assert file.read_text() == layouts[file.name]()
