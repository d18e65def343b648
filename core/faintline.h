#pragma once

/// The library in one file: samples or a path (`openSource`), settings, `analyse`, its events, and files of them.

#include "analyse/analyse.h"
#include "exchange/writeEvents.h"
#include "signal/ArrayRecording.h"
