"""Which modules are changed: the rules, which know no ROS. And which tests must notice it."""

from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
# Library -> (where it is, its modules).
MODULES = {
    "joy_to_twist": (
        "joy2twist",
        "safety mapping teleoperation parameters gamepad_hints",
    ),
    "fake_turtlebot_sim": (
        "fake_turtlebot_sim",
        "mux.arbitration mux.parameters simulator.simulated_robot simulator.velocity_command"
        " simulator.differential_drive simulator.odometry_errors simulator.clock"
        " simulator.parameters",
    ),
    "gamepad": (
        "common/gamepad",
        "js_event driver.driver driver.state driver.schedule virtual.controls virtual.keyboard"
        " virtual.moves virtual.sources",
    ),
    "node_kit": ("common/node_kit", "parameters throttle newest_only arming"),
    "cockpit_server": ("common/cockpit", "seat access schema"),
}
# Tests whose names differ from that of the module; those of the own name come first anyway.
ALSO = {
    "joy_to_twist.safety": ["test_safety", "test_teleoperation"],
    "fake_turtlebot_sim.mux.parameters": ["test_mux_parameters"],
    "gamepad.js_event": ["test_js_event", "test_driver", "test_device"],
    "gamepad.driver.state": ["test_state", "test_driver"],
    "node_kit.arming": ["test_suspension"],
}
# Longer than all others together; what they find, others must find too.
NOT_RUN = "not 100_000 and not whatever_the_rate and not million"


def names():
    """The full names of all modules."""
    return [
        f"{library}.{name}" for library, (_, modules) in MODULES.items() for name in modules.split()
    ]


def path_of(module):
    """The file of a module."""
    library = module.split(".")[0]
    return REPOSITORY / MODULES[library][0] / "src" / (module.replace(".", "/") + ".py")


def tests_of(module):
    """The test files of the module's package, those most likely to notice first."""
    library, *_, name = module.split(".")
    folder = REPOSITORY / "test/unit" / Path(MODULES[library][0]).name
    first = [*ALSO.get(module, []), f"test_{name}"]
    return sorted(
        folder.glob("test_*.py"),
        key=lambda path: first.index(path.stem) if path.stem in first else len(first),
    )
