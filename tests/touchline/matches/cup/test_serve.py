"""The pages of a running cup are served on this machine."""

from pathlib import Path
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest

from schemas.errors import TouchlineError
from touchline.matches.cup.serve import served


def test_pages_are_served_and_the_database_is_not(tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text("table")
    (tmp_path / "run.sqlite").write_text("secret")
    (tmp_path / "logs" / "final").mkdir(parents=True)
    (tmp_path / "logs" / "final" / "host.log").write_text("ready")
    with served(tmp_path, 0) as address:
        with urlopen(address) as page:
            assert page.read() == b"table"
            assert page.headers["Cache-Control"] == "no-store"
        with urlopen(address.removesuffix("index.html")) as page:
            assert page.read() == b"table"
        with urlopen(address.replace("index.html", "logs/final/")) as listing:
            assert b"host.log" in listing.read()
        for other in ("run.sqlite", "../run.sqlite", "logs/../run.sqlite", "logs/..", "logs/%2e%2e/", "teams/"):
            with pytest.raises(HTTPError) as refused:
                urlopen(address.replace("index.html", other))
            refused.value.close()
            assert refused.value.code == 404


def test_a_port_in_use_is_one_line(tmp_path: Path) -> None:
    with served(tmp_path, 0) as address:
        port = int(address.split(":")[2].split("/")[0])
        with pytest.raises(TouchlineError, match=f"--port is {port}: .*; give another one"), served(tmp_path, port):
            pass
