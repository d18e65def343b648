"""The exception that Faintline raises for invalid input and failures."""


class Error(Exception):
    """An error with its location, its reason, and what would be accepted instead.

    Attributes
    ----------
    where : str
        The file, the setting with its value, or the argument.
    why : str
        What is wrong with it and what would be accepted.
    what : str
        Both in one line, ``where: why``, as the command line shows it.
    is_mistake : bool
        True if the input is invalid (exit code 2 of the command line), False if the machine failed (1).
    field : str
        The full name of the invalid setting, as ``describe`` lists it; empty if the error is not about a setting.
    """

    def __init__(self, where: str, why: str, is_mistake: bool = True, field: str = ""):
        super().__init__(where, why, is_mistake, field)
        self.where = where
        self.why = why
        self.is_mistake = is_mistake
        self.field = field

    @property
    def what(self) -> str:
        return f"{self.where}: {self.why}"

    def __str__(self) -> str:
        return self.what
