from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=[
            "tutorial_faults",
            "tutorial_faults.live",
            "tutorial_testing",
            "tutorial_testing.cockpit",
            "tutorial_testing.kernel",
            "tutorial_testing.two_hosts",
        ],
        package_dir={"": "src", "tutorial_faults": "faults/tutorial_faults"},
    )
)
