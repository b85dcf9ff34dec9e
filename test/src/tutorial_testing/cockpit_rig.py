"""The cockpit as a program, and the robot that it drives as seen by /odom."""

from tutorial_testing.nodes import node_path
from tutorial_testing.ports import free_port
from tutorial_testing.processes import Program
from tutorial_testing.robot import Robot
from tutorial_testing.rostests import RosTest
from tutorial_testing.socket_page import DRIVE, SocketPage
from tutorial_testing.waiting import wait_for


class CockpitRig(Robot):
    """A context manager that ends all that it started. The robot and joy2twist run already."""

    def __init__(self, *options):
        super().__init__("/")
        self.port = free_port()
        self._options = options

    def begin(self):
        self.listen()
        self._stack.callback(self._end)
        self.start()

    def _end(self):
        """Show what the cockpit said, which may be why a test fails."""
        print(f"the cockpit said:\n{self.program.output}")
        self.program.__exit__()

    def start(self):
        options = ("--port", str(self.port), *self._options)
        self.program = Program(node_path("cockpit", "cockpit.py"), *options)
        wait_for(self.listens, "page of the cockpit")

    def listens(self):
        """Whether the page can be opened, and the cockpit knows the robot."""
        if self.program.ended:
            raise AssertionError(f"the cockpit ended: {self.program.output}")
        try:
            with SocketPage(self.port, token=self.token("drive")) as page:
                return not page.refusal and "" in page.wait_for("hello")["robots"]
        except OSError:
            return False

    def token(self, role):
        """The token to "look" or to "drive", as it was printed; None without --lan."""
        for line in self.program.output.splitlines():
            if f"to {role}:" in line and "token=" in line:
                return line.split("token=")[1].strip()
        return None

    def page(self):
        return SocketPage(self.port, token=self.token("drive"))

    def drive(self, page):
        """Sit down, release, hold LB and the stick until the robot moves."""

        def hold():
            page.sit_down()
            page.hand = DRIVE

        self.drive_by(hold)


class WithCockpit(RosTest):
    options = ()  # cockpit options

    @classmethod
    def setUpClass(cls):
        cls.rig = CockpitRig(*cls.options).__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.rig.__exit__()
