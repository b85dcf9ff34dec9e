"""A person at the page drives the simulated robot: Stop, other pages and programs."""

from urllib.parse import urlsplit

from tutorial_testing.claims import claim
from tutorial_testing.cockpit.hands import Keys
from tutorial_testing.socket_page import REST, SocketPage
from tutorial_testing.waiting import wait_for

FULL = "0.35 m/s, 0.00 rad/s"  # at full deflection: config/f710_d.yaml

STOP_ON_TOP = """(() => {
  const box = document.getElementById("stop").getBoundingClientRect();
  const top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
  return top.id === "stop" && box.width >= 24 && box.height >= 24;
})()"""
# Whether a menu would open.
MENU = "document.body.dispatchEvent(new Event('contextmenu', {cancelable: true, bubbles: true}))"

PRESSED = "[...document.querySelectorAll('#reach [aria-pressed=true]')].map((e) => e.textContent)"


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


@claim("Keys 1 to 3 choose on any tab how far arrows push the stick: a fourth, half, whole; shown")
def test_a_key_lets_the_robot_drive_at_a_fourth_and_a_button_at_half(world, page):
    keys = Keys(page)
    speeds = {}

    def settled():
        """Return the speed once it is constant for a second."""
        speeds_now = [moment.v for moment in world.odometry[-50:]]
        return speeds_now[-1] and max(speeds_now) - min(speeds_now) < 1e-4 and speeds_now[-1]

    def measure(name):
        wait_for(lambda: page.one("#reach-now").text == f"keys: {name}", name)
        assert page.ask(PRESSED) == [name]
        keys.drive(world, until=lambda: speeds.update({name: settled()}) or speeds[name])

    keys.drive(world)
    measure("whole")
    page.click("half")
    measure("half")
    page.tab("Doctor")
    for kind in ("rawKeyDown", "keyUp"):
        page.key(kind, "Digit1")
    measure("a fourth")
    keys.release()
    world.wait_for_rest()
    shares = {name: round(speed / speeds["whole"], 3) for name, speed in speeds.items()}
    assert shares == {"whole": 1, "half": 0.5, "a fourth": 0.25}
    page.click("Stop")
    wait_for(lambda: not page.one("#reach-now").is_displayed(), "nothing about keys")
