#include "bindings/bind.h"

PYBIND11_MODULE(_faintline, module)
{
    using namespace faintline::python;
    module.doc() = "The compiled part of the package faintline.";
    module.attr("__version__") = FAINTLINE_VERSION;
    for (const auto bind : {bindErrors, bindAxis, bindSettings, bindRecording, bindFrames, bindOpen, bindSimulate,
                            bindTrack, bindExplanation, bindResult, bindDetect, bindDetector, bindPaths, bindEvaluate})
        bind(module);
}
