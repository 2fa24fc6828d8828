"""What a match's page is given once the match is over: where its recording is, then figures, replay and statistics."""

import shlex
from collections.abc import Iterator

from coach_gateway.web.pages.match_result import STATISTICS, STATISTICS_ADDRESS
from coach_gateway.web.pages.protocol import ResultUpdate
from schemas.errors import TouchlineError
from touchline.launch.processes.programs import MatchPlan


def result_parts(plan: MatchPlan) -> Iterator[ResultUpdate]:
    """The result of a match that was played, one part after another: reading a long recording takes a while."""
    if plan.recording is None:
        yield ResultUpdate()
        return
    known = ResultUpdate(replay=f"touchline replay {shlex.quote(str(plan.recording))} --web")
    yield known
    from recordings.reading.recording import open_recording
    from recordings.soccer.stats.page import page_of, write_page
    from recordings.soccer.stats.table import side_rows

    try:
        figures, page = page_of(open_recording(plan.recording))
        write_page(plan.result_folder / STATISTICS, page)
    except TouchlineError:
        return  # the recording is there, and `touchline stats` reports what is wrong with it
    rows = [(name, cyan, magenta) for name, cyan, magenta in side_rows(figures)]
    yield known.replace(figures=rows, statistics=STATISTICS_ADDRESS)
