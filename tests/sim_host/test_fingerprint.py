"""The fingerprint of what computes a world differs where the world would."""

import os
import subprocess
import sys
from ast import literal_eval

_CODE = """
from schemas.config.match_config import load_match
from schemas.messages.command import Command, Drive
from sim_host.match.simulation import Simulation
from sim_host.physics.fingerprint import fingerprint
simulation = Simulation(load_match(None, {}))
ahead = {name: Drive(vx=1.0, omega=0.7) for name in simulation.roster.names}
for tick in range(40):
    simulation.step({name: Command(answers_tick=tick, drive=drive) for name, drive in ahead.items()})
print((fingerprint(), simulation.now.applied["chain"]))
"""


def computed(without: str) -> tuple[dict[str, str], str]:
    """Fingerprint and chain where numpy does not use these features of the CPU."""
    environ = {**os.environ, "NPY_DISABLE_CPU_FEATURES": without}
    run = subprocess.run([sys.executable, "-c", _CODE], env=environ, capture_output=True, text=True, check=True)
    found: tuple[dict[str, str], str] = literal_eval(run.stdout)
    return found


def test_a_cpu_that_computes_another_world_has_another_fingerprint() -> None:
    (here, chain), (there, other_chain) = computed(""), computed("X86_V3 X86_V4 AVX512_ICL AVX512_SPR")
    assert chain == other_chain or here != there
    assert {part for part in here if here[part] != there[part]} <= {"numpy"}
