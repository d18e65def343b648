"""Track-before-detect for signals too faint to see in single frames.

    import faintline as fl

    recording = fl.open("recording.wav")
    result = fl.detect(recording, false_alarms_per_hour=1)
    result.events                    # a structured array, one record per event
    result.tracks[0].t, result.tracks[0].f
    result.statistic, result.input   # frames x cells
    result.explain(6.0, 71.0).steps  # why there is a detection, term by term

The same settings on the same recording give the same bytes as faintline-cli and the window. Invalid input raises
faintline.Error.
"""

from ._error import Error
from ._faintline import (
    Axis,
    Detector,
    Explanation,
    Frames,
    Path,
    Posterior,
    Recording,
    Result,
    Track,
    __version__,
    describe,
    detect,
    evaluate,
    forward_backward,
    open,
    presets,
    simulate,
    viterbi,
)

__all__ = [
    "Axis",
    "Detector",
    "Error",
    "Explanation",
    "Frames",
    "Path",
    "Posterior",
    "Recording",
    "Result",
    "Track",
    "describe",
    "detect",
    "evaluate",
    "forward_backward",
    "open",
    "presets",
    "simulate",
    "viterbi",
]

for _name in __all__:  # so that help() and pickle use the public name
    _object = globals()[_name]
    if isinstance(_object, type):
        _object.__module__ = __name__
del _name, _object
