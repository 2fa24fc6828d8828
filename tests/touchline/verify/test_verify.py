"""`touchline verify`: identical, or the first tick that differs, for every kind of change."""

import math
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from recordings.reading.recording import open_recording
from recordings.reading.tick_index import SkipReason, tick_index_of
from schemas.config.match_config import load_match
from schemas.config.settings import RecordOptions
from schemas.errors import TouchlineError
from support.brisk import BRISK
from touchline.commands.cli.command_line import app
from touchline.verify import resimulate, segment_check
from touchline.verify.resimulate import verify
from touchline.verify.verdict import Verdict


def run(*words: str | Path) -> Result:
    return CliRunner().invoke(app, ["verify", *map(str, words)], prog_name="touchline")


@pytest.fixture(scope="module")
def verified(operated: Path) -> Verdict:
    """The verdict on `operated`, which takes as long as to simulate it."""
    return verify(operated)


def test_a_real_match_is_identical(operated: Path, verified: Verdict) -> None:
    result = run(operated, "--jobs", "1")
    assert result.exit_code == 0
    assert result.stdout.splitlines()[0] == f"identical, {verified.ticks} ticks"
    assert f"kick-offs to start from: {len(tick_index_of(open_recording(operated)).kick_offs)}" in result.stdout


def test_a_match_with_scenes_and_parameters_is_identical_from_each_of_its_starts(
    operated: Path, verified: Verdict
) -> None:
    recording = open_recording(operated)
    index = tick_index_of(recording)
    assert len(index.starts) == 1 + len(index.kick_offs) + 3
    for segment in index.segments(0, 0):
        came = segment_check.resimulate_segment(operated, segment)
        assert came.difference is None
        assert came.ticks == len(segment.ticks) > 0
    assert verified.identical and verified.ticks == len(index.times)


def test_several_processes_give_the_verdict_of_one(operated: Path, verified, edited, at_tick, monkeypatch) -> None:
    monkeypatch.setattr(resimulate, "_WORTH_A_PROCESS", 50)
    one, two = verified, verify(operated, processes=2)
    assert two.processes == 2
    assert (one.identical, one.ticks, one.left_out) == (two.identical, two.ticks, two.left_out)
    assert one.seconds == pytest.approx(two.seconds, abs=0.2)
    wrong = edited(operated, "host/applied", at_tick(200, faster))
    alone, shared = (verify(wrong, processes=count).difference for count in (1, 2))
    assert alone is not None and shared is not None
    assert (alone.tick, alone.why, alone.details) == (shared.tick, shared.why, shared.details)
    assert alone.time == pytest.approx(shared.time)  # summed up from another start


def test_from_a_kick_off_on(operated: Path, verified: Verdict) -> None:
    first = tick_index_of(open_recording(operated)).kick_offs[0].tick
    verdict = verify(operated, from_kick_off=1)
    assert verdict.identical and verdict.ticks == verified.ticks - first
    result = run(operated, "--from-kickoff", "9")
    assert isinstance(result.exception, TouchlineError) or result.exit_code == 2


def ulp(value: float) -> float:
    return math.nextafter(value, math.inf)


def faster(fields):
    """One bit of one input."""
    drive = fields["inputs"]["cyan2"]["drive"]
    drive["vx"] = ulp(drive["vx"])
    return fields


@pytest.mark.parametrize("tick", [1, 111])
def test_one_bit_of_one_input_is_caught_at_its_tick(operated: Path, edited, at_tick, tick: int) -> None:
    result = run(edited(operated, "host/applied", at_tick(tick, faster)), "--jobs", "1")
    assert result.exit_code == 1
    said = result.stdout.splitlines()
    assert said[0].startswith(
        f"tick {tick} ({tick * 0.02:.2f} s) is the first that differs: the applied input of cyan2"
    )
    assert said[1].startswith("  input of cyan2: drive.vx is ") and "in its command" in said[1]
    assert f"identical before that: {tick} ticks" in said


@pytest.mark.slow
def test_a_command_that_was_taken_out_is_missed(operated: Path, edited) -> None:
    verdict = verify(
        edited(
            operated,
            "robot/cyan1/command",
            lambda fields: None if fields["answers_tick"] == 150 else fields,
            recount=False,
        )
    )
    assert verdict.difference is not None and verdict.difference.tick == 151
    assert verdict.difference.details[0].field == "command"


def test_an_input_that_had_no_effect_is_caught_too(operated: Path, edited, at_tick) -> None:
    def edit(fields):
        fields["inputs"]["cyan2"]["answers_tick"] -= 1
        return fields

    assert verify(edited(operated, "host/applied", at_tick(77, edit))).difference.tick == 77


def test_another_world_is_reported_by_body_field_and_amount(operated: Path, edited, at_tick) -> None:
    def edit(fields):
        fields["ball"]["x"] += 0.25
        return fields

    result = run(edited(operated, "world", at_tick(120, edit)), "--jobs", "1")
    assert result.exit_code == 1
    said = result.stdout.splitlines()
    assert said[0].endswith("the hash chain is the same, but the recorded world differs")
    assert said[1].startswith("  ball: x is ") and said[1].endswith("simulated again, 0.25 m apart")


def test_a_body_that_was_set_down_elsewhere_shows_where_it_is(operated: Path, edited, at_tick) -> None:
    def edit(fields):
        (ball,) = fields["placements"]
        ball["y"] -= 0.5
        return fields

    difference = verify(edited(operated, "host/applied", at_tick(111, edit))).difference
    assert difference.tick == 111
    y = next(detail for detail in difference.details if (detail.of, detail.field) == ("ball", "y"))
    assert y.by == pytest.approx(0.5, abs=0.01)


@pytest.mark.slow
def test_missing_ticks_are_reported_and_the_others_compared(operated: Path, verified: Verdict, edited) -> None:
    after = next(start.tick for start in tick_index_of(open_recording(operated)).starts if start.tick > 160)
    path = edited(operated, "host/applied", lambda fields: None if 150 <= fields["tick"] < 160 else fields)
    verdict = verify(path)
    assert not verdict.identical and verdict.difference is None
    assert (verdict.left_out[0].first, verdict.left_out[0].last, verdict.left_out[0].why) == (
        150,
        159,
        SkipReason.MISSING,
    )
    assert verdict.ticks == 150 + verified.ticks - after
    result = run(path, "--jobs", "1")
    assert result.exit_code == 1
    assert "ticks 150 to 159 are missing in the recording and were not verified" in result.stdout


def test_a_difference_before_missing_ticks_is_reported_by_one_process_as_by_two(operated: Path, edited) -> None:
    """What stands behind the gap is a segment of its own, and is not gone over any more."""

    def edit(fields):
        if 150 <= fields["tick"] < 160:
            return None
        return faster(fields) if fields["tick"] == 100 else fields

    path = edited(operated, "host/applied", edit)
    one, two = verify(path, processes=1), verify(path, processes=2)
    assert one.difference is not None
    assert one.difference.tick == 100
    assert (one.difference, one.ticks) == (two.difference, two.ticks)


@pytest.mark.slow
def test_a_recording_that_sets_in_late_is_compared_from_its_first_kick_off(operated: Path, edited, tmp_path) -> None:
    """Who takes part, with what numbers, and what stands there: from the setup and the world."""
    index = tick_index_of(open_recording(operated))
    kick_off = index.kick_offs[0].tick
    late = edited(operated, "host/applied", lambda fields: None if fields["tick"] < kick_off - 5 else fields)
    verdict = verify(late)
    assert verdict.difference is None, verdict.difference
    assert verdict.identical and verdict.ticks == len(index.times) - kick_off
    assert [one.why for one in verdict.left_out] == [SkipReason.BEFORE, SkipReason.NO_START]
    result = run(late, "--jobs", "1")
    assert result.exit_code == 0
    assert f"ticks {kick_off - 5} to {kick_off - 1} are before the first tick" in result.stdout


@pytest.mark.slow
def test_worlds_that_are_missing_are_counted_and_the_chain_is_compared(
    operated: Path, verified: Verdict, edited
) -> None:
    verdict = verify(edited(operated, "world", lambda fields: None if fields["tick"] % 2 else fields))
    assert verdict.identical and verdict.without_world == verified.ticks // 2


@pytest.mark.slow
def test_another_machine_is_reported_first(operated: Path, edited, json_of) -> None:
    from schemas.wire.part import encode

    def other(name, fields):
        if name != "manifest":
            return fields
        setup = json_of(fields["setup"])
        setup["engine"]["libm"] = "0" * 96
        return {**fields, "setup": encode(setup).decode()}

    said = run(edited(operated, "", lambda it: it, other), "--jobs", "1").stdout.splitlines()
    assert said[0].startswith("libm differs from the recording: 0000")
    assert said[1].startswith("identical, ")


@pytest.mark.slow
def test_the_verdict_as_json(operated: Path, edited, at_tick, json_of) -> None:
    result = run(edited(operated, "host/applied", at_tick(60, faster)), "--json", "--jobs", "1")
    verdict = json_of(result.stdout)
    assert (verdict["identical"], verdict["ticks"], verdict["difference"]["tick"]) == (False, 60, 60)
    assert verdict["difference"]["details"][0]["of"] == "input of cyan2"
    assert json_of(run(operated, "--json", "--jobs", "1").stdout)["identical"] is True


def test_a_note_that_is_no_message_is_a_difference_and_no_traceback(operated: Path, edited, at_tick) -> None:
    def edit(fields):
        fields["inputs"]["cyan1"]["drive"]["vx"] = "fast"
        return fields

    difference = verify(edited(operated, "host/applied", at_tick(90, edit))).difference
    assert difference.tick == 90 and difference.why.startswith("this tick is impossible: Applied: ")


def test_a_recording_of_no_notes_cannot_be_verified(operated: Path, edited) -> None:
    with pytest.raises(TouchlineError, match="no tick can be simulated again"):
        verify(edited(operated, "host/applied", lambda _: None))


@pytest.mark.slow
def test_a_cut_off_recording_is_compared_up_to_the_cut(operated: Path, verified: Verdict, tmp_path: Path) -> None:
    content = operated.read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(content[: len(content) * 2 // 3])
    verdict = verify(cut)
    assert any("cut off" in one for one in verdict.not_checked)
    assert verdict.identical and 100 < verdict.ticks < verified.ticks


def test_a_later_part_is_compared_from_its_first_start(tmp_path: Path, match_recorder, operate) -> None:
    """A later part begins with what stood then: who takes part, numbers that were changed, the world before."""
    teams = {"teams.cyan.size": 1, "teams.magenta.size": 1}
    config = load_match(None, {"seed": 3, "duration": 10.0, "rules": str(BRISK), **teams})
    match_recorder(tmp_path / "m.mcap", config, until=5.5, between=operate, options=RecordOptions(part_duration=4.0))
    second = tmp_path / "m.2.mcap"
    verdict = verify(second)
    assert verdict.identical and verdict.difference is None
    start = next(start for start in tick_index_of(open_recording(second)).starts if start.tick > 0)
    assert [one.tick for one in start.changes] == [0, 171]
    assert verdict.ticks == 276 - start.tick
    assert [one.why for one in verdict.left_out] == [SkipReason.BEFORE, SkipReason.NO_START]
