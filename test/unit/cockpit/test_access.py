"""Who may look and who may drive."""

import pytest

from cockpit_server.access import DRIVER, VIEWER, Access, gateways, without_token

HERE = Access()
LAN = Access(("localhost", "desk", "desk.local"), "drive-token", "view-token")


@pytest.mark.parametrize(
    "host", ["localhost:8080", "127.0.0.1:8080", "127.0.0.1", "[::1]:8080", "LOCALHOST:8080"]
)
def test_this_machine_has_these_names(host):
    assert HERE.is_ours(host) and LAN.is_ours(host)


@pytest.mark.parametrize(
    "host",
    [
        "evil.example:8080", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example",
        "", None, ":8080", "localhost:8080:1", "[localhost]:80", "127.0.0.1:999999", "a b",
    ],
)  # fmt: skip
def test_other_names_are_not_ours(host):
    assert not HERE.is_ours(host) and not LAN.is_ours(host)


def test_a_name_or_address_of_the_network_is_ours_only_there():
    for host in ("192.168.1.5:8080", "desk:8080", "desk.local:8080"):
        assert LAN.is_ours(host) and not HERE.is_ours(host)


def test_the_origin_must_be_the_same():
    host = "127.0.0.1:8080"
    assert HERE.may_connect(host, "http://127.0.0.1:8080")
    for other in ("http://evil.example", "http://127.0.0.1:9090", "http://localhost:8080"):
        assert not HERE.may_connect(host, other)
    for origin in ("https://127.0.0.1:8080", "null", ""):
        assert not HERE.may_connect(host, origin)
        assert not HERE.may_request(host, origin)
    # Who types the address sends none; a page that opens a WebSocket does.
    assert HERE.may_request(host, None)
    assert not HERE.may_connect(host, None)


def test_on_this_machine_everybody_drives():
    assert HERE.role(None) == HERE.role("x") == DRIVER


def test_tokens_give_roles():
    assert LAN.role("drive-token") == DRIVER
    assert LAN.role("view-token") == VIEWER
    for token in (None, "", "x", "drive-token ", "DRIVE-TOKEN", "ü"):
        assert LAN.role(token) is None


def test_a_token_is_never_logged():
    assert "secret" not in without_token("/?token=secret")
    assert "secret" not in without_token("/ws?a=1&TOKEN=secret&b=2")
    assert without_token("/ws?a=1&token=s&b=2") == "/ws?a=1&token=...&b=2"


def test_in_a_container_requests_come_from_its_gateway_or_itself():
    table = (
        "Iface Destination Gateway Flags RefCnt Use Metric Mask MTU Window IRTT\n"
        "eth0 00000000 010012AC 0003 0 0 0 00000000 0 0 0\n"
        "eth0 000012AC 00000000 0001 0 0 0 0000FFFF 0 0 0\n"
    )
    assert gateways(table) == ("172.18.0.1",)
    published = Access(peers=gateways(table))
    assert published.may_come("172.18.0.1") and published.may_come("127.0.0.1")
    assert not published.may_come("172.18.0.3") and not published.may_come("192.168.1.5")
    assert Access().may_come("192.168.1.5")


def test_a_codespace_has_an_address_of_its_own():
    page = Access(origins=("https://old-space-8080.app.github.dev",))
    assert page.may_connect("localhost:8080", "https://old-space-8080.app.github.dev")
    assert not page.may_connect("localhost:8080", "https://new-space-8080.app.github.dev")
    assert not page.may_connect("evil.example", "https://old-space-8080.app.github.dev")
