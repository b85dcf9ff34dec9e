"""Settings for all tests of this package."""

from hypothesis import settings

# A slow machine is no failure: hypothesis shall not watch the clock.
settings.register_profile("fake_turtlebot_sim", deadline=None)
settings.load_profile("fake_turtlebot_sim")
