import pytest

from sim_host.missing_engine import missing_engine_text


def test_where_pybullet_has_a_binary_package_the_pip_line_is_the_remedy() -> None:
    assert missing_engine_text((3, 11)) == (
        "the simulation needs PyBullet, which is not installed; pip install 'touchline[sim]'"
    )


@pytest.mark.parametrize("python", [(3, 12), (3, 14)])
def test_where_pip_would_compile_pybullet_the_remedy_is_another_python(python: tuple[int, int]) -> None:
    assert missing_engine_text(python) == (
        f"the simulation needs PyBullet, which has no binary package for Python 3.{python[1]}; use Python 3.11: "
        "uv venv --python 3.11, and in that environment pip install 'touchline[sim]'"
    )
