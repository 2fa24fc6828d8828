"""A recording of the game free: its facts, its exports, and what is of soccer alone."""

import csv
from pathlib import Path

import pytest
from pytest import approx
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore

from recordings.exchange.formats import EXPORTERS
from recordings.inspection.facts_table import summary_lines
from recordings.inspection.recording_facts import facts_of
from recordings.reading.recording import Recording, open_recording
from schemas.errors import TouchlineError
from schemas.topics import STATE, WORLD
from support.free_match import free_match, record_free_match


@pytest.fixture(scope="module")
def free(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    folder = tmp_path_factory.mktemp("free")
    return open_recording(record_free_match(folder, free_match(folder, **{"task.unit": "m", "teams.cyan.name": "Us"})))


def test_the_summary_has_the_score_with_its_unit_and_the_team_that_played(free: Recording) -> None:
    facts = facts_of(free)
    *_, (_, last) = free.decoded(STATE.key)
    assert facts.value == last.value > 0.0 and facts.contradictions == []
    lines = dict(summary_lines(facts))
    assert (lines["score"], lines["teams"]) == (f"{last.value:.6g} m", "Us")
    assert "rules" not in lines


def test_the_score_is_a_column_of_the_states(free: Recording, tmp_path: Path) -> None:
    EXPORTERS["csv"].export(free, tmp_path / "tables")
    with (tmp_path / "tables" / "states.csv").open(newline="") as text:
        assert [float(row["value"]) for row in csv.DictReader(text) if row["value"]] == [
            state.value for _, state in free.decoded(STATE.key) if state.value is not None
        ]


def test_a_bag_has_the_score_and_the_frame_of_the_box_and_no_goals(free: Recording, tmp_path: Path) -> None:
    EXPORTERS["ros2"].export(free, tmp_path / "bag")
    store = get_typestore(Stores.ROS2_JAZZY)
    with Reader(tmp_path / "bag") as reader:
        read = [(one.topic, store.deserialize_cdr(data, one.msgtype)) for one, _, data in reader.messages()]
    topics = {topic for topic, _ in read}
    assert "/game/score" in topics and not {"/game/score/cyan", "/ball/odom"} & topics
    *_, last = (message for topic, message in read if topic == "/tf")
    frames = {one.child_frame_id: one.transform.translation.x for one in last.transforms}
    *_, (_, world) = free.decoded(WORLD.key)
    assert set(frames) == {"one/base_link", "two/base_link", "obstacle/box"}
    assert frames["obstacle/box"] == approx(world.obstacles["box"].x)


def test_it_has_no_log_of_the_league(free: Recording, tmp_path: Path) -> None:
    with pytest.raises(TouchlineError, match='the match is of the game "free", and this log is of soccer'):
        EXPORTERS["msl-log"].export(free, tmp_path / "log.zip")
