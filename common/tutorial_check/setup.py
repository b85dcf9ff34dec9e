from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import find_packages, setup

setup(
    **generate_distutils_setup(
        packages=find_packages("src"),
        package_data={
            "tutorial_check": [
                "checking/*.txt",
                "checking/*.yaml",
                "commands/autograder/*",
                "sandbox/without_screen/bin/*",
                "sandbox/without_screen/view/*/rviz/*",
                "report/class_page.html",
            ]
        },
        package_dir={"": "src"},
    )
)
