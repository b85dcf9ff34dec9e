"""./tutorial scheduler: distribute the checks of check --all --cluster until Ctrl-C."""

import subprocess
import sys

from node_kit.parameters.arguments import Parser
from tutorial_check.cluster.dask_cluster import become_scheduler
from tutorial_check.errors import CannotCheck


def main() -> None:
    what = "A Dask scheduler, for ./tutorial check --all FOLDER --cluster."
    parser = Parser(prog="./tutorial scheduler", description=what)
    what = "address on which to listen (127.0.0.1)"
    parser.add_argument("--host", default="127.0.0.1", help=what)
    try:
        become_scheduler(parser.parse_args().host)
    except (CannotCheck, OSError, subprocess.SubprocessError) as error:
        sys.exit(f"scheduler: {error}")


if __name__ == "__main__":
    main()
