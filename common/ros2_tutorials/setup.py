"""For colcon, where ROS 2 is installed."""

from setuptools import setup

PROGRAMS = ("talker", "listener", "display_joy", "publish_twist", "new_joy2twist")

setup(
    name="ros2_tutorials",
    version="1.0.0",
    packages=["ros2_tutorials"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/ros2_tutorials"]),
        ("share/ros2_tutorials", ["package.xml"]),
    ],
    install_requires=["setuptools"],
    entry_points={"console_scripts": [f"{name} = ros2_tutorials.{name}:main" for name in PROGRAMS]},
)
