#include "DetectorPlugin.h"

#include "analyse/analyse.h"
#include "analyse/events.h"
#include "base/Error.h"
#include "exchange/writeEvents.h"
#include "plan/slopeUnit.h"
#include "signal/ArrayRecording.h"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <thread>

namespace faintline {

namespace {

    /// What hosts show as sliders: the setting, its label, its default (that of the preset `lines`), and its range.
    struct Parameter {
        const char *setting;
        const char *identifier;
        const char *name;
        const char *unit;
        float least, most, byDefault;
    };
    constexpr Parameter parameters[]{
        {"decide.falseAlarmsPerHour", "falsealarms", "False alarms per hour", "1/h", 0.001f, 1000.0f, 1.0f},
        {"spectrogram.windowSeconds", "window", "Window (0: chosen from the recording)", "s", 0.0f, 1000.0f, 0.0f},
        {"selection.lowHz", "low", "Lower edge of the band", "Hz", 0.0f, 1e6f, 0.0f},
        {"selection.highHz", "high", "Upper edge of the band (0: whole band)", "Hz", 0.0f, 1e6f, 0.0f},
    };

    constexpr Index mostGridValues = Index(1) << 26;

    const Parameter *parameterOf(const std::string &identifier)
    {
        const auto found = std::find_if(std::begin(parameters), std::end(parameters),
                                        [&](const Parameter &each) { return identifier == each.identifier; });
        return found == std::end(parameters) ? nullptr : found;
    }

    Vamp::Plugin::OutputDescriptor output(const char *identifier, const char *name, const char *description)
    {
        Vamp::Plugin::OutputDescriptor descriptor;
        descriptor.identifier = identifier;
        descriptor.name = name;
        descriptor.description = description;
        descriptor.unit = "Hz";
        descriptor.hasFixedBinCount = true;
        descriptor.binCount = 1;
        descriptor.hasKnownExtents = false;
        descriptor.isQuantized = false;
        descriptor.sampleType = Vamp::Plugin::OutputDescriptor::VariableSampleRate;
        descriptor.sampleRate = 0.0f;
        return descriptor;
    }

    Vamp::Plugin::Feature featureAt(double seconds)
    {
        Vamp::Plugin::Feature feature;
        feature.hasTimestamp = true;
        feature.timestamp = Vamp::RealTime::fromSeconds(seconds);
        return feature;
    }

} // namespace

std::string DetectorPlugin::getDescription() const
{
    return "Finds faint lines that drift and wander, by track-before-detect";
}

Vamp::Plugin::ParameterList DetectorPlugin::getParameterDescriptors() const
{
    ParameterList list;
    for (const Parameter &each : parameters) {
        ParameterDescriptor descriptor;
        descriptor.identifier = each.identifier;
        descriptor.name = each.name;
        descriptor.description = settingField(each.setting).sentence;
        descriptor.unit = each.unit;
        descriptor.minValue = each.least;
        descriptor.maxValue = each.most;
        descriptor.defaultValue = each.byDefault;
        list.push_back(descriptor);
    }
    return list;
}

float DetectorPlugin::getParameter(std::string identifier) const
{
    const auto set = m_parameters.find(identifier);
    const Parameter *parameter = parameterOf(identifier);
    return set != m_parameters.end() ? set->second : parameter ? parameter->byDefault : 0.0f;
}

void DetectorPlugin::setParameter(std::string identifier, float value)
{
    const Parameter *parameter = parameterOf(identifier);
    if (!parameter)
        return;
    if (value == parameter->byDefault) // hosts set all parameters; defaults are left to the preset
        m_parameters.erase(identifier);
    else
        m_parameters[identifier] = value;
}

Vamp::Plugin::ProgramList DetectorPlugin::getPrograms() const
{
    ProgramList names;
    for (const Preset &preset : presets())
        if (!preset.name.starts_with("sonar") && preset.name != "radar") // these presets need frames with several axes
            names.push_back(preset.name);
    return names;
}

void DetectorPlugin::selectProgram(std::string name)
{
    const ProgramList known = getPrograms();
    if (std::find(known.begin(), known.end(), name) != known.end())
        m_program = name;
}

Vamp::Plugin::OutputList DetectorPlugin::getOutputDescriptors() const
{
    OutputDescriptor events = output("events", "Events", "Each signal that was detected, from onset to end");
    events.hasDuration = true;
    OutputDescriptor tracks = output("tracks", "Tracks", "The frequency of each signal, frame by frame");
    OutputDescriptor statistic = output("statistic", "Statistic", "What the threshold cuts, over time and frequency");
    statistic.unit = "nat";
    statistic.hasFixedBinCount = false;
    return {events, tracks, statistic};
}

bool DetectorPlugin::initialise(std::size_t channels, std::size_t stepSize, std::size_t blockSize)
{
    m_blockSize = blockSize;
    reset();
    return channels == 1 && blockSize > 0 && stepSize == blockSize;
}

void DetectorPlugin::reset()
{
    m_samples.clear();
}

Vamp::Plugin::FeatureSet DetectorPlugin::process(const float *const *inputBuffers, Vamp::RealTime)
{
    m_samples.insert(m_samples.end(), inputBuffers[0], inputBuffers[0] + m_blockSize);
    return {};
}

/// The samples without the zeros with which the host padded the last block.
std::vector<float> DetectorPlugin::samples() const
{
    std::vector<float> samples = m_samples;
    const std::size_t least = samples.size() - std::min(samples.size(), m_blockSize);
    while (samples.size() > least && samples.back() == 0.0f)
        samples.pop_back();
    return samples;
}

AnalysisSettings DetectorPlugin::settings() const
{
    AnalysisSettings settings = preset(m_program).settings;
    for (const auto &[identifier, value] : m_parameters) {
        std::ostringstream text; // the shortest number of that float: 0.1, not 0.10000000149
        text << value;
        setSetting(settings, parameterOf(identifier)->setting, text.str());
    }
    checkSettings(settings);
    return settings;
}

DetectorPlugin::Found DetectorPlugin::search() const
{
    const auto held = std::make_shared<const std::vector<float>>(samples());
    ArrayLayout layout;
    layout.sampleRateHz = m_rateHz;
    layout.sampleCount = std::ssize(*held);
    const auto recording = std::make_shared<ArrayRecording>("recording of the host",
                                                            std::shared_ptr<const float>(held, held->data()), layout);
    RunContext context;
    context.threads = std::max(1, int(std::thread::hardware_concurrency()));
    Found found;
    found.analysis = analyse(recording, settings(), {.depth = AnalysisDepth::Tracks}, context);
    const Index cells = found.analysis->grid().size();
    if (found.analysis->time().count > mostGridValues / cells) {
        std::fprintf(stderr, "faintline: the statistic has too many values for a host; choose a narrower band\n");
        return found;
    }
    const StatisticSink keep = [&](Index, std::span<const float> values) {
        for (Index at = 0; at < std::ssize(values); at += cells)
            found.statistic.emplace_back(values.begin() + at, values.begin() + at + cells);
    };
    analyse(recording, found.analysis->settings,
            {.previous = found.analysis.get(), .statistic = keep, .depth = AnalysisDepth::Trial}, context);
    return found;
}

Vamp::Plugin::FeatureSet DetectorPlugin::getRemainingFeatures()
{
    try {
        const Found found = search();
        return {{Events, regions(*found.analysis)}, {Tracks, curves(*found.analysis)}, {Statistic, grid(found)}};
    } catch (const std::exception &error) { // no exception may pass into a host
        std::fprintf(stderr, "faintline: %s\n", error.what());
        return {};
    }
}

Vamp::Plugin::FeatureList DetectorPlugin::regions(const Analysis &analysis) const
{
    FeatureList list;
    for (const Event &event : events(analysis)) {
        Feature feature = featureAt(event.onsetSeconds);
        feature.hasDuration = true;
        feature.duration = Vamp::RealTime::fromSeconds(event.endSeconds - event.onsetSeconds);
        feature.values = {float(event.position.back())};
        const std::string table = eventsCsv(analysis, {event}); // with its head
        feature.label = table.substr(table.find('\n') + 1);
        feature.label.pop_back();
        list.push_back(std::move(feature));
    }
    return list;
}

Vamp::Plugin::FeatureList DetectorPlugin::curves(const Analysis &analysis) const
{
    FeatureList list;
    const Axis &frequency = analysis.grid().axes.back();
    for (const Track &track : analysis.tracks)
        for (const std::size_t i : track.presentPoints()) {
            Feature feature = featureAt(analysis.time().value(double(track.points[i].frame)));
            feature.values = {float(frequency.value(track.lastPosition(i, frequency)))};
            feature.label = std::to_string(track.id);
            list.push_back(std::move(feature));
        }
    std::stable_sort(list.begin(), list.end(),
                     [](const Feature &a, const Feature &b) { return a.timestamp < b.timestamp; });
    return list;
}

Vamp::Plugin::FeatureList DetectorPlugin::grid(const Found &found)
{
    FeatureList list;
    for (std::size_t frame = 0; frame < found.statistic.size(); ++frame) {
        Feature feature = featureAt(found.analysis->time().value(double(frame)));
        feature.values = found.statistic[frame];
        list.push_back(std::move(feature));
    }
    return list;
}

} // namespace faintline
