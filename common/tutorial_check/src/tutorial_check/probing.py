"""Which Joys a check sends, and what the answers say that a right rule does not show. Pure."""

from tutorial_check.mapping import AXES, FIELDS, RIGHT, SMALL, judge, no_number

LB = 4  # the dead-man button of the handout's memo
BUTTONS = 12
REST = (0.0,) * AXES
FAST = (0.6, 0.7, *REST[2:])
BACK = tuple(-axis for axis in FAST)
SLOWEST = 0.25  # an axis below this may be in a dead zone, and is no measure of a factor


def numbered_joys(count, buttons=BUTTONS):
    """Joys of which no two are alike, nor any two axes: [(axes, buttons)], with LB held.

    Signs change, so that a rule which is right only forwards or to the left is found out.
    """
    joys = []
    for k in range(count):
        forwards = (0.30 + 0.021 * k) * (1 if k % 2 == 0 else -1)
        left = (0.25 + 0.017 * k) * (1 if k % 4 < 2 else -1)
        # In an order of their own, so that none of them is by chance in proportion to these two.
        rest = [0.03 + 0.05 * (index - 2) + 0.002 * (7 * k % 20) for index in range(2, AXES)]
        joys.append(((left, forwards, *rest), _pressed(LB, buttons)))
    return joys


def _pressed(*pressed, buttons=BUTTONS):
    return tuple(int(index in pressed) for index in range(buttons))


def probes(joys):
    """The Joys after the numbered ones: rest, the same twice, one axis alone, another order, LB released."""
    slow = (0.36, 0.40, *REST[2:])
    alone = [
        (*(axis if index == alone else 0.0 for index, axis in enumerate(axes)),)
        for axes in (FAST, BACK)
        for alone in RIGHT.values()
    ]
    axes = [FAST, REST, REST, *alone, slow, FAST, FAST, slow]
    return [
        *((each, _pressed(LB)) for each in axes),
        *(joys[index] for index in (7, 2)),
        *((each, _pressed()) for each in (FAST, BACK, REST)),
        (FAST, _pressed(LB)),
    ]


def small_and_button_probes():
    """The Joys after those: small values from rest and from fast, and each button pressed and released."""
    smalls = [(0.05, 0.06, *REST[2:]), (0.02, 0.03, *REST[2:]), (0.01, 0.01, *REST[2:])]
    from_rest = [axes for small in smalls for axes in (REST, small)]
    slower = [FAST, *smalls, REST, FAST, smalls[-1], REST, FAST]
    joys = [(axes, _pressed(LB)) for axes in [*from_rest, *slower]]
    for button in range(BUTTONS):
        held, free = _pressed(LB, button), _pressed(*{LB} - {button})
        joys += [(FAST, held), (REST, held), (BACK, held), (REST, free), (FAST, _pressed(LB))]
    return joys


def _other_button(buttons):
    """The button that is pressed besides LB, or None."""
    return next((index for index, value in enumerate(buttons) if value and index != LB), None)


def silence(joy, before):
    """(what is seen, what to do) for a Joy after another one that no Twist answers."""
    (axes, buttons), always = joy, "publish for every Joy, with no `if` around it"
    if joy == before:
        return "no Twist for the same Joy again", f"{always}: not only for a new one"
    other = _other_button(buttons)
    if other is not None:
        return (
            f"no Twist for a Joy with buttons[{other}] pressed: the robot drives on",
            "silence stops no robot: to stop it publish Twist(), all zero, before return",
        )
    if not buttons[LB]:
        return (
            f"no Twist for a Joy with LB released (buttons[{LB}] = 0): the robot drives on",
            "silence stops no robot: with LB released publish Twist(), all zero",
        )
    if not any(axes):
        return (
            "no Twist for a Joy at rest, all axes 0: the robot drives on",
            f"{always}: zero is what stops the robot",
        )
    still = next((f" with axes[{axis}] = 0" for axis in RIGHT.values() if not axes[axis]), "")
    return f"no Twist for a Joy{still or ' of another size'}", always


def judge_probes(samples, answers):
    """(complaint, hint) about the answers to the probes that a right start does not show, or ("", "").

    samples: as of judge(), of the numbered Joys; answers: [((axes, buttons), six values)].
    """
    odd = no_number(answers)
    if odd:
        return odd
    known = {(axes, _pressed(LB)): twist for axes, twist in samples}
    before, last_button = samples[-1][1], None
    for (axes, buttons), twist in answers:
        again, other = known.setdefault((axes, buttons), twist), _other_button(buttons)
        last_button = last_button if other is None else other
        for field in RIGHT:
            values = twist[field], before[field], again[field]
            complaint = _odd_answer(field, (axes, buttons), values, last_button)
            if complaint:
                return complaint
        before = twist
    held = [
        (axes, twist)
        for (axes, buttons), twist in answers
        if buttons == _pressed(LB) and (not any(axes) or max(map(abs, axes)) > SLOWEST)
    ]
    for axes, twist in held:
        for field, axis in RIGHT.items():
            if not axes[1 - axis] and axes[axis] and not any(twist):
                return (
                    f"{FIELDS[field]} is 0 when axes[{axis}] alone is moved",
                    f"{FIELDS[field]} = axes[{axis}], whatever the other axis is",
                )
    complaint, hint = judge([*samples, *held])
    return (complaint, hint) if complaint else ("", "")


def _odd_answer(field, joy, values, last_button):
    """(complaint, hint) about one field of an answer, or None.

    values: the answer's, that of the Joy before, and that of the same Joy when it came first.
    """
    (axes, buttons), (value, before, again) = joy, values
    given = axes[RIGHT[field]]
    name, other = FIELDS[field], _other_button(buttons)
    keeps = _is_near(value, before) and abs(value) > SMALL
    differs = not _is_near(value, again)
    # A button may turn the direction while it is held, but at rest the robot stands.
    against = value * given < 0 and other is None
    if abs(value) > SMALL and (not given or against or (keeps and differs)):
        when = f"axes[{RIGHT[field]}] is {given:.2f}" + ("" if buttons[LB] else " and LB released")
        when += "" if other is None else f" and buttons[{other}] pressed"
        return (
            f"{name} {'stays' if keeps else 'is'} {value:.2f} when {when}: the robot drives on",
            f"{name} comes from this Joy alone, zero as well: a new Twist() in the callback,"
            " no += and no `if` around the line",
        )
    if differs and last_button is not None and other is None:
        return (
            f"the same Joy gives {name} = {again:.2f} and, once buttons[{last_button}] was pressed, {value:.2f}",
            "a button changes the speed only while it is held: set the factor anew in the callback",
        )
    if differs:
        return (
            f"the same Joy gives {name} = {again:.2f} and {value:.2f}: it goes by those before",
            f"{name} comes from this Joy alone: no +=, no mean, nothing kept",
        )
    return None


def _is_near(one, other):
    return abs(one - other) <= SMALL + 0.01 * abs(other)
