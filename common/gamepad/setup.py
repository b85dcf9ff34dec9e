from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=["gamepad", "gamepad.driver", "gamepad.virtual"],
        package_dir={"": "src"},
    )
)
