"""The compiled part, which nobody but the package itself calls."""

from typing import Any

def __getattr__(name: str) -> Any: ...
