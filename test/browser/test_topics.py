"""The tab Topics, and links to what a tab shows."""

import re

from tutorial_testing.waiting import wait_for


def test_a_link_shows_what_it_names_reload_keeps_it_and_back_goes_back(world, page):
    def at(place):
        wait_for(lambda: page.driver.current_url == f"{world.address}{place}", place)

    plot = "?robot=robot_7#plot?f=/odom/pose/pose/position/x&f=/odom/twist/twist/angular/z&last=60"
    page.driver.get(f"{world.address}{plot}&f=/odom/twist/twist/linear/x")
    page.wait_for_text("#plot-values", "/linear/x")
    page.press("#plot-fields li:nth-child(3) input")
    at(plot)
    page.driver.refresh()
    page.wait_for_text("#look", "robot_7 (gone)")
    page.wait_for_text("#plot-values", "/angular/z 0")
    page.tab("Log")
    at("?robot=robot_7#log")
    page.driver.back()
    at(plot)


def test_topics_shows_rates_and_messages_publishes_calls_and_sets(world, page, ros):
    page.driver.get(f"{world.address}#topics/probe")
    page.one("#topics-search").send_keys("probe")
    with world.run("rostopic", "pub", "-r", "20", "/probe", "std_msgs/String", "a"):
        cells = "[...document.querySelectorAll('#topics-rows tr td')].map((one) => one.textContent)"
        wait_for(lambda: page.ask(cells)[:3] == ["/probe", "std_msgs/String", "1"], "its row")
        wait_for(lambda: 5 < float(page.ask(cells)[4] or 0) < 20.4, "rate")  # up to 20
        rate, size = map(float, page.ask(cells)[4:])
        assert abs(size - 5 * rate) < 1  # bytes
        page.wait_for_text("#topics-echo", 'data: "a"\n---\ndata: "a"')
        page.wait_for_text("#topics-definition", "string data")
    page.click("Pause")
    page.one("#topics-fields input").send_keys("b")
    with world.run("rostopic", "echo", "-n1", "/probe") as echo:
        wait_for(lambda: page.ask(cells)[3:4] == ["1"], "its subscriber")
        page.click("Publish")
        echo.wait()
        assert 'data: "b"' in echo.output
    assert "b" not in page.text("#topics-echo")
    page.one("#topics-rate").send_keys("20")
    with world.run("rostopic", "hz", "/probe") as hz:
        wait_for(lambda: page.ask(cells)[3:4] == ["1"], "its subscriber")

        def rate():
            if page.text("#topics-send") == "Publish":  # a busy machine ends it
                page.press("#topics-send")
            return re.search(r"average rate: (1\d|2[01])\.", hz.output)

        found = wait_for(rate, "20 Hz")
        page.tab("Log")
        wait_for(lambda: "no new messages" in hz.output[found.end() :], "end with its tab")
    page.driver.get(f"{world.address}#topics/probe/rate?kind=parameters")
    ros("rosparam", "set", "/probe/rate", "[1, 2]")
    page.wait_for_text("#topics-rows", "/probe/rate")
    page.press("#topics-rows .link")
    page.wait_for_text("#topics-definition", "[1, 2]")
    page.one("#topics-fields input").clear()
    page.one("#topics-fields input").send_keys("0.5")
    page.click("Set")
    wait_for(lambda: ros("rosparam", "get", "/probe/rate") == "0.5\n", "value")
    ros("rosparam", "delete", "/probe")
    page.driver.get(f"{world.address}#topics/rosout/get_loggers?kind=services")
    page.wait_for_text("#topics-definition", "roscpp/Logger[] loggers")
    page.click("Call")
    page.wait_for_text("#topics-answer", "ros.rosout")
