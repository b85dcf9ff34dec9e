"""The tab Robot draws the fields of the suite's turtlesim."""

from tutorial_testing.claims import claim
from tutorial_testing.waiting import wait_for

# The color at a column and row of the picture, [r, g, b].
PIXEL = """((image) => {{
    const pen = Object.assign(document.createElement("canvas"), {{width: 500, height: 500}})
      .getContext("2d");
    if (image?.complete) pen.drawImage(image, 0, 0);
    return [...pen.getImageData({}, {}, 1, 1).data].slice(0, 3);
}})(document.querySelector("#turtles [data-node='/sim'] img"))"""


@claim("Tab Robot: what turtlesims draw, which no list of ROS shows")
def test_robot_shows_background_trails_and_turtles_until_their_node_ends(world, page, ros):
    def wait_for_color(x_m, y_m, color):
        column, row = round(45 * x_m), round(499 - 45 * y_m)
        wait_for(lambda: page.ask(PIXEL.format(column, row)) == color, f"{color} at {x_m}, {y_m}")

    with world.run("rosrun", "turtlesim", "turtlesim_node", "__name:=sim", "_background_r:=9"):
        page.wait_for_text("#turtles", "/sim")
        wait_for_color(8.0, 8.0, [9, 86, 255])
        ros("rosservice", "call", "/turtle1/set_pen", "{r: 255, width: 9}")
        ros("rosservice", "call", "/turtle1/teleport_absolute", "{x: 8, y: 8}")
        wait_for_color(7.0, 7.0, [255, 0, 0])
        ros("rosservice", "call", "/turtle1/set_pen", "{'off': 1}")
        ros("rosservice", "call", "/turtle1/teleport_absolute", "{x: 2, y: 8}")
        wait_for_color(2.0, 8.0, [74, 124, 58])  # the turtle's own
        wait_for_color(5.0, 8.0, [9, 86, 255])
        assert "picture" not in ros("rosservice", "list") + ros("rostopic", "list")
    wait_for(lambda: page.text("#turtles") == "", "end")
