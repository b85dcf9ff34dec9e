"""A question that rospy's nodes do not know is answered as their own are."""

from rospy.impl.masterslave import ROSHandler

from node_kit.rospy_patches.questions import answer


def test_a_node_answers_a_question_that_is_added(monkeypatch):
    monkeypatch.setattr(ROSHandler, "twice", None, raising=False)  # removed afterwards
    answer("twice", lambda value: 2 * value)
    assert ROSHandler.twice(None, "/caller", 4) == (1, "", 8)
