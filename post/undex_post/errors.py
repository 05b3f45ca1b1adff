"""The one exception of this package that is meant for people."""


class Missing(Exception):
    """Something that was asked for is not there, or cannot be read; the message says what, where, and the remedy."""
