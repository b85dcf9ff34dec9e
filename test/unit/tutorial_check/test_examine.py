"""The examination by itself, in a process of its own as it always is."""

import json
import os
import subprocess
import sys

MAKE_A_FOLDER = """
import os
from tutorial_check import examine

def make_a_folder(orders, tell, told):
    os.makedirs(orders["folder"] + "/made")
    tell(mode=os.stat(orders["folder"] + "/made").st_mode & 0o777)

examine.examine = make_a_folder
examine.main()
"""


def test_others_may_read_what_it_writes_whatever_the_users_umask(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", MAKE_A_FOLDER],
        input=json.dumps({"apart": False, "folder": str(tmp_path / "scratch")}),
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=lambda: os.umask(0o077),
    )
    assert json.loads(done.stdout.splitlines()[0]) == {"mode": 0o755}, done.stderr
    assert not (tmp_path / "scratch").exists()
