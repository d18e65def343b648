#include "app/document/ViewState.h"

#include "base/json.h"
#include "base/wholeNumber.h"

namespace faintline {

namespace {

    Json toJson(const Span &span)
    {
        return {span.low, span.high};
    }

    Span spanFromJson(const Json &json)
    {
        return {json.at(0).get<double>(), json.at(1).get<double>()};
    }

    ViewState viewFrom(const Json &json)
    {
        checkKeys(json, "view",
                  {"seconds", "hz", "cursor", "orientation", "colourMap", "logarithmic", "radio", "firstChannel",
                   "event", "bearing", "cursorBearing", "polar", "axes", "position", "sliced"});
        ViewState view;
        if (json.contains("seconds") && json.contains("hz"))
            view.visible = {spanFromJson(json["seconds"]), spanFromJson(json["hz"])};
        if (json.contains("cursor"))
            view.cursor = {json["cursor"].at(0).get<double>(), json["cursor"].at(1).get<double>()};
        if (json.contains("bearing"))
            view.bearing = spanFromJson(json["bearing"]);
        if (json.contains("cursorBearing"))
            view.cursorBearing = json["cursorBearing"].get<double>();
        view.isPolar = json.value("polar", false);
        if (json.contains("axes"))
            view.axes = {wholeNumber<std::size_t>(json["axes"].at(0), "axes"),
                         wholeNumber<std::size_t>(json["axes"].at(1), "axes")};
        if (json.contains("position"))
            view.position = json["position"].get<std::vector<double>>();
        view.isSliced = json.value("sliced", false);
        view.orientation = QString::fromStdString(json.value("orientation", std::string()));
        view.colourMap = QString::fromStdString(json.value("colourMap", std::string()));
        view.isLogarithmic = json.value("logarithmic", false);
        view.isRadioAxis = json.value("radio", false);
        if (json.contains("firstChannel"))
            view.firstChannel = wholeNumber<int>(json["firstChannel"], "firstChannel");
        view.selectedEvent = wholeNumber(json, "view", "event", 0);
        return view;
    }

} // namespace

Json toJson(const ViewState &view)
{
    Json json = Json::object();
    if (view.visible) {
        json["seconds"] = toJson(view.visible->time);
        json["hz"] = toJson(view.visible->frequency);
    }
    if (view.cursor)
        json["cursor"] = {view.cursor->seconds, view.cursor->hz};
    if (view.bearing)
        json["bearing"] = toJson(*view.bearing);
    if (view.cursorBearing)
        json["cursorBearing"] = *view.cursorBearing;
    if (view.isPolar)
        json["polar"] = true;
    if (view.axes)
        json["axes"] = {view.axes->first, view.axes->second};
    if (!view.position.empty())
        json["position"] = view.position;
    if (view.isSliced)
        json["sliced"] = true;
    json["orientation"] = view.orientation.toStdString();
    json["colourMap"] = view.colourMap.toStdString();
    if (view.isLogarithmic)
        json["logarithmic"] = true;
    if (view.isRadioAxis)
        json["radio"] = true;
    if (view.firstChannel != 0)
        json["firstChannel"] = view.firstChannel;
    if (view.selectedEvent != 0)
        json["event"] = view.selectedEvent;
    return json;
}

ViewState viewFromJson(const Json &json, const std::string &where)
{
    try {
        return viewFrom(json);
    } catch (const Error &error) {
        throw error.in(where);
    } catch (const Json::exception &error) {
        throw Error(where, "is not a Faintline session: view: " + complaint(error));
    }
}

} // namespace faintline
