#include "app/cli/addOpening.h"
#include "app/cli/commands.h"
#include "app/cli/printSummary.h"

#include "base/files/fileName.h"
#include "base/json.h"
#include "base/numberText.h"
#include "base/oneLine.h"
#include "noise/openFrames.h"
#include "noise/pings/guessPingValues.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace faintline::cli {

namespace {

    /// What is known of all files, at the beginning of what is printed …
    template <class Info>
    Json headJson(const Info &info)
    {
        return {{"path", textFromFileName(info.path)}, {"container", info.container}, {"sampleType", info.sampleType}};
    }

    template <class Info>
    void printHead(const Info &info)
    {
        std::printf("file          %s\n", oneLine(info.path).c_str());
        std::printf("container     %s, %s\n", oneLine(info.container).c_str(), oneLine(info.sampleType).c_str());
    }

    /// … and, of samples and power, at its end.
    template <class Info>
    void addEnd(Json &json, const Info &info)
    {
        json["startUnixSeconds"] = info.startUnixSeconds ? Json(*info.startUnixSeconds) : Json(nullptr);
        json["notes"] = info.notes;
    }

    template <class Info>
    void printEnd(const Info &info)
    {
        if (info.startUnixSeconds)
            std::printf("start         %s s after 1970-01-01 UTC\n", formatPlainly(*info.startUnixSeconds).c_str());
        for (const std::string &note : info.notes)
            std::printf("note          %s\n", oneLine(note).c_str());
    }

    Json toJson(const RecordingInfo &info)
    {
        Json json = headJson(info);
        json["sampleRateHz"] = info.sampleRateHz;
        json["channels"] = info.channelCount;
        json["samples"] = info.sampleCount;
        json["durationSeconds"] = info.durationSeconds();
        json["complex"] = info.isComplex;
        json["centreHz"] = info.isCentreKnown() ? Json(info.centreHz) : Json(nullptr);
        addEnd(json, info);
        return json;
    }

    void print(const RecordingInfo &info)
    {
        printHead(info);
        std::printf("sample rate   %s Hz\n", formatPlainly(info.sampleRateHz).c_str());
        std::printf("channels      %d%s\n", info.channelCount, info.isComplex ? ", I/Q" : "");
        std::printf("length        %td samples, %s s\n", info.sampleCount,
                    formatPlainly(info.durationSeconds()).c_str());
        if (info.isComplex)
            std::printf("centre        %s\n",
                        info.isCentreKnown() ? (formatPlainly(info.centreHz) + " Hz").c_str() : "unknown");
        printEnd(info);
    }

    Json toJson(const Axis &axis)
    {
        return {{"unit", axis.unit}, {"first", axis.first}, {"step", axis.step}, {"count", axis.count}};
    }

    Json toJson(const PowerInfo &info)
    {
        Json json = headJson(info);
        json["time"] = toJson(info.time);
        json["frequency"] = toJson(info.frequency);
        json["channels"] = info.channelCount;
        addEnd(json, info);
        return json;
    }

    void print(const PowerInfo &info)
    {
        printHead(info);
        std::printf("frames        %td, one every %s s\n", info.time.count, formatPlainly(info.time.step).c_str());
        std::printf("frequencies   %td channels of %s Hz, %s … %s Hz\n", info.frequency.count,
                    formatPlainly(info.frequency.step).c_str(),
                    positionText(info.frequency.first, info.frequency).c_str(),
                    positionText(info.frequency.last(), info.frequency).c_str());
        if (info.channelCount > 1)
            std::printf("polarisations %d\n", info.channelCount);
        printEnd(info);
    }

    /// What the numbers of pings are: as the file says, or guessed.
    std::string valuesOf(const RawPings &pings)
    {
        const PingsInfo &info = pings.info();
        if (info.isComplex)
            return "I/Q";
        const bool isStated = info.stated != PingValues::Automatic;
        return std::string(pingValuesNames[std::size_t(isStated ? info.stated : guessPingValues(pings))])
               + (isStated ? "" : " (guessed; the grid file or pings.values can say)");
    }

    Json toJson(const RawPings &pings)
    {
        const PingsInfo &info = pings.info();
        Json json = headJson(info);
        json["time"] = toJson(info.time);
        json["axes"] = Json::array();
        for (const Axis &axis : info.grid.axes) {
            Json one = toJson(axis);
            one["name"] = axis.name;
            one["cyclic"] = axis.cyclic;
            json["axes"].push_back(one);
        }
        json["complex"] = info.isComplex;
        json["values"] = valuesOf(pings);
        return json;
    }

    void print(const RawPings &pings)
    {
        const PingsInfo &info = pings.info();
        printHead(info);
        std::printf("pings         %td, one every %s s\n", info.time.count, formatPlainly(info.time.step).c_str());
        for (const Axis &axis : info.grid.axes) {
            const std::string unit = axis.unit.empty() ? std::string() : " " + oneLine(axis.unit);
            std::printf("%-13s %td cells of %s%s, %s … %s%s%s\n", oneLine(axis.name).c_str(), axis.count,
                        formatPlainly(axis.step).c_str(), unit.c_str(), positionText(axis.first, axis).c_str(),
                        positionText(axis.last(), axis).c_str(), unit.c_str(), axis.cyclic ? ", cyclic" : "");
        }
        std::printf("values        %s\n", valuesOf(pings).c_str());
    }

    void print(const SimulatedPings &pings, const std::string &file)
    {
        const PingScene &scene = pings.scene();
        const Axis &range = pings.grid().axes[0];
        const Axis &bearing = pings.grid().axes[1];
        std::printf("file          %s\n", oneLine(file).c_str());
        std::printf("container     scene of sonar pings, seed %d\n", scene.seed);
        std::printf("pings         %d, one every %s s\n", scene.pings, formatPlainly(scene.priSeconds).c_str());
        std::printf("range         %td cells of %s m, %s … %s m\n", range.count, formatPlainly(range.step).c_str(),
                    formatPlainly(range.first).c_str(), formatPlainly(range.last()).c_str());
        std::printf("bearing       %td beams of %s°%s\n", bearing.count, formatPlainly(bearing.step).c_str(),
                    bearing.cyclic ? ", full circle" : "");
        std::printf("looks         %d\n", scene.looks);
        if (scene.reverberation)
            std::printf("reverberation %s dB over the noise in the first range cell\n",
                        formatPlainly(scene.reverberation->levelDb).c_str());
        for (std::size_t i = 0; i < scene.targets.size(); ++i) {
            const PingTarget &target = scene.targets[i];
            const TruthTarget &truth = pings.truth().targets[i];
            std::printf("target %zu      %s dB, %s, pings %d … %td, from %.6g m, %.4g° to %.6g m, %.4g°\n", i + 1,
                        formatPlainly(target.snrDb).c_str(), std::string(echoNames[std::size_t(target.echo)]).c_str(),
                        truth.firstPing, truth.firstPing + std::ssize(truth.cell) - 1, truth.rangeMetres.front(),
                        truth.bearingDegrees.front(), truth.rangeMetres.back(), truth.bearingDegrees.back());
        }
    }

    std::string rangeOf(const FieldInfo &field)
    {
        switch (field.kind) {
        case FieldKind::Flag:
            return "true or false";
        case FieldKind::Choice:
            return listed(field.choices, {}, " | ");
        case FieldKind::Integer:
        case FieldKind::Number:
        case FieldKind::Numbers:
            break;
        }
        std::string all = formatNumber(field.minimum) + " … " + formatNumber(field.maximum);
        for (const ValueWord &one : field.words)
            all += " | " + one.word;
        return all;
    }

} // namespace

void addInfo(CLI::App &app, Common &)
{
    struct Options {
        std::string file;
        OpenOptions open;
        bool json = false;
    };
    const auto options = std::make_shared<Options>();
    CLI::App *command = app.add_subcommand("info", "Print the properties of a recording");
    command->add_option("FILE", options->file, "Recording")->required();
    command->add_flag("--json", options->json, "Print as JSON");
    addOpening(*command, options->open);
    command->callback([options] {
        const auto tell = [&](const auto &json, const auto &...printed) {
            if (options->json)
                std::printf("%s\n", toJson(json).dump(2, ' ', true).c_str());
            else
                print(printed...);
        };
        const Source source = sourceIn(options->file, options->open);
        if (const auto pings = pingsOf(source))
            return tell(pings->scene(), *pings, options->file);
        if (!source.hasSamples()) {
            if (const auto raw = openRawPings(source.path, gridBeside(source.path)))
                return tell(*raw, *raw);
            if (const auto power = openPower(source.path))
                return tell(power->info(), power->info());
        }
        const RecordingPointer recording = openSamples(source);
        RecordingInfo info = recording->info();
        info.notes = notesOf(*recording);
        tell(info, info);
    });
}

void addDescribe(CLI::App &app, Common &)
{
    const auto name = std::make_shared<std::string>();
    CLI::App *command = app.add_subcommand("describe", "List every setting with name, unit, range, default and "
                                                       "description, and the presets");
    command->add_option("SETTING", *name, "One setting, or a common prefix of several");
    command->callback([name] {
        bool any = false;
        for (const auto &field : AnalysisSettings::fields()) {
            if (!field.name.starts_with(*name))
                continue;
            any = true;
            std::printf("%s%s%s\n    %s; default %s\n    %s\n", field.name.c_str(), field.unit.empty() ? "" : ", ",
                        field.unit.c_str(), rangeOf(field).c_str(),
                        formatFieldValue(field, defaultValue(field)).c_str(), field.sentence.c_str());
            if (!field.advice.empty())
                std::printf("    %s\n", field.advice.c_str());
        }
        if (!any)
            settingField(*name); // its error names the nearest setting
        if (name->empty())
            for (const SettingRule &rule : settingRules())
                std::printf("rule of %s\n    %s\n", rule.field.c_str(), rule.sentence.c_str());
        if (name->empty())
            for (const Preset &preset : presets())
                std::printf("preset %s\n    %s\n", preset.name.c_str(), preset.sentence.c_str());
    });
}

} // namespace faintline::cli
