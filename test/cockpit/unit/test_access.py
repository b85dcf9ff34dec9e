"""The right to look and to drive."""

import pytest

from cockpit_server.access import DRIVER, VIEWER, Access, gateways, without_token
from tutorial_testing.claims import claim

HERE = Access()
LAN = Access(("localhost", "desk", "desk.local"), "drive-token", "view-token")
CODESPACE = "https://old-space-8080.app.github.dev"
OURS = ("localhost:8080", "127.0.0.1:8080", "127.0.0.1", "[::1]:8080", "LOCALHOST:8080")
OF_THE_NETWORK = ("192.168.1.5:8080", "desk:8080", "desk.local:8080")
OTHERS = (
    "evil.example:8080", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example", "",
    None, ":8080", "localhost:8080:1", "[localhost]:80", "127.0.0.1:999999", "a b",
)  # fmt: skip


@pytest.mark.parametrize(
    ("hosts", "here", "lan"),
    [(OURS, True, True), (OF_THE_NETWORK, False, True), (OTHERS, False, False)],
)
def test_names_of_this_machine(hosts, here, lan):
    for host in hosts:
        assert (HERE.is_ours(host), LAN.is_ours(host)) == (here, lan), host


def test_a_codespace_has_an_address_of_its_own():
    page, other = Access(origins=(CODESPACE,)), CODESPACE.replace("old", "new")
    ways = [("localhost:8080", origin) for origin in (CODESPACE, other, None)]  # browsers send one
    ways.append(("evil.example", CODESPACE))
    assert [page.may_connect(*way) for way in ways] == [True, False, False, False]


def test_tokens_give_roles_and_without_tokens_every_page_drives():
    assert HERE.role(None) == HERE.role("x") == LAN.role("drive-token") == DRIVER
    assert LAN.role("view-token") == VIEWER
    for token in (None, "", "x", "drive-token ", "DRIVE-TOKEN", "ü"):
        assert LAN.role(token) is None


@claim("No token is in a log")
def test_a_token_is_not_logged():
    assert "secret" not in without_token("/?token=secret")
    assert without_token("/ws?a=1&TOKEN=s&b=2") == "/ws?a=1&TOKEN=...&b=2"


@claim("In a container only its gateway and itself are answered")
def test_in_a_container_requests_come_from_its_gateway_or_itself():
    rows = "Iface Destination Gateway", "eth0 00000000 010012AC 0003", "eth0 000012AC 00000000 0001"
    table = "\n".join(rows)
    assert gateways(table) == ("172.18.0.1",)
    published = Access(peers=gateways(table))
    assert published.may_come("172.18.0.1") and published.may_come("127.0.0.1")
    assert not published.may_come("172.18.0.3") and not published.may_come("192.168.1.5")
    assert Access().may_come("192.168.1.5")
