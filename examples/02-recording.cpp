// Finds the lines of a recording, and writes them as a table: 02-recording RECORDING EVENTS.csv
#include "analyse/analyse.h"
#include "base/Error.h"
#include "exchange/writeEvents.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "signal/openRecording.h"

#include <cstdio>
#include <string>

using namespace faintline;

int main(int argc, char **argv)
try {
    std::string path = argc > 1 ? argv[1] : "example.wav";
    if (argc < 2) { // two minutes of noise with one line, to have something to open
        LineScene scene;
        scene.sampleRateHz = 2000.0;
        scene.durationSeconds = 120.0;
        scene.seed = 7;
        scene.lines = {{.snrDb = 3.0, .startSeconds = 20.0, .durationSeconds = 80.0, .frequencyHz = 440.0}};
        writeRecording(SimulatedRecording(scene), path);
    }
    const RecordingPointer recording = openRecording(path);
    AnalysisSettings settings;
    settings.decide.falseAlarmsPerHour = 1.0;
    const auto analysis = analyse(recording, settings);
    const std::string events = argc > 2 ? argv[2] : "example.csv";
    writeEvents(*analysis, events);
    std::printf("%s: wrote %zu event(s) to %s\n", path.c_str(), analysis->tracks.size(), events.c_str());
    return 0;
} catch (const Error &error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
