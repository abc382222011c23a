from collections.abc import Callable
OTHERS: dict = {}
