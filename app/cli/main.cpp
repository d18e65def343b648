#include "app/cli/commands.h"
#include "app/cli/readProvenance.h"

#include "app/cli/Interruption.h"
#include "base/Error.h"
#include "base/editDistance.h"
#include "base/files/standardStreams.h"
#include "base/numberText.h"
#include "base/oneLine.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

namespace {

constexpr auto unwritable = "standard output: cannot be written; the output is incomplete";
constexpr auto programName = "faintline-cli";
constexpr auto description = "Faintline: track-before-detect for signals too faint to see.";

void addCommands(CLI::App &app, faintline::cli::Common &common)
{
    app.set_version_flag("--version", "faintline-cli " FAINTLINE_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    app.add_option("--threads", common.threads, "Number of threads; results do not depend on it")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--progress", common.progress,
                   "Progress on standard error: auto (a bar on a terminal), json (lines), none")
        ->check(CLI::IsMember({"auto", "json", "none"}))
        ->capture_default_str();
    app.parse_complete_callback([&common] { common.guardInputs(); }); // before any command runs
    for (const auto add : {faintline::cli::addInfo,      faintline::cli::addDescribe, faintline::cli::addDetect,
                           faintline::cli::addStatistic, faintline::cli::addExplain,  faintline::cli::addSimulate,
                           faintline::cli::addReproduce, faintline::cli::addEvaluate, faintline::cli::addMerge,
                           faintline::cli::addCalibrate, faintline::cli::addInject,   faintline::cli::addSequential,
                           faintline::cli::addCompare,   faintline::cli::addListen,   faintline::cli::addStraighten,
                           faintline::cli::addDoppler,   faintline::cli::addSurvey,   faintline::cli::addCadence,
                           faintline::cli::addReplay,    faintline::cli::addBench})
        add(app, common);
}

/// What is wrong with the first word in place of a command; empty if it is one.
std::string unknownCommand(const CLI::App &app, const std::vector<std::string> &arguments)
{
    const std::vector<std::string> rest = faintline::cli::fromCommandOn(arguments);
    if (rest.empty() || rest.front().starts_with("-"))
        return {};
    const std::vector<const CLI::App *> commands = app.get_subcommands([](const CLI::App *) { return true; });
    const bool isKnown = std::any_of(commands.begin(), commands.end(),
                                     [&](const CLI::App *one) { return one->get_name() == rest.front(); });
    if (isKnown)
        return {};
    const auto distanceOf = [&](const CLI::App *one) { return faintline::editDistance(one->get_name(), rest.front()); };
    const CLI::App *nearest = *std::ranges::min_element(commands, {}, distanceOf);
    constexpr std::size_t fewLetters = 2;
    const std::string meant =
        distanceOf(nearest) <= fewLetters ? "did you mean " + nearest->get_name() + "? (" : std::string();
    return rest.front() + ": unknown command; " + meant + programName + " --help lists the commands"
           + (meant.empty() ? "" : ")");
}

/// "Could not convert: --from = 0,5" is completed.
std::string wordsOf(const CLI::ParseError &error)
{
    const std::string words = error.what();
    const bool hasComma = faintline::hasDecimalComma(std::string_view(words).substr(words.rfind(' ') + 1));
    return hasComma ? words + " has a decimal comma; write a decimal point" : words;
}

int complain(const std::string &message, int code)
{
    std::fprintf(stderr, "error: %s\n", faintline::oneLine(message, faintline::longestMessage).c_str());
    return code;
}

} // namespace

void faintline::cli::runCommandLine(const std::vector<std::string> &arguments, Common common)
{
    common.arguments = arguments;
    common.inputs.clear();
    common.outputs.clear();
    CLI::App app{description, programName};
    addCommands(app, common);
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend())); // parse() takes them in reverse order
}

int main(int argc, char **argv)
{
    faintline::openStandardStreams();
    const faintline::Interruption interruption;
    faintline::cli::Common common;
    common.stop = interruption.token();
    common.arguments.assign(argv + 1, argv + argc);
    CLI::App app{description, programName};
    addCommands(app, common);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &error) {
        if (error.get_exit_code() == 0) {
            app.exit(error); // --help, --version
            return faintline::flushStandardOutput() ? 0 : complain(unwritable, 1);
        }
        if (const std::string why = unknownCommand(app, common.arguments); !why.empty())
            return complain(why, 2);
        return complain("command line: " + wordsOf(error), 2);
    } catch (const faintline::Error &error) {
        return complain(error.what(), error.kind() == faintline::Error::Kind::Mistake ? 2 : 1);
    } catch (const faintline::Cancelled &) {
        return complain("interrupted: no incomplete output was left", 1);
    } catch (const std::bad_alloc &) {
        return complain("memory: out of memory; choose a shorter part, a narrower band or a shorter window", 1);
    } catch (const std::exception &error) {
        return complain(std::string("failure: ") + error.what(), 1);
    }
    return faintline::flushStandardOutput() ? 0 : complain(unwritable, 1);
}
