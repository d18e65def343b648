#include "app/commands/keySections.h"

#include "app/base/tr.h"

#include <QAction>
#include <QMenu>
#include <QStringList>

#include <string_view>

namespace faintline {

namespace {

    struct Entry {
        const char *keys;
        const char *does;
    };
    struct Section {
        const char *title;
        std::vector<Entry> entries;
    };

    KeySection spoken(const Section &section)
    {
        KeySection result{tr(section.title), {}};
        for (const Entry &entry : section.entries)
            result.entries.push_back({tr(entry.keys), tr(entry.does)});
        return result;
    }

    const Section &mouse()
    {
        static const Section section{"Mouse on a waterfall",
                                     {{"Wheel", "scroll time"},
                                      {"Shift + wheel", "scroll frequency"},
                                      {"Ctrl + wheel", "zoom about the pointer"},
                                      {"Wheel on an axis", "zoom that axis"},
                                      {"Drag", "pan"},
                                      {"Shift + drag", "zoom to a box"},
                                      {"Click", "place the cursor"},
                                      {"Ctrl + click", "snap to the nearest peak, also for M's corners"},
                                      {"Double-click", "go to the event under the pointer"}}};
        return section;
    }

    /// Keys of the pictures that no menu has.
    const Section &pictures()
    {
        static const Section section{"Keys of the pictures",
                                     {{"Arrows", "move the cursor by a cell, with Ctrl by ten"},
                                      {"[  ]", "black level down, up"},
                                      {"{  }", "white level down, up"},
                                      {"Alt + Left, Right", "move the sidebands"},
                                      {"Space", "live: hold the picture"},
                                      {"Escape", "clear the marks"},
                                      {"1 … 9", "a lesson’s answer"}}};
        return section;
    }

    const Section &pings()
    {
        static const Section section{
            "Sonar pings", {{"P", "view from above, or range over bearing"}, {"Shift + Space", "play backwards"}}};
        return section;
    }

    Section waterfall(const char *title)
    {
        Section section = mouse();
        section.title = title;
        section.entries.insert(section.entries.end(), pictures().entries.begin(), pictures().entries.end());
        return section;
    }

    Section channels()
    {
        Section section = waterfall("Here: channels beside each other");
        for (Entry &entry : section.entries)
            if (entry.keys == std::string_view("Click"))
                entry = {"Click, Return", "analyse this channel; a click also places the cursor"};
        return section;
    }

    const std::vector<std::pair<QStringList, Section>> &viewSections()
    {
        static const std::vector<std::pair<QStringList, Section>> all{
            {{"input"}, waterfall("Here: the input waterfall")},
            {{"output"}, waterfall("Here: the statistic's waterfall")},
            {{"histories"}, waterfall("Here: range and bearing against time")},
            {{"map", "polar"},
             {"Here: a ping's map",
              {{"P", "view from above, or range over bearing"},
               {"Shift + Space", "play backwards"},
               {"Click, arrows", "place, move the cursor"},
               {"Ctrl + wheel", "zoom about the pointer"},
               {"Drag", "pan"},
               {"Right button", "accept, reject the track here"}}}},
            {{"threshold"},
             {"Here: the threshold curve",
              {{"Drag anywhere", "move the threshold"}, {"Right button", "nats, Pfa per cell, false alarms/h; save"}}}},
            {{"events"},
             {"Here: the table of events",
              {{"Enter, click", "go to the event"},
               {"Click on a title", "sort by it"},
               {"In the filter", "f>1000 stat>25 open: all must hold"}}}},
            {{"pd", "asn", "prior", "latency", "spectrum", "doppler"},
             {"Here: a chart",
              {{"Left  Right", "from point to point of a curve"},
               {"Up  Down", "from curve to curve"},
               {"Click, Enter", "on a measured point: show its trials"},
               {"Boxes of the legend", "show and hide curves"},
               {"Right button", "save as SVG, PDF, PNG or CSV"}}}},
            {{"channels"}, channels()},
            {{"slice"}, waterfall("Here: a slice through the states")},
            {{"sweep"},
             {"Here: a sweep",
              {{"Left  Right", "from value to value"},
               {"Up  Down", "from curve to curve"},
               {"Click, Enter", "on a value: apply it"}}}},
            {{"compare"}, {"Here: A against B", {{"Click on an event", "go there"}}}},
            {{"walk", "sequential"},
             {"Here: the sequential test",
              {{"Click on a walk", "follow this test"},
               {"Up  Down", "the previous, next test"},
               {"J  L", "one stage back, forward"}}}},
            {{"stopping"},
             {"Here: stopping stages",
              {{"Click on a bar", "a test that stopped at this stage"}, {"J  L", "one stage back, forward"}}}},
            {{"posterior", "scan"},
             {"Here: one test's stage", {{"J  L", "one stage back, forward"}, {"The slider", "any stage"}}}},
            {{"profile", "regulation"},
             {"Here: a chart along time",
              {{"Wheel", "scroll time"},
               {"Ctrl + wheel", "zoom in time"},
               {"Drag", "pan"},
               {"Click", "place the cursor"}}}},
            {{"why"},
             {"Here: the path breakdown",
              {{"Click a picture", "explain the cell there"}, {"Arrows in a picture", "explain its neighbours"}}}},
            {{"targets"},
             {"Here: targets of a scene",
              {{"Place, click in a map", "place a target in the ping shown"},
               {"Drag from its end", "draw a leg; Shift + click ends one there"},
               {"Drag a corner", "move the target, change the leg"},
               {"Enter, F2 in a cell", "edit the number"},
               {"Delete", "remove the selected leg or target"},
               {"Escape", "abandon the drag, end placing"}}}},
            {{"hand"},
             {"Here: drawing by hand",
              {{"Press in the input", "add a point"},
               {"Drag a point", "move it; the numbers follow"},
               {"Right-click a point", "remove it"},
               {"Alt + U", "add a point at the cursor"}}}},
        };
        return all;
    }

    bool saysAllOfAWaterfall(const QString &view)
    {
        return view == QLatin1String("input") || view == QLatin1String("output") || view == QLatin1String("histories")
               || view == QLatin1String("slice") || view == QLatin1String("channels");
    }

    /// The commands of a menu and of its submenus that have keys; keys of successive digits are one entry.
    void addKeys(KeySection &section, const QMenu &menu)
    {
        QString digits; // of the entries before
        for (const QAction *action : menu.actions()) {
            if (action->menu())
                addKeys(section, *action->menu());
            QStringList keys;
            for (const QKeySequence &key : action->shortcuts())
                keys << key.toString(QKeySequence::NativeText).replace(QLatin1Char('+'), QLatin1String(" + "));
            const bool isDigit = keys.size() == 1 && keys[0].size() == 1 && keys[0][0].isDigit();
            if (isDigit && !digits.isEmpty())
                section.entries.back() = {digits.at(0) + QStringLiteral(" … ") + keys[0],
                                          plainText(*menu.menuAction())};
            else if (!keys.isEmpty())
                section.entries.push_back({keys.mid(0, 2).join(QStringLiteral("   ")), plainText(*action)});
            digits = isDigit ? digits + keys[0] : QString();
        }
    }

} // namespace

KeySection keysOfView(const QString &view)
{
    for (const auto &[views, section] : viewSections())
        if (views.contains(view))
            return spoken(section);
    return {};
}

QString plainText(const QAction &action)
{
    return action.text().remove(QLatin1Char('&')).remove(QStringLiteral("…"));
}

std::vector<KeySection> generalKeys(const QString &view, const QList<QAction *> &menus)
{
    std::vector<KeySection> result;
    if (!saysAllOfAWaterfall(view))
        result = {spoken(mouse()), spoken(pictures())};
    if (view != QLatin1String("map"))
        result.push_back(spoken(pings()));
    for (const QAction *menu : menus) {
        result.push_back({plainText(*menu), {}});
        addKeys(result.back(), *menu->menu());
    }
    return result;
}

} // namespace faintline
