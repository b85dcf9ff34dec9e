from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(
    **generate_distutils_setup(
        packages=["tutorial_check", "tutorial_check.exercises"],
        package_data={"tutorial_check.exercises": ["course.yaml"]},
        package_dir={"": "src"},
    )
)
