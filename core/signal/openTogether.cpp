#include "signal/openTogether.h"

#include "signal/Timeline.h"

namespace faintline {

RecordingPointer openTogether(const std::vector<std::string> &names, const OpenOptions &options)
{
    return std::make_shared<Timeline>(names,
                                      [options](const std::string &path) { return openRecording(path, options); });
}

} // namespace faintline
