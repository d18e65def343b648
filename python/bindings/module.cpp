#include "bindings/bind.h"

#include "signal/formats/Hdf5File.h"

PYBIND11_MODULE(_faintline, module)
{
    using namespace faintline::python;
    faintline::Hdf5File::shareLibrary(); // with h5py
    module.doc() = "The compiled part of the package faintline.";
    module.attr("__version__") = FAINTLINE_VERSION;
    for (const auto bind : {bindErrors, bindAxis, bindSettings, bindRecording, bindFrames, bindOpen, bindSimulate,
                            bindTrack, bindExplanation, bindResult, bindDetect, bindDetector, bindPaths, bindEvaluate})
        bind(module);
}
