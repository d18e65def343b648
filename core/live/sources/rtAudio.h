#pragma once

#include <mutex>

#include <rtaudio/RtAudio.h>

namespace faintline {

/// Hold while RtAudio lists or opens devices: its list of PulseAudio devices is shared by all threads.
std::mutex &rtAudioMutex();

/// Whether RtAudio can safely list the devices of a sound system. It keeps stale devices after a PulseAudio server
/// exits, dereferences a null pointer if the server has no default device, and lets ALSA write to standard error if
/// there is no card.
bool mayAskRtAudio(RtAudio::Api api);

} // namespace faintline
