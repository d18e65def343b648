#include "app/cli/commands.h"
#include "app/cli/inRange.h"

#include "analyse/usable.h"
#include "app/cli/EventCommand.h"
#include "base/files/AtomicFile.h"
#include "base/files/keepNoHoles.h"
#include "base/json.h"
#include "exchange/writeEvents.h"
#include "live/listen.h"
#include "live/sources/IqSource.h"
#include "live/sources/PipeSource.h"
#include "live/sources/RtlTcpSource.h"
#include "live/sources/SoundSource.h"
#include "live/sources/UdpSource.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <optional>

namespace faintline::cli {

namespace {

    struct ListenOptions {
        AnalysisOptions analysis;
        std::string out;
        std::string events;
        std::string record;
        double rotateMegabytes = 0.0;
        double rotateMinutes = 0.0;
        double updateSeconds = 10.0;
        std::vector<std::string> onEvent;
        std::string udp;
        std::string udpSequence;
        std::string rtlTcp;
        ReceiverSettings receiver;
        std::optional<double> gainDb;
        std::string device;
        const CLI::Option *rawChannels = nullptr;
        bool listsDevices = false;
    };

    /// Writes JSON lines to standard output or appends them to a file, each at once.
    class LineFile
    {
    public:
        explicit LineFile(const std::string &path) : m_path(path), m_file(path.empty() ? stdout : openAppending(path))
        {
        }
        ~LineFile()
        {
            if (m_file != stdout)
                std::fclose(m_file);
        }
        LineFile(const LineFile &) = delete;
        LineFile &operator=(const LineFile &) = delete;

        void write(const std::string &line)
        {
            std::fputs((line + "\n").c_str(), m_file);
            m_isSound = std::fflush(m_file) == 0 && m_isSound;
        }

        /// Throws if a line could not be written; the program checks standard output when it ends.
        void check() const
        {
            if (!m_isSound && m_file != stdout)
                throw Error(m_path, "could not be written completely", Error::Kind::Failure);
        }

    private:
        static std::FILE *openAppending(const std::string &path)
        {
            std::FILE *file = std::fopen(path.c_str(), "ae");
            if (!file)
                throw Error(path, "cannot be written");
            return file;
        }

        std::string m_path;
        std::FILE *m_file;
        bool m_isSound = true;
    };

    SoundSettings soundSettings(const ListenOptions &options)
    {
        const OpenOptions &open = options.analysis.open;
        SoundSettings sound;
        sound.device = options.device;
        if (!open.rawType.empty())
            sound.type = parseSampleType(open.rawType, "--raw-type");
        sound.sampleRateHz = open.rawRateHz;
        sound.channelCount = options.rawChannels->count() > 0 ? open.rawChannels : 0;
        return sound;
    }

    void listDevices()
    {
        const std::vector<SoundDevice> devices = soundDevices();
        (void)findSoundDevice(devices, "default", SoundDirection::In, "--list-devices");
        for (const SoundDevice &device : devices)
            if (device.inputChannels > 0)
                std::printf("%s\t%s\t%d channel(s), %.0f Hz%s\n", soundSystemName(device.system).c_str(),
                            device.name.c_str(), device.inputChannels, device.sampleRateHz,
                            device.isDefaultInput ? ", default" : "");
    }

    std::unique_ptr<SampleSource> sourceOf(const ListenOptions &options, const std::stop_token &stop)
    {
        const OpenOptions &open = options.analysis.open;
        const int given =
            !options.analysis.file.empty() + !options.udp.empty() + !options.rtlTcp.empty() + !options.device.empty();
        if (given != 1)
            throw Error("listen", "requires one source: FILE (- is standard input), --device, --udp or --rtl-tcp");
        if (!options.device.empty())
            return std::make_unique<SoundSource>(soundSettings(options));
        if (!options.rtlTcp.empty()) {
            ReceiverSettings receiver = options.receiver;
            receiver.sampleRateHz = open.rawRateHz;
            receiver.gainDb = options.gainDb;
            constexpr double most = 4294967295.0; // commands have four bytes
            if (!(receiver.frequencyHz > 0.0) || !(receiver.sampleRateHz > 0.0 && receiver.sampleRateHz <= most))
                throw Error("--rtl-tcp", "requires --frequency and --raw-rate, both in Hz and below 2^32");
            return std::make_unique<RtlTcpSource>(options.rtlTcp, receiver);
        }
        std::optional<StreamFormat> raw;
        if (!open.rawType.empty()) {
            if (!(open.rawRateHz > 0.0))
                throw Error("--raw-type", "requires the sample rate in Hz (such as --raw-rate 48000)");
            raw = StreamFormat{parseSampleType(open.rawType, "--raw-type"), open.rawRateHz, open.rawChannels, 0.0, {}};
        }
        if (!options.udp.empty()) {
            if (!raw)
                throw Error("--udp", "requires --raw-type and --raw-rate");
            return std::make_unique<UdpSource>(options.udp, *raw, parseSequenceNumbers(options.udpSequence));
        }
        return std::make_unique<PipeSource>(options.analysis.file, raw, stop);
    }

    /// The first JSON line: the source and the settings.
    std::string startedLine(const StreamFormat &format, const AnalysisSettings &settings)
    {
        Json line;
        line["notice"] = "started";
        line["source"] = format.origin;
        line["sampleType"] = format.type.name();
        line["sampleRateHz"] = format.sampleRateHz;
        line["channels"] = format.channelCount;
        line["settings"] = parseJson(settingsToJson(settings), "settings");
        return line.dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    std::string endedEarly(const StreamFormat &format)
    {
        return format.origin + " ended before one window was complete";
    }

    void listenTo(SampleSource &source, const ListenOptions &options, const ListenSettings &settings,
                  const RunContext &context)
    {
        LineFile lines(options.out);
        std::optional<EventCommand> command;
        if (!options.onEvent.empty())
            command.emplace(options.onEvent);
        const StreamFormat format = source.format();
        lines.write(startedLine(format, settingsForListening(settings.analysis, format)));
        ListenSinks sinks;
        sinks.event = [&](const EventChange &change, const AnalysisPlan &plan) {
            const std::string line = eventLine(change, plan, plan.recording->info().startUnixSeconds);
            lines.write(line);
            if (command)
                command->run(line);
            if (change.state == EventChange::State::Final)
                returnHoles(); // between the events that are kept to the end, where its track was
        };
        sinks.notice = [&](const ListenNotice &notice, const StreamFormat &) {
            lines.write(noticeLine(notice, format));
        };
        const ListenResult result = listen(source, settings, sinks, context);
        std::string words = std::to_string(result.events.size()) + " event(s)";
        if (!result.plan.frames)
            words += "; " + endedEarly(format);
        if (result.silentCount > 0)
            words += "; " + silenceWords(result.silentCount);
        if (!result.isAnalysedToTheEnd)
            words += "; the end of the input was not analysed";
        if (command && command->leftOutCount() > 0)
            words += "; " + std::to_string(command->leftOutCount())
                     + " call(s) of --on-event were skipped because 16 were running";
        lines.write(noticeLine({ListenNotice::Kind::Stopped, result.sampleCount, result.lostCount, words}, format));
        lines.check();
        if (!options.events.empty()) {
            if (!result.plan.frames)
                throw Error(options.events, "was not written: " + endedEarly(format), Error::Kind::Failure);
            const bool isCsv = options.events.ends_with(".csv");
            // A disk may take longer than the time allowed for a stop.
            writeTextFile(options.events,
                          isCsv ? eventsCsv(result.plan, result.events) : eventsJson(result.plan, result.events),
                          Durability::Program);
        }
        if (!result.isRecordedWhole)
            throw Error(options.record, "the recording is incomplete; the notices tell where it ends",
                        Error::Kind::Failure);
    }

    void listen(const ListenOptions &options, const Common &common)
    {
        if (options.listsDevices)
            return listDevices();
        if (common.read || common.written)
            throw Error("listen", "a live run cannot be replayed; use 'detect' on its recording");
        if (!options.events.empty() && !options.events.ends_with(".csv") && !options.events.ends_with(".json"))
            throw Error(options.events, "the file name must end in .csv or .json");
        checkDifferent({options.out, options.events, options.record});
        checkOutputs({options.events});
        keepNoHoles(128 << 10); // frames too
        AnalysisOptions analysis = options.analysis;
        analysis.file.clear(); // it can be read only once
        ListenSettings settings;
        settings.analysis = analysis.settings();
        settings.recordPath = options.record;
        settings.rotation = {options.rotateMegabytes * 1e6, options.rotateMinutes * 60.0};
        settings.updateSeconds = options.updateSeconds;
        RunContext context = common.context();
        context.progress = {}; // a stream has no known end
        try {
            std::unique_ptr<SampleSource> source = sourceOf(options, common.stop);
            if (options.analysis.open.iq)
                source = std::make_unique<IqSource>(std::move(source));
            listenTo(*source, options, settings, context);
        } catch (const Cancelled &) { // stopped before the stream began
        }
    }

} // namespace

void addListen(CLI::App &app, Common &common)
{
    const auto options = std::make_shared<ListenOptions>();
    CLI::App *command = app.add_subcommand("listen", "Detect in samples while they come in, with a causal background");
    options->analysis.addTo(*command, common);
    command->get_option("FILE")
        ->description("Standard input (-) or a FIFO: a WAV stream, or raw samples with --raw-type and --raw-rate")
        ->required(false);
    command->remove_option(command->get_option("--raw-header"));
    addOutput(*command, common, "--out", options->out,
              "Append the changes of events, one JSON object a line, to a file; without it they go to standard output");
    addOutput(*command, common, "--events", options->events, "Write the final events at the end: .csv or .json");
    addOutput(*command, common, "--record", options->record,
              "Record the input with its gaps: .sigmf-meta; an existing file is not overwritten");
    command->add_option("--rotate-megabytes", options->rotateMegabytes, "Start a new recording after this many MB")
        ->check(inRange(0.0, 1e9));
    command->add_option("--rotate-minutes", options->rotateMinutes, "Start a new recording after this many minutes")
        ->check(inRange(0.0, 1e6));
    command->add_option("--update", options->updateSeconds, "Time between two reports of an event in progress, s")
        ->check(inRange(0.1, 1e6))
        ->capture_default_str();
    command
        ->add_option("--on-event", options->onEvent,
                     "Program, with arguments, to run at each change of an event; the line of JSON becomes its last "
                     "argument; no shell is used")
        ->expected(1, 64);
    options->rawChannels = command->get_option("--raw-channels");
    command->add_option(
        "--device", options->device,
        "Listen to a sound device: its name or a part of it, or default; its own sample rate, floats and up "
        "to two channels unless --raw-rate, --raw-type or --raw-channels say otherwise");
    command->add_flag("--list-devices", options->listsDevices, "List the sound devices that can be listened to");
    command->add_option("--udp", options->udp, "Listen to UDP datagrams of raw samples: PORT or ADDRESS:PORT");
    command->add_option("--udp-sequence", options->udpSequence,
                        "Number at the beginning of each datagram: u16le, u16be, u32le, u32be, u64le or u64be");
    command->add_option("--rtl-tcp", options->rtlTcp, "Listen to the receiver of an rtl_tcp server: HOST or HOST:PORT");
    command->add_option("--frequency", options->receiver.frequencyHz, "Frequency of the receiver, Hz")
        ->check(inRange(0.0, 4294967295.0));
    command->add_option("--gain", options->gainDb, "Gain of the receiver, dB; automatic without it")
        ->check(inRange(-100.0, 100.0));
    command->add_option("--ppm", options->receiver.correctionPpm, "Correction of the receiver's frequency, ppm")
        ->check(inRange(-1000, 1000));
    command->callback([options, &common] { listen(*options, common); });
}

} // namespace faintline::cli
