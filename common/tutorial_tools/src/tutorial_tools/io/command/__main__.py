"""./tutorial, once Python is installed. Arguments: its workspace, then the user's."""

import sys
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(SOURCES), str(SOURCES.parents[1] / "node_kit" / "src")]
WORKSPACE, TYPED = Path(sys.argv[1]), sys.argv[2:]
# Only the modules that docker/Dockerfile has copied by then, and no bytecode that root owns.
ONLY_PACKAGES = sys.dont_write_bytecode = TYPED == ["setup", "system"]

try:
    from tutorial_tools.errors import SetUpError
    from tutorial_tools.io.system.apt import say

    if ONLY_PACKAGES:
        from tutorial_tools.io.system.packages import DONE, install, packages

        install(packages("demo", "more", "test"), WORKSPACE, again=True)
        say(DONE)
    else:
        from tutorial_tools.io.command.tutorial import main

        main(WORKSPACE, TYPED)
except KeyboardInterrupt:
    print("tutorial: interrupted; ./tutorial setup goes on where it stopped", file=sys.stderr)
    sys.exit(130)
except (SetUpError, OSError) as error:
    say(str(error))
    sys.exit(1)
