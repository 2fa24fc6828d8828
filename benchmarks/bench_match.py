"""The default match, from the command line to its end: s of play per s of wall time, launch and shutdown included."""

import json
import subprocess
import sys
import time

SECONDS = 120


def main() -> None:
    """Print the ratio to real time."""
    began = time.perf_counter()
    command = [sys.executable, "-m", "touchline", "match", "--duration", str(SECONDS), "--seed", "7", "--json"]
    command += ["--listen", "tcp/127.0.0.1:0"]
    ended = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    took = time.perf_counter() - began
    result = json.loads(ended.stdout)
    print(
        f"match: {result['duration_s']:.0f} s of play in {took:.1f} s, {result['duration_s'] / took:.1f} x real time "
        f"(at least 6); score {result['score']['cyan']} : {result['score']['magenta']}, losses {result['losses'] or 0}"
    )


if __name__ == "__main__":
    main()
