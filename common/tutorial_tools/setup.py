from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=[
            "tutorial_tools",
            "tutorial_tools.bag",
            "tutorial_tools.command",
            "tutorial_tools.demo",
            "tutorial_tools.doctor",
            "tutorial_tools.graph",
            "tutorial_tools.join",
        ],
        package_dir={"": "src"},
    )
)
