"""Turns a workspace for the handout's task into one for another variant of it: the same, right or wrong."""

import re

from edits import TURTLEBOT, J

LB = 4  # the button that programs for the handout's task may wait for
SCALES = {0: "scale_angular", 1: "scale_linear"}


def texts(src):
    """The texts of all programs and launch files of a workspace."""
    paths = [path for path in src.rglob("*") if path.is_file() and path.suffix != ".bag"]
    return [path.read_bytes().decode(errors="surrogateescape") for path in paths]


def turn(src, values):
    """Make all in a src folder as another variant asks for it."""
    for path in [each for each in src.rglob("*") if each.is_file() and each.suffix != ".bag"]:
        text = path.read_bytes().decode(errors="surrogateescape")
        here = values if J in path.parts else {"rate": values.get("rate", 10)}
        new = _turned(text, here, is_turtlebot=path.name == TURTLEBOT.rpartition("/")[2])
        if new != text:
            path.write_bytes(new.encode(errors="surrogateescape"))
    if "package" in values and (src / J).is_dir():
        (src / J).rename(src / values["package"])


def _turned(text, values, is_turtlebot):
    places = {1: values.get("axis_linear", 1), 0: values.get("axis_angular", 0)}
    left = [each for each in places.values() if each not in places]
    places.update(zip(left, [each for each in places if each not in places.values()]))

    def axis(found):
        before, number = found[1], int(found[2])
        words = [f"{before}axes[{places.get(number, number)}]"]
        words += [str(values[key]) for key in [SCALES.get(number)] if key in values]
        if "enable_button" in values and number in SCALES:
            words.append(f"{before}buttons[{values['enable_button']}]")
        return words[0] if len(words) == 1 else f"({' * '.join(words)})"

    text = text.replace(f"buttons[{LB}]", f"buttons[{values.get('enable_button', LB)}]")
    text = re.sub(r"((?:\w+\.)*)axes\[(\d)\]", axis, text)
    if "<launch" in text:
        text = _remapped(text, values, is_turtlebot)
    else:
        for key in ("joy", "cmd_vel"):
            own = values.get(key, f"/{key}")
            text = re.sub(rf"(?<=['\"])(?<!new_joy', ')/?{key}(?=['\"])", own, text)
    if "node" in values:
        text = re.sub(r"(?<=init_node\(['\"])(joy2twist|converter)", values["node"], text)
        text = re.sub(r"(?<=['\"])listener(?=['\"])", values["node"], text)
    if "package" in values:
        text = re.sub(rf"(?<![\w/]){J}(?![\w.])", values["package"], text)
    if "rate" in values:
        text = re.sub(r"Rate\(10\)|Duration\(0\.1\)", f"Rate({values['rate']})", text)
    return text


def _remapped(text, values, is_turtlebot):
    """A launch file whose nodes of the student's are connected as before."""
    own = {f"/{key}": values[key] for key in ("joy", "cmd_vel") if key in values}
    if is_turtlebot:
        text = text.replace('from="/cmd_vel"', f'from="{own.pop("/cmd_vel", "/cmd_vel")}"')
    remaps = "".join(f'<remap from="{new}" to="{old}"/>' for old, new in own.items())
    text = re.sub(rf'(<node [^>]*pkg="{J}"[^>/]*)/>', r"\1></node>", text)
    return re.sub(rf'(<node [^>]*pkg="{J}"[^>]*>)', rf"\1{remaps}", text)
