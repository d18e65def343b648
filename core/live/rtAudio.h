#pragma once

#include <mutex>

#include <rtaudio/RtAudio.h>

namespace faintline {

/// To be held while RtAudio lists or opens devices: its list of PulseAudio's is one for all threads.
std::mutex &rtAudioMutex();

/// Whether RtAudio may be asked for the devices of a sound system. It keeps the old ones of a PulseAudio server that has
/// gone, reads through a null pointer where one has no default device, and lets ALSA write to standard error where there
/// is no card.
bool mayAskRtAudio(RtAudio::Api api);

} // namespace faintline
