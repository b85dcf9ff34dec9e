"""Diagnoses are functions of facts; the first that applies counts."""

from tutorial_check import Note, Wrong, first_of


def is_negative(number):
    return Wrong("a number above 0", str(number)) if number < 0 else None


def is_large(number):
    return Note(f"large: {number}") if abs(number) > 9 else None


def test_the_first_diagnosis_that_applies_counts():
    diagnoses = (is_negative, is_large)
    assert first_of(diagnoses, -10).seen == "-10"
    assert first_of(diagnoses, 10) == Note("large: 10")
    assert first_of(diagnoses, 1) is None
