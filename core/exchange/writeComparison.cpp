#include "exchange/writeComparison.h"

#include "analyse/columns.h"
#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "signal/formats/NumPy.h"

#include <functional>

namespace faintline {

namespace {

    const char *nameOfSide(ComparedEvent::In in)
    {
        return in == ComparedEvent::In::A ? "A" : in == ComparedEvent::In::B ? "B" : "both";
    }

    std::string cell(const std::optional<Event> &event, const std::function<double(const Event &)> &value)
    {
        return event ? formatNumber(value(*event)) : std::string();
    }

    std::string row(const ComparedEvent &compared)
    {
        const Event &event = compared.event();
        const auto id = [](const Event &e) { return double(e.id); };
        const auto detected = [](const Event &e) { return e.detectSeconds; };
        const auto statistic = [](const Event &e) { return e.statistic; };
        std::string text = nameOfSide(compared.in());
        const auto add = [&text](const std::string &word) { text += "," + word; };
        add(cell(compared.a, id));
        add(cell(compared.b, id));
        add(formatNumber(event.onsetSeconds));
        add(formatNumber(event.endSeconds));
        for (const double position : event.position)
            add(formatNumber(position));
        add(formatNumber(event.driftPerSecond));
        add(cell(compared.a, detected));
        add(cell(compared.b, detected));
        add(cell(compared.a, statistic));
        add(cell(compared.b, statistic));
        add(compared.in() == ComparedEvent::In::Both ? formatNumber(compared.sharedSeconds) : std::string());
        return text + "\n";
    }

} // namespace

void checkComparisonPath(const std::string &path)
{
    if (!path.ends_with(".csv"))
        throw Error(path, "the file name must end in .csv");
}

void writeComparison(const Comparison &comparison, const Grid &grid, const std::string &path)
{
    checkComparisonPath(path);
    std::string text = "in,event_a,event_b,t_onset,t_end";
    for (const std::string &name : positionNames(grid))
        text += "," + name;
    text += ",drift_hz_per_s,t_detect_a,t_detect_b,statistic_a,statistic_b,shared_s\n";
    for (const ComparedEvent &event : comparison.events)
        text += row(event);
    writeTextFile(path, text);
}

void writeDifference(const PeakPyramid &difference, const std::string &path)
{
    NumPyWriter writer(path, {difference.rowCount(0), difference.cells()});
    std::vector<float> values(std::size_t(difference.cells()));
    for (Index i = 0; i < difference.rowCount(0); ++i) {
        const auto bytes = difference.row(0, i);
        for (std::size_t at = 0; at < values.size(); ++at)
            values[at] = float(difference.scale().value(bytes[at]));
        writer.write(values);
    }
    writer.finish();
}

} // namespace faintline
