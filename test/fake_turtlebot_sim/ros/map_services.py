"""The map's topics and services, like those of map_server."""

import rospy
from nav_msgs.msg import MapMetaData, OccupancyGrid
from nav_msgs.srv import GetMap, LoadMap
from rosgraph_msgs.msg import Log

from tutorial_testing.claims import claim
from tutorial_testing.rostests import RosTest
from tutorial_testing.waiting import wait_for

ABOUT = "resolution: 0.05\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
FAILURE = 255  # map_server has no other


def write_map(folder, name, size):
    """Write a square map that is free except for its first row; return its YAML file."""
    shades = bytes(size) + b"\xfe" * (size * (size - 1))
    (folder / f"{name}.pgm").write_bytes(b"P5 %d %d 255\n" % (size, size) + shades)
    path = folder / f"{name}.yaml"
    path.write_text(f"{ABOUT}image: {name}.pgm\norigin: [-1, -1, 0]\n")
    return path


class MapServicesTest(RosTest):
    @claim("The map has the topics and services of map_server")
    def test_services_give_and_change_what_is_published(self):
        folder = self.folder()
        first, second = write_map(folder, "first", 40), write_map(folder, "second", 50)
        self.start("rosrun", "fake_turtlebot_sim", "fake_turtlebot.py", f"_world:={first}")
        grids, infos = self.record("map", OccupancyGrid), self.record("map_metadata", MapMetaData)
        logs = self.record("/rosout", Log)
        rospy.wait_for_service("change_map")
        static_map = rospy.ServiceProxy("static_map", GetMap)
        change_map = rospy.ServiceProxy("change_map", LoadMap)

        def check(size):
            wait_for(lambda: grids and grids[-1].info.width == size, f"map of {size} columns")
            wait_for(lambda: infos and infos[-1] == grids[-1].info, "its metadata")
            self.assertEqual(static_map().map, grids[-1])
            self.assertEqual(grids[-1].data.count(100), size)

        check(40)
        self.assertEqual(change_map(str(second)).result, 0)
        check(50)
        self.assertEqual(grids[-1].header.frame_id, "map")
        for path in (folder / "third.yaml", f"file://{first}"):  # map_server accepts a path, too
            self.assertEqual(change_map(str(path)).result, FAILURE)
            words = f"change_map: {path}: cannot be read: No such file"
            wait_for(lambda words=words: any(words in log.msg for log in list(logs)), words)
        check(50)
