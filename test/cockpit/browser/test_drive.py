"""A person at the page drives the simulated robot: Stop, other pages and programs."""

from urllib.parse import urlsplit

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.socket_page import REST, SocketPage

FULL = "0.35 m/s, 0.00 rad/s"  # at full deflection: config/f710_d.yaml

STOP_ON_TOP = """(() => {
  const box = document.getElementById("stop").getBoundingClientRect();
  const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
  return top.id === "stop" && box.width >= 24 && box.height >= 24;
})()"""
# Whether a menu would open.
MENU = "document.body.dispatchEvent(new Event('contextmenu', {cancelable: true, bubbles: true}))"


@claim(
    "Who drives, how fast, and Stop are above every tab; Esc ends driving; no menu opens where a "
    "page drives"
)
def test_who_drives_how_fast_and_stop_are_above_every_tab_until_esc(world, page):
    page.tab("Doctor")
    assert page.ask(MENU)

    def shown():
        speed, session = page.text("#speed"), page.text("#session")
        return (speed, session, page.ask(MENU)) == (FULL, "You drive the robot.", False)

    Keys(page).drive(world, until=shown)  # Shift and an arrow drive on any tab
    for name in page.ask("[...document.querySelectorAll('[role=tab]')].map((e) => e.textContent)"):
        page.tab(name)
        assert page.one("#session").is_displayed() and page.one("#speed").is_displayed(), name
        assert page.ask(STOP_ON_TOP), name
    Keys(page).drive(world)  # a busy machine may have stopped it meanwhile
    page.key("rawKeyDown", "Escape")
    world.wait_for_rest()
    page.wait_for_text("#session", "Nobody drives.")
    page.wait_for_text("#speed", "0.00 m/s, 0.00 rad/s")
    assert world.stays_at_rest()  # although the keys are still held


@claim("One page drives: others change nothing, and the session is handed over")
def test_a_second_page_is_refused_until_the_first_hands_over(world, page):
    with SocketPage(urlsplit(world.address).port) as second:
        second.hand = REST  # as an open page: without input it would lose the session
        Keys(page).drive(world)
        second.say("drive", robot="", mode="D")
        assert "another page drives" in second.wait_for("refused")["why"]
        page.one("#heir").send_keys(str(second.wait_for("hello")["id"]))
        page.click("Hand over")
        world.wait_for_rest()
        second.wait_for("session", lambda session: session["yours"])
        page.wait_for_text("#session", "drives the robot")
        assert world.stays_at_rest()  # although the first page still holds all
