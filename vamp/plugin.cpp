#include "DetectorPlugin.h"

#include <vamp-sdk/PluginAdapter.h>

extern "C" __attribute__((visibility("default"))) const VampPluginDescriptor *
vampGetPluginDescriptor(unsigned int version, unsigned int index)
{
    static Vamp::PluginAdapter<faintline::DetectorPlugin> detector;
    return version >= 1 && index == 0 ? detector.getDescriptor() : nullptr;
}
