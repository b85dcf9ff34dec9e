from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=[
            "fake_turtlebot_sim",
            "fake_turtlebot_sim.mux",
            "fake_turtlebot_sim.replay",
            "fake_turtlebot_sim.safety",
            "fake_turtlebot_sim.simulator",
        ],
        package_dir={"": "src"},
    )
)
