#include "bindings/eventArray.h"

#include "bindings/arrays.h"
#include "exchange/writeEvents.h"
#include "refine/secondLook.h"

namespace faintline::python {

namespace py = pybind11;

namespace {

    /// One number of every event or area, as T.
    template <class T, class One, class Take>
    Column column(const std::string &name, const std::vector<One> &all, const Take &take)
    {
        py::array_t<T> values(static_cast<py::ssize_t>(all.size()));
        for (std::size_t i = 0; i < all.size(); ++i)
            values.mutable_at(i) = static_cast<T>(take(all[i]));
        return {name, values};
    }

    /// The models of a bank, as in the command line's CSV.
    void addModels(std::vector<Column> &columns, const std::vector<Event> &found)
    {
        std::vector<std::string> models;
        std::vector<std::string> changes;
        for (const Event &e : found) {
            models.push_back(nameOfBankModel(e.model));
            changes.push_back(modelChangesText(e));
        }
        columns.push_back({"model", textColumn(models)});
        columns.push_back({"model_changes", textColumn(changes)});
    }

} // namespace

py::array eventArray(const Analysis &analysis)
{
    const std::vector<Event> found = events(analysis);
    const std::vector<Axis> &axes = analysis.grid().axes;
    std::vector<Column> columns;
    const auto number = [&](const std::string &name, const auto &take) {
        columns.push_back(column<double>(name, found, take));
    };
    const auto truth = [&](const std::string &name, const auto &take) {
        columns.push_back(column<bool>(name, found, take));
    };
    columns.push_back(column<std::int32_t>("event", found, [](const Event &e) { return e.id; }));
    number("t_onset", [](const Event &e) { return e.onsetSeconds; });
    number("t_detect", [](const Event &e) { return e.detectSeconds; });
    number("t_end", [](const Event &e) { return e.endSeconds; });
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
        number(axes.size() == 1 ? "f" : axes[axis].name, [axis](const Event &e) { return e.position[axis]; });
    number("drift_hz_per_s", [](const Event &e) { return e.driftPerSecond; });
    number("statistic", [](const Event &e) { return e.statistic; });
    truth("confirmed", [](const Event &e) { return e.isConfirmed; });
    truth("open", [](const Event &e) { return e.isOpen; });
    for (std::size_t axis = 0; axes.size() > 1 && axis < axes.size(); ++axis)
        number(axes[axis].name + "_per_s", [axis](const Event &e) { return e.ratesPerSecond[axis]; });
    if (looksTwice(analysis)) {
        number("snr_db", [](const Event &e) { return e.snrDb; });
        number("band_hz", [](const Event &e) { return e.bandWidth; });
        number("noise_probability", [](const Event &e) { return e.noiseProbability; });
        number("window_s", [](const Event &e) { return e.windowSeconds; });
    }
    if (analysis.settings.subtract.lines)
        truth("subtracted", [](const Event &e) { return e.isSubtracted; });
    if (analysis.isBank())
        addModels(columns, found);
    return tableOf(columns);
}

py::array areaArray(const Analysis &analysis)
{
    const std::vector<AreaEvent> areas = areaEvents(analysis);
    return tableOf({column<double>("t_onset", areas, [](const AreaEvent &a) { return a.onsetSeconds; }),
                    column<double>("t_end", areas, [](const AreaEvent &a) { return a.endSeconds; }),
                    column<double>("f_low", areas, [](const AreaEvent &a) { return a.low; }),
                    column<double>("f_high", areas, [](const AreaEvent &a) { return a.high; }),
                    column<double>("level_db", areas, [](const AreaEvent &a) { return a.levelDb; })});
}

} // namespace faintline::python
