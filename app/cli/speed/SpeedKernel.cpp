#include "app/cli/speed/SpeedKernel.h"

#include "app/cli/speed/kernels.h"
#include "base/Error.h"
#include "base/Random.h"

namespace faintline {

namespace {

    std::vector<SpeedKernel> makeKernels()
    {
        std::vector<SpeedKernel> kernels = recursionKernels();
        for (SpeedKernel &kernel : signalKernels())
            kernels.push_back(std::move(kernel));
        return kernels;
    }

} // namespace

std::vector<float> exponentials(std::size_t n)
{
    std::vector<float> values(n);
    Random(1, 0).exponentials(values);
    return values;
}

const std::vector<SpeedKernel> &speedKernels()
{
    static const std::vector<SpeedKernel> kernels = makeKernels();
    return kernels;
}

std::vector<SpeedKernel> speedKernels(const std::string &name)
{
    std::vector<SpeedKernel> chosen;
    std::string names;
    for (const SpeedKernel &kernel : speedKernels()) {
        if (name == "all" || kernel.name == name || kernel.name.starts_with(name + "-"))
            chosen.push_back(kernel);
        names += ", " + kernel.name;
    }
    if (chosen.empty())
        throw Error("bench " + name, "unknown kernel; choose one of all" + names);
    return chosen;
}

} // namespace faintline
