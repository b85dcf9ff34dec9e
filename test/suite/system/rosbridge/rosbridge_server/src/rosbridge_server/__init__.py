from .handler import Clients  # noqa: F401  for the script
