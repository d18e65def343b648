#include "frames/Spectrogram.h"

#include "base/Error.h"
#include "base/multiversion.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace faintline {

namespace {

    /// Samples per read, few enough to be in the cache when they are transformed.
    constexpr Index runSamples = 1 << 17;

    FAINTLINE_MULTIVERSION
    void applyWindow(const float *samples, const float *window, std::size_t n, float *out)
    {
        for (std::size_t i = 0; i < n; ++i)
            out[i] = samples[i] * window[i];
    }

    FAINTLINE_MULTIVERSION
    void applyWindowComplex(const float *samples, const float *window, std::size_t n, float *out)
    {
        for (std::size_t i = 0; i < n; ++i) {
            out[2 * i] = samples[2 * i] * window[i];
            out[2 * i + 1] = samples[2 * i + 1] * window[i];
        }
    }

    FAINTLINE_MULTIVERSION
    void squaredMagnitude(const float *bins, std::size_t n, float *out)
    {
        // Samples whose square overflows a float give ∞ or NaN; both are replaced by the largest float.
        constexpr float powerLimit = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < n; ++i) {
            const float power = bins[2 * i] * bins[2 * i] + bins[2 * i + 1] * bins[2 * i + 1];
            out[i] = power <= powerLimit ? power : powerLimit;
        }
    }

    std::string seconds(double value)
    {
        return formatNumber(value) + " s";
    }

    /// Selecting a channel deselects the others …
    Field<SelectionSettings> alone(Field<SelectionSettings> field)
    {
        field.set = [inner = field.set](SelectionSettings &selection, const FieldValue &value) {
            inner(selection, value);
            selection.channels.clear();
        };
        return field;
    }

    /// … and the first of several becomes the channel for everything that uses one.
    Field<SelectionSettings> together(Field<SelectionSettings> field)
    {
        field = field.withWord(-1.0, "all");
        field.set = [inner = field.set](SelectionSettings &selection, const FieldValue &value) {
            inner(selection, value);
            if (!selection.channels.empty())
                selection.channel = std::max(0, int(selection.channels.front()));
        };
        return field;
    }

    constexpr double openHz = 1e12; ///< beyond any band

    /// The lower or upper edge of the band. Tables and files know the whole band by its two open edges, so that either
    /// one can be given alone.
    Field<SelectionSettings> edge(double SelectionSettings::*member, std::string name, std::string sentence)
    {
        const bool isLow = member == &SelectionSettings::lowHz;
        const double open = isLow ? -openHz : openHz;
        auto result = field(member, std::move(name), "Hz", -openHz, openHz, std::move(sentence))
                          .withWord(open, isLow ? "lowest" : "highest");
        result.get = [member, open](const SelectionSettings &selection) -> std::optional<FieldValue> {
            return isWholeBand(selection) ? open : selection.*member;
        };
        result.set = [member](SelectionSettings &selection, const FieldValue &value) {
            if (isWholeBand(selection)) {
                selection.lowHz = -openHz;
                selection.highHz = openHz;
            }
            selection.*member = std::get<double>(value);
            if (selection.lowHz <= -openHz && selection.highHz >= openHz)
                selection.lowHz = selection.highHz = 0.0;
        };
        return result;
    }

    constexpr std::size_t mostChannels = 64; ///< summed

    int hopOf(int windowSamples, const SpectrogramSettings &settings)
    {
        return std::max(1, int(std::lround(double(windowSamples) / settings.stepsPerWindow)));
    }

} // namespace

const std::vector<Field<SpectrogramSettings>> &SpectrogramSettings::fields()
{
    using S = SpectrogramSettings;
    static const std::vector<Field<S>> table{
        field(&S::windowSeconds, "windowSeconds", "s", 0.0, 1e6,
              "Length T_FT of the sliding Fourier window; \"automatic\" chooses it from the recording's length and "
              "rate and, with the default slopes, from the tracks found.")
            .withWord(0.0, "automatic")
            .labelled("Window length")
            .advised("Lengthen it for steady lines: a line that stays within one cell gains 3 dB with each doubling. "
                     "Shorten it for lines that drift by more than a cell in a window. The number of cells per second "
                     "stays the same. Source: Billon 2005, section 4."),
        field(&S::stepsPerWindow, "stepsPerWindow", "", 1.0, 64.0, "Frames per window, k_t: 2 overlaps by half.")
            .labelled("Frames per window")
            .advised("Raise it to lose less of a short signal between two frames. Time and memory are proportional to "
                     "it; overlapping frames share samples, so the evidence grows more slowly."),
        field(&S::binsPerCell, "binsPerCell", "", 1.0, 32.0,
              "Frequency bins per resolution cell 1/T_FT, k_f: above 1 the window is padded with zeros.")
            .labelled("Bins per cell")
            .advanced()
            .advised("Raise it to lose less of a line halfway between two bins. States, time and memory are "
                     "proportional to it."),
        field(&S::window, "window", windowShapeNames,
              "Shape of the window; lower side lobes permit a faint line nearer to a strong one.")
            .labelled("Window shape")
            .advised("Choose Blackman–Harris beside very strong lines. Its main lobe is twice as wide as that of Hann, "
                     "so a line has less power in its cell and close lines merge."),
    };
    return table;
}

const std::vector<Field<SelectionSettings>> &SelectionSettings::fields()
{
    using S = SelectionSettings;
    static const std::vector<Field<S>> table{
        alone(field(&S::channel, "channel", "", 0.0, 1023.0, "Channel, counted from 0.")
                  .labelled("Channel")
                  .advised("Select the channel with the best reception. Channels that receive the same signal can be "
                           "added instead: selection.channels.")),
        together(
            field(&S::channels, "channels", "", 0.0, 1023.0,
                  "Channels whose evidence is added, counted from 0, or \"all\": one signal in all of them, over "
                  "noise that is independent from channel to channel. Empty: selection.channel alone.")
                .labelled("Channels added")
                .advanced()
                .advised("Add channels that receive the same signal in independent noise. Noise they have in common "
                         "raises the number of false alarms. Time is proportional to the number of channels.")
                .withExample("all, or 0, 1")),
        field(&S::fromSeconds, "fromSeconds", "s", 0.0, 1e12, "Start of the part analysed, from the first sample.")
            .labelled("From")
            .advised("A shorter part tries settings sooner: time is proportional to its length."),
        field(&S::toSeconds, "toSeconds", "s", 0.0, 1e12, "End of the part analysed, or \"end\" of the recording.")
            .withWord(0.0, "end")
            .labelled("To")
            .advised("A shorter part tries settings sooner: time is proportional to its length."),
        edge(&S::lowHz, "lowHz", "Lower edge of the band, or \"lowest\".")
            .labelled("Lower edge")
            .advised("A narrower band takes less time and memory, and permits a lower threshold for the same number of "
                     "false alarms."),
        edge(&S::highHz, "highHz", "Upper edge of the band, or \"highest\".")
            .labelled("Upper edge")
            .advised("A narrower band takes less time and memory, and permits a lower threshold for the same number of "
                     "false alarms."),
    };
    return table;
}

bool isWholeBand(const SelectionSettings &selection)
{
    return selection.lowHz == selection.highHz;
}

void checkChannels(const SelectionSettings &selection)
{
    const std::vector<double> &channels = selection.channels;
    const auto refuse = [&](const char *why) {
        throw fieldError("selection.channels", formatFieldValue(channels), why);
    };
    if (channels.size() > mostChannels)
        refuse("at most 64 channels can be added");
    std::vector<double> sorted = channels;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
        refuse("must not name a channel twice");
    if (std::any_of(channels.begin(), channels.end(), [](double channel) { return channel != std::floor(channel); }))
        refuse("must be whole numbers");
}

void checkChannel(const SelectionSettings &selection, const std::string &what, int count)
{
    const std::vector<double> &several = selection.channels;
    if (selection.channel >= count)
        throw fieldError(several.empty() ? "selection.channel" : "selection.channels",
                         several.empty() ? std::to_string(selection.channel) : formatFieldValue(several),
                         what + " has " + std::to_string(count) + " channel(s), counted from 0");
}

std::vector<int> channelsOf(const SelectionSettings &selection, const RecordingInfo &info)
{
    if (selection.channels.empty())
        return {selection.channel};
    std::vector<int> channels(selection.channels.begin(), selection.channels.end());
    if (channels.front() < 0) {
        channels.resize(std::size_t(info.channelCount));
        std::iota(channels.begin(), channels.end(), 0);
    }
    const auto refuse = [&](const std::string &value) {
        throw fieldError("selection.channels", value,
                         "the recording has " + std::to_string(info.channelCount) + " channel(s), counted from 0");
    };
    if (channels.size() > mostChannels)
        throw fieldError("selection.channels", "all",
                         "at most 64 channels can be added; the recording has " + std::to_string(info.channelCount));
    for (const int channel : channels)
        if (channel >= info.channelCount)
            refuse(formatFieldValue(selection.channels));
    return channels;
}

double Spectrogram::automaticWindowSeconds(const RecordingInfo &info)
{
    const double wanted = 3.0 * std::sqrt(info.durationSeconds() / info.sampleRateHz);
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double mantissa = wanted / decade;
    double chosen = decade * (mantissa < 1.5 ? 1.0 : mantissa < 3.5 ? 2.0 : mantissa < 7.5 ? 5.0 : 10.0);
    // At least 16 samples, so that a spectrum exists; at most a quarter of the recording, and limited by memory.
    const double least = 16.0 / info.sampleRateHz;
    chosen = std::clamp(chosen, least, 4e6 / info.sampleRateHz);
    if (info.places.hasGaps()) // frames that reach into gaps are lost: a quarter of a stretch's at most
        chosen = std::min(chosen, std::max(double(info.places.typicalCount()) / info.sampleRateHz / 4.0, least));
    return std::min(chosen, std::max(info.durationSeconds() / 4.0, 1.0 / info.sampleRateHz));
}

Spectrogram::Steps Spectrogram::stepsOf(const SpectrogramSettings &settings, const RecordingInfo &info)
{
    const double wanted =
        (settings.windowSeconds > 0.0 ? settings.windowSeconds : automaticWindowSeconds(info)) * info.sampleRateHz;
    const int samples = int(std::llround(std::clamp(wanted * settings.binsPerCell, 2.0 * settings.binsPerCell, 1e8)
                                         / settings.binsPerCell)); // longer ones are rejected later
    return {hopOf(samples, settings) / info.sampleRateHz, info.sampleRateHz / settings.transformLength(samples)};
}

Spectrogram::Spectrogram(RecordingPointer recording, const SpectrogramSettings &settings,
                         const SelectionSettings &selection)
    : m_recording(std::move(recording)), m_settings(settings), m_selection(selection)
{
    const SelectedSamples samples = selectedSamples();
    m_firstSample = samples.first;
    chooseWindow(samples.count());
    m_window = sampleWindow(settings.window, m_windowSamples);
    m_scaleExponent = m_recording->scaleExponent(selection.channel);
    for (float &weight : m_window)
        weight = std::ldexp(weight, -m_scaleExponent);
    m_fft = std::make_shared<Fft>(settings.transformLength(m_windowSamples),
                                  m_recording->info().isComplex ? Fft::Input::Complex : Fft::Input::Real);
    const double rate = m_recording->info().sampleRateHz;
    m_time = {"time",
              "s",
              (double(m_firstSample) + 0.5 * m_windowSamples) / rate,
              double(m_hopSamples) / rate,
              (samples.count() - m_windowSamples) / m_hopSamples + 1,
              false};
    selectBand();
}

Spectrogram::SelectedSamples Spectrogram::selectedSamples() const
{
    const RecordingInfo &info = m_recording->info();
    checkChannel(m_selection, "the recording", info.channelCount);
    const double to =
        m_selection.toSeconds > 0.0 ? std::min(m_selection.toSeconds, info.durationSeconds()) : info.durationSeconds();
    if (m_selection.fromSeconds >= to)
        throw fieldError("selection.fromSeconds", formatNumber(m_selection.fromSeconds),
                         "must lie before the end of the selection, " + seconds(to));
    const double rate = info.sampleRateHz;
    return {Index(std::llround(m_selection.fromSeconds * rate)),
            std::min(Index(std::llround(to * rate)), info.sampleCount)};
}

void Spectrogram::chooseWindow(Index sampleCount)
{
    const RecordingInfo &info = m_recording->info();
    const double rate = info.sampleRateHz;
    const double windowSeconds =
        m_settings.windowSeconds > 0.0 ? m_settings.windowSeconds : automaticWindowSeconds(info);
    const double wantedSamples = windowSeconds * rate;
    if (wantedSamples * m_settings.binsPerCell > 1e8)
        throw fieldError("spectrogram.windowSeconds", formatNumber(windowSeconds),
                         "gives a transform of more than 100 million points; shorten the window");
    m_windowSamples = int(std::llround(wantedSamples));
    if (m_windowSamples < 2)
        throw fieldError("spectrogram.windowSeconds", formatNumber(windowSeconds),
                         "contains fewer than 2 samples at " + formatNumber(rate) + " Hz");
    if (sampleCount < m_windowSamples)
        throw Error(info.path, "the selected part is " + std::to_string(sampleCount) + " samples ("
                                   + seconds(double(sampleCount) / rate) + ") long, shorter than one window of "
                                   + seconds(windowSeconds) + "; choose a shorter spectrogram.windowSeconds");
    m_hopSamples = hopOf(m_windowSamples, m_settings);
}

/// The axis of the selected bins.
void Spectrogram::selectBand()
{
    const RecordingInfo &info = m_recording->info();
    const int n = m_fft->length();
    const double binHz = info.sampleRateHz / n;
    Axis whole{"frequency", "Hz", 0.0, binHz, m_fft->binCount(), false};
    if (info.isComplex)
        whole.first -= (n / 2) * binHz;
    m_frequency = whole;
    const double lowHz = m_selection.lowHz;
    const double highHz = m_selection.highHz;
    if (lowHz > highHz)
        throw fieldError("selection.lowHz", formatNumber(lowHz), "must not lie above selection.highHz");
    if (isWholeBand(m_selection))
        return;
    const Index low = Index(std::ceil(std::max(0.0, whole.position(lowHz) - 1e-9)));
    const Index high = Index(std::floor(std::min(double(whole.count - 1), whole.position(highHz) + 1e-9)));
    if (low > high)
        throw Error("selection.lowHz … highHz = " + formatNumber(lowHz) + " … " + formatNumber(highHz),
                    "contains no bin; the recording spans " + formatNumber(whole.first) + " … "
                        + formatNumber(whole.last()) + " Hz")
            .ofField("selection.lowHz");
    m_firstBin = low;
    m_frequency.first = whole.value(double(low));
    m_frequency.count = high - low + 1;
}

void Spectrogram::read(Index first, Index count, std::span<float> out, const RunContext &context) const
{
    // The samples of a run of frames are read once; runs are bounded so that memory does not grow with the request.
    const auto bins = std::size_t(m_frequency.count);
    const Index share = (count + context.threads - 1) / context.threads;
    const Index framesPerRun = std::clamp<Index>(runSamples / m_hopSamples, 1, std::max<Index>(share, 1));
    const Index runs = (count + framesPerRun - 1) / framesPerRun;
    parallelFor(runs, context, "spectrogram", [&] {
        const std::shared_ptr<Fft::Buffer> buffer = m_fft->buffer();
        return [&, buffer, samples = std::vector<float>()](Index run) mutable {
            const Index done = run * framesPerRun;
            const Index frames = std::min(framesPerRun, count - done);
            readRun(first + done, frames, samples, *buffer,
                    out.subspan(std::size_t(done) * bins, std::size_t(frames) * bins));
        };
    });
}

void Spectrogram::readRun(Index first, Index count, std::vector<float> &samples, Fft::Buffer &buffer,
                          std::span<float> out) const
{
    const std::size_t floats = m_recording->info().isComplex ? 2 : 1;
    const auto bins = std::size_t(m_frequency.count);
    const Index sampleCount = (count - 1) * m_hopSamples + m_windowSamples;
    samples.resize(std::size_t(sampleCount) * floats);
    m_recording->read(m_selection.channel, m_firstSample + first * m_hopSamples, sampleCount, samples);
    for (Index frame = 0; frame < count; ++frame) {
        const std::size_t offset = std::size_t(frame * m_hopSamples) * floats;
        const std::span<float> values = out.subspan(std::size_t(frame) * bins, bins);
        if (isObserved(first + frame))
            transformFrame(std::span(samples).subspan(offset, std::size_t(m_windowSamples) * floats), buffer, values);
        else
            std::fill(values.begin(), values.end(), 0.0f);
    }
}

void Spectrogram::transformFrame(std::span<const float> samples, Fft::Buffer &buffer, std::span<float> out) const
{
    const auto window = std::size_t(m_windowSamples);
    const bool isComplex = m_recording->info().isComplex;
    const std::span<float> input = buffer.input();
    if (isComplex)
        applyWindowComplex(samples.data(), m_window.data(), window, input.data());
    else
        applyWindow(samples.data(), m_window.data(), window, input.data());
    m_fft->run(buffer); // the rest of the input is 0 from the beginning

    const auto *bins = reinterpret_cast<const float *>(buffer.output().data());
    const Index n = m_fft->length();
    if (!isComplex) {
        squaredMagnitude(bins + 2 * m_firstBin, out.size(), out.data());
        return;
    }
    // Ascending frequency: bin i of the whole band is transform bin (i - ⌊n/2⌋) mod n.
    const Index firstPositive = n / 2;
    for (Index done = 0; done < std::ssize(out);) {
        const Index whole = m_firstBin + done;
        const Index source = whole < firstPositive ? whole + n - firstPositive : whole - firstPositive;
        const Index run = std::min(std::ssize(out) - done, whole < firstPositive ? firstPositive - whole : n - whole);
        squaredMagnitude(bins + 2 * source, std::size_t(run), out.data() + done);
        done += run;
    }
}

bool Spectrogram::hasRealEnds() const
{
    return !m_recording->info().isComplex && isWholeBand(m_selection);
}

double Spectrogram::windowSeconds() const
{
    return m_windowSamples / m_recording->info().sampleRateHz;
}

int channelCount(const SelectionSettings &selection)
{
    if (!selection.channels.empty() && selection.channels.front() < 0.0)
        throw fieldError("selection.channels", "all", "requires a recording; give the channels, such as 0, 1");
    return std::max(1, int(selection.channels.size()));
}

} // namespace faintline
