"""The tab Topics, and links to what a tab shows."""

from tutorial_testing.waiting import wait_for

X = "/odom/pose/pose/position/x"


def test_a_link_shows_what_it_names_reload_keeps_it_and_back_goes_back(world, page):
    def at(place):
        wait_for(lambda: page.driver.current_url == f"{world.address}{place}", place)

    page.driver.get(f"{world.address}?robot=robot_7#plot?f={X}&f=/odom/twist/twist&last=60")
    page.wait_for_text("#plot-values", "/odom/twist/twist/angular/z")  # all numbers below it
    assert page.one("#plot-window").get_property("value") == "60"
    page.press("#plot-fields input")
    names = [f"{part}/{axis}" for part in ("linear", "angular") for axis in "xyz"]
    fields = "&".join(f"f=/odom/twist/twist/{name}" for name in names)
    plot = f"?robot=robot_7#plot?{fields}&last=60"
    at(plot)
    page.driver.refresh()
    page.wait_for_text("#look", "robot_7 (gone)")
    page.wait_for_text("#plot-values", "angular/z")
    page.tab("Log")
    at("?robot=robot_7#log")
    page.driver.back()
    at(plot)
    assert page.text("#plot-values").count("/odom") == 6
