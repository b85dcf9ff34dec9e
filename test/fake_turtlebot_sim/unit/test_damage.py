"""What a bad cable does to a serial line."""

from fake_turtlebot_sim.serial_kobuki.damage import Damage

PACKET = bytes(range(80))


def test_a_good_line_changes_nothing():
    line = Damage(drop=0.0, corrupt=0.0, stall_s=0.0)
    for k in range(1000):
        assert line.delay(line.spoil(PACKET), 0.02 * k) == PACKET


def test_a_share_is_lost_and_a_share_has_one_wrong_byte():
    line = Damage(drop=0.2, corrupt=0.1, stall_s=0.0, seed=7)
    arrived = [line.spoil(PACKET) for _ in range(10_000)]
    assert abs(arrived.count(b"") - 2000) < 200
    wrong = [data for data in arrived if data not in (b"", PACKET)]
    assert abs(len(wrong) - 800) < 150
    assert {sum(a != b for a, b in zip(data, PACKET)) for data in wrong} == {1}
    assert {len(data) for data in wrong} == {len(PACKET)}


def test_the_same_seed_does_the_same():
    first, second = (Damage(0.5, 0.5, 0.0, seed=3) for _ in range(2))
    assert [first.spoil(PACKET) for _ in range(50)] == [second.spoil(PACKET) for _ in range(50)]


def test_a_stall_holds_all_and_lets_it_through_at_once():
    line = Damage(drop=0.0, corrupt=0.0, stall_s=0.5)
    assert line.delay(b"a", 9.99) == b"a"
    assert line.delay(b"b", 10.0) == b""
    assert line.delay(b"c", 10.49) == b""
    assert line.delay(b"d", 10.5) == b"bcd"
    assert line.delay(b"e", 20.1) == b""


def test_noise_is_all_that_arrives_until_it_ends():
    line = Damage(0.0, 0.0, 0.0)
    line.switch_noise(True)
    first, second = line.spoil(PACKET), line.spoil(PACKET)
    assert b"\xaa\x55" not in first + second
    assert first != second
    assert line.spoil(b"") == b""
    line.switch_noise(False)
    assert line.spoil(PACKET) == PACKET
