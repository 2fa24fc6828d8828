import json
from dataclasses import asdict, replace

from recordings.container.manifest import KeyCount
from recordings.inspection.contradictions import contradictions
from recordings.inspection.facts_table import HEADINGS, key_rows, summary_lines
from recordings.inspection.recording_facts import CUT_OFF, facts_of
from recordings.reading.recording import open_recording
from schemas.soccer.game import Phase, Score
from support.task_match import task_match
from touchline.play.match_recording import MatchRecording
from touchline.play.play_match import InProcessMatch


def test_the_facts_are_those_that_were_written(recorded):
    facts = facts_of(recorded)
    assert facts.match == "friendly"
    assert (facts.profile, facts.rules, facts.pace, facts.seed) == ("msl", "friendly", "lockstep", 7)
    assert facts.teams == {"cyan": "Team cyan", "magenta": "Team magenta"}
    assert (facts.tick, facts.duration) == (199, 3.98)
    assert facts.score == {"cyan": 1, "magenta": 0}
    assert (facts.phase, facts.ended) == ("full_time", "full_time")
    assert (facts.messages, facts.lost, facts.events) == (6 * 200 + 3, 0, 1)
    assert facts.size == recorded.path.stat().st_size
    assert facts.complete


def test_each_key_has_its_messages_rate_bytes_and_losses(rig):
    rig.play(range(20))
    rig.host.lose("world", 3)
    rig.play(range(20, 51))
    rig.leave()
    recording = rig.read()

    world = next(key for key in facts_of(recording).keys if key.key == "world")
    assert (world.message, world.messages) == ("World", 51)
    assert world.rate == 50.0
    assert world.lost == 3
    assert world.bytes == sum(len(message.payload) for message in recording.messages("world"))


def test_the_facts_of_a_cut_off_file_are_gathered_from_what_is_left(rig):
    rig.play(range(20))
    rig.host.referee(19, Phase.THROW_IN, Score(cyan=2))
    rig.host.lose("world", 3)
    rig.play(range(20, 50))
    rig.leave()
    path = rig.path.with_name("cut.mcap")
    data = rig.path.read_bytes()
    path.write_bytes(data[: data.index(b"result")])

    whole, left = facts_of(rig.read()), facts_of(open_recording(path))
    assert (left.complete, left.ended) == (False, CUT_OFF)
    assert (left.tick, left.messages, left.lost) == (whole.tick, whole.messages, 3)
    assert (left.phase, left.score) == ("throw_in", {"cyan": 2, "magenta": 0})


def test_the_facts_are_json_and_a_table(recorded):
    facts = facts_of(recorded)
    assert json.loads(json.dumps(asdict(facts)))["keys"][0]["key"] == "game/event"
    table = key_rows(facts)
    assert len(table) == 8
    assert {len(row) for row in table} == {len(HEADINGS)}
    assert dict(summary_lines(facts))["score"] == "1 : 0"


def test_a_filtered_recording_is_summarised_with_its_keys(recorded):
    facts = replace(facts_of(recorded), include=["world", "game/**"], exclude=["game/event"])
    lines = dict(summary_lines(facts))
    assert lines["keys"] == "world game/** not game/event"
    assert not {"keys", "lost on", "part", "damaged", "made"} & set(dict(summary_lines(facts_of(recorded))))


def test_the_summary_has_all_facts_in_words_and_leaves_unknown_ones_out(recorded):
    facts = replace(
        facts_of(recorded), made="filtered", part=2, drawn={"/tf": 3, "/scene": 1}, damaged=["chunk 3", "index"]
    )
    lines = dict(summary_lines(replace(facts, missed_before_start=4)))
    assert {name: lines[name] for name in ("made", "part", "for viewers", "damaged", "phase", "ended")} == {
        "made": "filtered",
        "part": "2",
        "for viewers": "/tf /scene",
        "damaged": "chunk 3, index",
        "phase": "full_time",
        "ended": "full_time",
    }
    assert lines["messages"].endswith("4 sent before it began") and lines["size"] == f"{facts.size} bytes"
    told = summary_lines(replace(facts, contradictions=["two ends", "no start"]))
    assert told[-2:] == [("contradiction", "two ends"), ("contradiction", "no start")]
    unknown = replace(facts, score=None, seed=None, profile=None, rules=None, pace=None, phase=None, teams={}, tick=-1)
    names = dict(
        summary_lines(replace(unknown, part=1, made="recorded", drawn={}, damaged=[], contradictions=[]))
    ).keys()
    assert names == {"match", "ended", "started", "duration", "messages", "events", "size"}
    assert dict(summary_lines(replace(unknown, tick=0)))["last tick"] == f"0 at {facts.time:.2f} s"
    scored = replace(facts, score={"cyan": 2, "magenta": 1}, value=0.25, unit="m")
    assert dict(summary_lines(scored))["score"] == "2 : 1, of the task 0.25 m"
    assert dict(summary_lines(replace(scored, score=None)))["score"] == "0.25 m"


def test_the_facts_of_a_task_in_soccer_are_goals_and_its_score_with_the_unit(tmp_path):
    match = InProcessMatch(task_match(tmp_path, duration=0.1, **{"task.unit": "m"}))
    recording = MatchRecording(tmp_path / "task.mcap", match.simulation.config, match.simulation)
    while not match.simulation.over:
        recording.add(match.step(), match.commands)
    recording.close()
    match.close()
    facts = facts_of(open_recording(tmp_path / "task.mcap"))
    assert (facts.score, facts.unit, facts.rules) == ({"cyan": 0, "magenta": 0}, "m", "friendly")
    assert dict(summary_lines(facts))["score"] == f"0 : 0, of the task {facts.value:.6g} m"


def test_the_summary_names_match_teams_numbers_and_losses(recorded):
    keys = facts_of(recorded).keys
    facts = replace(facts_of(recorded), keys=[replace(keys[0], lost=3), *keys[1:]], lost=3, complete=False)
    lines = dict(summary_lines(facts))
    assert lines["match"] == "friendly" and lines["teams"] == "Team cyan – Team magenta"
    assert lines["messages"] == "1203, 3 lost, 0 sent before it began" and lines["lost on"] == f"{keys[0].key} 3"
    assert lines["duration"] == "3.98 s simulated, from 0.00 to 3.98 s" and lines["last tick"] == "199 at 3.98 s"
    assert (lines["seed"], lines["pace"], lines["events"]) == ("7", "lockstep", "1")
    assert lines["size"] == f"{facts.size} bytes, cut off"


def test_a_key_of_the_result_that_the_file_lacks_is_named(rig):
    rig.play(range(20))
    rig.leave()
    recording = rig.read()
    recording.result.keys["world/other"] = KeyCount(messages=3)
    assert "world/other: 0 messages in the file, 3 in the result" in contradictions(recording)
