"""The folder of a study: plan, versions, digests, results and report; it can be published and played again."""

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd
from pydantic import ValidationError

from runtime.process.whole_file import written_whole
from schemas.config.match_config import MatchConfig
from schemas.errors import TouchlineError, os_errors
from touchline.matches.study.cells import Cell
from touchline.matches.study.digests import as_text, file_digest
from touchline.matches.study.result_table import KEYS
from touchline.matches.study.study_config import Study
from touchline.matches.study.study_plan import RECORDINGS, StudyPlan

PLAN, VERSIONS, DIGESTS = "plan.json", "versions.json", "digests.json"
CSV, PARQUET, REPORT = "results.csv", "results.parquet", "report.html"


@dataclass(frozen=True)
class StoredStudy:
    """A study that was played, read from its folder."""

    folder: Path
    plan: StudyPlan
    seeds: list[int]
    """The seeds that were played in each cell."""
    table: pd.DataFrame
    digests: Mapping[str, Any]


def write_plan(folder: Path, plan: StudyPlan) -> None:
    """Write the plan; each cell has its whole match, so that no other file is needed.

    Raises:
        TouchlineError: the folder has another study.
    """
    content = {
        "study": plan.study.model_dump(mode="json"),
        "brain_folder": os.path.relpath(plan.brain_folder, folder) if plan.brain_folder is not None else None,
        "cells": [{"levels": dict(cell.levels), "config": cell.config.model_dump(mode="json")} for cell in plan.cells],
    }
    text, path = as_text(content), folder / PLAN
    if path.exists() and _json(path).get("cells") != json.loads(text)["cells"]:
        raise TouchlineError(f"{folder} has the results of another plan; give another folder with --out, or remove it")
    with written_whole(path) as draft:
        draft.write_text(text, "utf-8")


def read_plan(folder: Path) -> StudyPlan:
    """The plan of a folder.

    Raises:
        TouchlineError: the folder has no valid plan.
    """
    content = _json(folder / PLAN)
    try:
        study = Study.model_validate(content["study"])
        cells = [Cell(one["levels"], MatchConfig.model_validate(one["config"])) for one in content["cells"]]
        home = content["brain_folder"]
    except (KeyError, TypeError, ValidationError) as error:
        fault = " ".join(str(error).split())[:200]
        raise TouchlineError(f"{folder / PLAN} is not the plan of a study: {fault}") from None
    return StudyPlan(study, cells, (folder / home).resolve() if home is not None else None)


def write_results(folder: Path, table: pd.DataFrame) -> None:
    """Write the table of results as CSV and Parquet."""
    (folder / CSV).write_bytes(csv_bytes(table))
    table.to_parquet(folder / PARQUET, index=False)


def csv_bytes(table: pd.DataFrame) -> bytes:
    """The table as CSV: equal tables give equal bytes."""
    text: str = table.to_csv(index=False, lineterminator="\n")
    return text.encode()


def write_digests(folder: Path, seeds: Sequence[int], code: Mapping[str, object]) -> None:
    """Write the digests of all files of the folder and of the code, with the seeds that were played."""
    recordings = sorted(f"{RECORDINGS}/{path.name}" for path in (folder / RECORDINGS).glob("*.mcap"))
    names = [PLAN, VERSIONS, CSV, PARQUET, REPORT, *recordings]
    files = {name: file_digest(folder / name) for name in names if (folder / name).exists()}
    (folder / DIGESTS).write_text(as_text({"seeds": list(seeds), "code": code, "files": files}), "utf-8")


def read_study(folder: Path) -> StoredStudy:
    """A study that was played.

    Raises:
        TouchlineError: a part of it is missing or invalid.
    """
    plan, digests = read_plan(folder), _json(folder / DIGESTS)
    try:
        with os_errors(folder / CSV, "run the study to its end, which writes it"):
            table = pd.read_csv(folder / CSV)
    except ValueError as error:
        raise TouchlineError(f"{folder / CSV}: no table ({error}); run the study again, which writes it") from None
    missing = [f"{DIGESTS}: {name}" for name in ("seeds", "code", "files") if name not in digests]
    missing += [f"{CSV}: {name}" for name in KEYS if name not in table]
    if missing:
        raise TouchlineError(f"{folder / missing[0]} is missing; run the study again, which writes it")
    return StoredStudy(folder, plan, digests["seeds"], table, digests)


def _json(path: Path) -> dict[str, Any]:
    try:
        with os_errors(path, "give the folder of a study that was played"):
            return dict(json.loads(path.read_text("utf-8")))
    except (ValueError, TypeError) as error:
        raise TouchlineError(
            f"{path}: no JSON object ({error}); use another copy, or remove it and run the study again"
        ) from None
