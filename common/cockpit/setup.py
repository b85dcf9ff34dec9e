from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=["cockpit_server", "cockpit_server.classroom", "cockpit_server.sources"],
        package_dir={"": "src"},
    )
)
