"""./tutorial worker ADDRESS: check for a scheduler until Ctrl-C."""

import os
import sys

from node_kit.parameters.arguments import Parser
from tutorial_check.cluster.dask_cluster import become_worker
from tutorial_check.errors import CannotCheck


def main() -> None:
    what = "A Dask worker, for ./tutorial check --all FOLDER --cluster."
    parser = Parser(prog="./tutorial worker", description=what)
    add = parser.add_argument
    add("address", metavar="ADDRESS", help="of the scheduler, as tls://HOST:8786")
    what = "submissions at a time (one for each two processors)"
    default = max(1, (os.cpu_count() or 1) // 2)
    add("--jobs", type=int, default=default, metavar="N", help=what)
    what = "also where bubblewrap cannot isolate programs; each result says so"
    add("--not-isolated", action="store_true", help=what)
    options = parser.parse_args()
    try:
        become_worker(options.address, max(1, options.jobs), options.not_isolated)
    except (CannotCheck, OSError) as error:
        sys.exit(f"worker: {error}")


if __name__ == "__main__":
    main()
