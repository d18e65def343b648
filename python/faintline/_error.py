"""The one exception that Faintline raises for what a user can put right."""


class Error(Exception):
    """A refusal one can act on: what went wrong, where, and why or what would be accepted instead.

    Attributes
    ----------
    where : str
        The file, the setting with its value, or the argument.
    why : str
        What is wrong with it and what would be accepted.
    what : str
        Both in one line, ``where: why``, as the command line shows it.
    is_mistake : bool
        True where the user can put it right (the command line ends with 2), False where the machine failed (1).
    field : str
        The full name of the setting that is wrong, as ``describe`` lists it; empty where it is none.
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
