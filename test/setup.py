from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

setup(
    **generate_distutils_setup(
        packages=[*find_packages("src"), *find_packages("faults")],
        package_dir={"": "src", "tutorial_faults": "faults/tutorial_faults"},
    )
)
