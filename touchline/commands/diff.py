"""`touchline diff`: the first difference between two recordings."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from schemas.errors import TouchlineError
from touchline.commands.cli import options
from touchline.commands.cli.errors import FAILED
from touchline.launch.terminal.json_text import json_text

if TYPE_CHECKING:
    from recordings.inspection.difference import FieldDifference, RecordingComparison


def diff(
    first: Annotated[Path, typer.Argument(metavar="A", help="A recording, or any *.mcap file or bag folder.")],
    second: Annotated[Path, typer.Argument(metavar="B", help="The recording to compare with A.")],
    include: options.Include = None,
    exclude: options.Exclude = None,
    start: options.From = None,
    end: options.To = None,
    everything: Annotated[
        bool, typer.Option("--all", help="Include messages that depend on wall time: host/health, repeated answers.")
    ] = False,
    json: options.Json = False,
) -> None:
    """Find the first message in which two recordings differ; exit status 1 if there is one.

    Two lockstep runs of one match file and one seed are identical. Any other MCAP files are compared key by key,
    without their times: what was recorded, replayed and recorded again is identical if nothing was lost.

    Example: touchline diff a.mcap b.mcap --from 10 --to 20
    """
    from recordings.inspection.difference import compare, compare_logs
    from recordings.reading.log_order import is_match, open_log
    from recordings.reading.recording import open_recording

    chosen = options.selection(include, exclude)
    options.check_span(start, end)
    if is_match([first]) or is_match([second]):
        one, other = open_recording(first), open_recording(second)
        found = compare(one, other, chosen, everything=everything, start=start, end=end)
    elif start is not None or end is not None:
        raise TouchlineError("--from and --to are times of a match; cut these files by `touchline filter` first")
    else:
        logs = (open_log([path], chosen.key_of) for path in (first, second))
        found = compare_logs(*logs)
    if found.identical and not found.messages:
        raise TouchlineError(
            f"{first} and {second}: no message is selected; change --include, --exclude, --from or --to"
        )
    typer.echo(json_text(_facts(found)) if json else _sentence(found, first, second))
    if not found.identical:
        raise typer.Exit(FAILED)


def _sentence(found: "RecordingComparison", first: Path, second: Path) -> str:
    if (difference := found.first) is None:
        return f"identical: {found.messages} messages on {found.keys} keys"
    where = f"{difference.key}, message {difference.number} at {difference.time:.3f} s"
    before = f"{found.messages} messages are equal before it and on other keys"
    if difference.missing_in:
        path = first if difference.missing_in == "first" else second
        return f"different: {where} is missing in {path}; {before}"
    return "\n".join([f"different: {where}; {before}", *(f"  {_field(one)}" for one in difference.fields)])


def _field(one: "FieldDifference") -> str:
    by = f"  (by {one.by:.3g})" if one.by is not None else ""
    return f"{one.path}: {one.first!r} – {one.second!r}{by}"


def _facts(found: "RecordingComparison") -> dict[str, Any]:
    difference = found.first
    first = None
    if difference is not None:
        first = {**difference._asdict(), "fields": [{**one._asdict(), "by": one.by} for one in difference.fields]}
    return {
        "identical": found.identical,
        "messages": found.messages,
        "keys": found.keys,
        "left_out": found.left_out,
        "first": first,
    }
