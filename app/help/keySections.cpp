#include "app/help/keySections.h"

#include "app/base/tr.h"

#include <QApplication>
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

    const Section &look()
    {
        static const Section section{"Look",
                                     {{"0", "show all"},
                                      {"Backspace", "zoom back"},
                                      {"Arrows", "move the cursor by a cell, with Ctrl by ten"},
                                      {"O", "next orientation"},
                                      {"Shift + L", "logarithmic or linear frequency"},
                                      {"Shift + R", "radio frequency or offset"},
                                      {"C", "next colour map"},
                                      {"[  ]", "black level down, up"},
                                      {"{  }", "white level down, up"},
                                      {"A   Shift + D", "automatic range; input as plain dB"},
                                      {"F", "what was found, or the statistic D"},
                                      {"V   Shift + V", "next output layer; over the statistic"},
                                      {"S   Shift + S", "state space under the cursor; spectrum"}}};
        return section;
    }

    const Section &detect()
    {
        static const Section section{"Detect",
                                     {{",  .", "threshold down, up by a quarter nat"},
                                      {"N   Shift + N", "next, previous event"},
                                      {"Y  X  U", "accept, reject the event; undecided"},
                                      {"1 … 9   Shift + U", "class of the event, none; a lesson’s answer"},
                                      {"E   G   Shift + G", "note on the event; merge, separate several"},
                                      {"W", "why detected, or why not"},
                                      {"Ctrl + D   Ctrl + Shift + D", "draw a line by hand; place sonar targets"},
                                      {"D   T", "Doppler fit to the event; straighten along its track"},
                                      {"Ctrl + B", "keep as A for comparison"},
                                      {"M   B   Ctrl + Return", "measure a box; annotate, analyse it"},
                                      {"Alt + Return", "analyse what is visible"},
                                      {"K", "cursor to the nearest peak"},
                                      {"H   Shift + H", "harmonics of the cursor's frequency; hear the line"},
                                      {"I", "sidebands: drag one, or Alt + Left, Right"},
                                      {"Space", "play as sound; Play > Play what"},
                                      {"Space   End", "live: hold the picture, go to the newest frames"},
                                      {"J  L", "one frame, ping or stage back, forward"},
                                      {"Ctrl + R", "run again"},
                                      {"Escape", "stop, or clear the marks"}}};
        return section;
    }

    const Section &pings()
    {
        static const Section section{"Sonar pings",
                                     {{"P", "view from above, or range over bearing"},
                                      {"J  L", "one ping back, forward"},
                                      {"Space   Shift + Space", "play, play backwards"}}};
        return section;
    }

    const Section &file()
    {
        static const Section section{"File and help",
                                     {{"Ctrl + O", "open; or drop a file on the window"},
                                      {"Ctrl + Page Down, Up", "next, previous file of the folder"},
                                      {"Ctrl + S", "save the session"},
                                      {"Ctrl + Z   Ctrl + Y", "undo, redo a setting"},
                                      {"Ctrl + K", "find a command by name"},
                                      {"F1   ?", "this list of keys"},
                                      {"Shift + F1", "the equation of the view"},
                                      {"F5   F6", "presentation, Escape leaves it; light or dark"},
                                      {"F11", "maximise the panel with the focus or opened last, or put it back"},
                                      {"Ctrl + Q", "quit"}}};
        return section;
    }

    Section waterfall(const char *title)
    {
        Section section = mouse();
        section.title = title;
        section.entries.insert(section.entries.end(), look().entries.begin(), look().entries.end());
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
               {"J  L", "one ping back, forward"},
               {"Space   Shift + Space", "play, play backwards"},
               {"Click, arrows", "place, move the cursor"},
               {"Ctrl + wheel", "zoom about the pointer"},
               {"Drag", "pan"},
               {"0   Backspace", "show all, zoom back"},
               {"S", "state space under the cursor, and its law"},
               {"V   Shift + V", "next output layer; over the statistic"},
               {"Y  X  U", "accept, reject the track here; undecided"}}}},
            {{"threshold"},
             {"Here: the threshold curve",
              {{"Drag anywhere", "move the threshold"},
               {",  .", "threshold down, up by a quarter nat"},
               {"Right button", "nats, Pfa per cell, false alarms/h; save"}}}},
            {{"events"},
             {"Here: the table of events",
              {{"N   Shift + N", "next, previous event"},
               {"Enter, click", "go to the event"},
               {"Click on a title", "sort by it"},
               {"Y  X  U", "accept, reject; undecided"},
               {"E   G   Shift + G", "note; merge, separate several"},
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
            {{"compare"},
             {"Here: A against B",
              {{"Ctrl + B", "keep as A"}, {"Ctrl + Shift + B", "swap A and B"}, {"Click on an event", "go there"}}}},
            {{"walk", "sequential"},
             {"Here: the sequential test",
              {{"Click on a walk", "follow this test"},
               {"Up  Down", "the previous, next test"},
               {"J  L", "one stage back, forward"},
               {"Ctrl + T", "open this panel"}}}},
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

} // namespace

KeySection keysOfView(const QString &view)
{
    for (const auto &[views, section] : viewSections())
        if (views.contains(view))
            return spoken(section);
    return {};
}

std::array<std::vector<KeySection>, 2> generalKeys(const QString &view)
{
    if (saysAllOfAWaterfall(view))
        return {{{spoken(detect())}, {spoken(pings()), spoken(file())}}};
    if (view == QLatin1String("map"))
        return {{{spoken(mouse()), spoken(look())}, {spoken(detect()), spoken(file())}}};
    return {{{spoken(mouse()), spoken(look())}, {spoken(detect()), spoken(pings()), spoken(file())}}};
}

} // namespace faintline
