"""Judge the serial port of a real Kobuki and what comes from it."""

from __future__ import annotations

from collections.abc import Iterator

from kobuki_driver.link import port_advice
from kobuki_driver.link.sample import Sample
from kobuki_driver.link.udev_rules import LATENCY_MS
from kobuki_protocol.battery import Battery, Level
from tutorial_tools.doctor.facts import Facts, Finding, ok, wrong

ABOUT = "Kobuki"
TOO_FEW = 40  # packets within a second, of 50


def kobukis(facts: Facts) -> Iterator[Finding]:
    """Judge the running drivers, or else the ports; return nothing if there are none."""
    for name, (is_alive, battery) in sorted(facts.bases.items()):
        if is_alive:
            yield ok(ABOUT, f"{name} drives a real one; its battery: {battery}")
        else:
            seen = f"{name} waits for a real one, and no packet comes from it"
            yield wrong(ABOUT, seen, "its own line says why: look at where it was started")
    for sample in facts.kobukis if not facts.bases else ():
        yield from _port(sample)
        if not sample.complaint:
            yield from _robot(sample)


def _port(sample: Sample) -> Iterator[Finding]:
    if sample.complaint:
        yield wrong(ABOUT, _said(sample.complaint))
    if not sample.has_rule:
        yield wrong(ABOUT, f"{sample.path} has no udev rule", f"run once: {port_advice.RULE}")
    if sample.latency_ms is not None and sample.latency_ms > LATENCY_MS:
        seen = f"{sample.path} keeps each packet for up to {sample.latency_ms} ms (latency timer)"
        yield wrong(ABOUT, seen, f"run once: {port_advice.RULE}; then plug the cable in again")


def _robot(sample: Sample) -> Iterator[Finding]:
    if not sample.packets:
        path, count = sample.path, sample.count
        line = port_advice.foreign(path, count, []) if count else port_advice.silent(path)
        yield wrong(ABOUT, _said(line))
        return
    seen = f"{sample.path}: {sample.packets} packets a second"
    if sample.packets < TOO_FEW or sample.damaged:
        todo = "check the cable, and try it without a USB hub"
        yield wrong(ABOUT, f"{seen} of 50, {sample.damaged} damaged", todo)
    firmware = sample.firmware
    if firmware and not firmware.is_supported:
        yield wrong(ABOUT, f"{sample.path}: firmware {firmware} is not driven", "update it")
    battery = sample.battery
    if battery and battery.level is Level.DANGEROUS:
        yield wrong(ABOUT, f"{sample.path}: {_charge(battery)}", "charge it")
    elif battery:
        yield ok(ABOUT, f"{seen}, firmware {firmware or 'unknown'}, {_charge(battery)}")


def _charge(battery: Battery) -> str:
    volts = f"battery {battery.voltage:.1f} V, {battery.percent:.0f} %"
    if battery.is_charged:
        return f"{volts}, charged ({battery.source.lower()})"
    return f"{volts}, charging ({battery.source.lower()})" if battery.is_charging else volts


def _said(line: str) -> str:
    """Return the driver's line without its promise to wait."""
    for words in (f"; {port_advice.WAITING}", f" {port_advice.WAITING.capitalize()}"):
        line = line.replace(words, "")
    return line.rstrip(".")
