#include "widgets/waterfall/waterfallCommands.h"

#include "widgets/waterfall/MarkedWaterfall.h"

#include <QActionGroup>
#include <QKeyEvent>
#include <QMenu>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

namespace faintline {

namespace {

    /// Moves by whole cells and scrolls if necessary.
    void moveCursor(MarkedWaterfall &view, int right, int up, int cells)
    {
        Viewport &viewport = *view.viewport();
        Viewport::Point point =
            viewport.cursor().value_or(Viewport::Point{viewport.time().middle(), viewport.frequency().middle()});
        const bool isNewestOnTop = view.direction().orientation() == MarkedWaterfall::Orientation::NewestOnTop;
        const int timeSteps = view.isTimeVertical() ? (isNewestOnTop ? up : -up) : right;
        const int hzSteps = view.isTimeVertical() ? right : up;
        // From cell centre to cell centre, so that every key press selects another cell.
        const auto moved = [](const Axis &axis, Index count, double value, Index by) {
            const auto index = Index(std::lround(axis.position(value)));
            return axis.value(double(std::clamp<Index>(index + by, 0, count - 1)));
        };
        const Axis &frequency = view.frequencyAxis();
        point.seconds = moved(view.picture()->time(), view.picture()->frameCount(), point.seconds, timeSteps * cells);
        point.hz = moved(frequency, frequency.count, point.hz, hzSteps * cells);
        viewport.setCursor(point);

        const auto within = [](const Span &span, double value) { return std::clamp(value, span.low, span.high); };
        viewport.move(viewport.visible(), point,
                      {within(viewport.time(), point.seconds), within(viewport.frequency(), point.hz)});
    }

    void clearMarks(MarkedWaterfall &view)
    {
        view.display().setMeasuring(false);
        view.display().setHarmonics(false);
        view.display().setSidebandSpacing(0.0);
        view.viewport()->clearSelection();
        view.viewport()->clearCursor();
    }

    using KeyAction = std::pair<int, std::function<void()>>;

    bool act(std::span<const KeyAction> keys, int key)
    {
        const auto found =
            std::find_if(keys.begin(), keys.end(), [key](const KeyAction &entry) { return entry.first == key; });
        if (found == keys.end())
            return false;
        found->second();
        return true;
    }

} // namespace

bool pressKey(MarkedWaterfall &view, const QKeyEvent &event)
{
    if (!view.picture() || !view.viewport())
        return false;
    const int cells = event.modifiers().testFlag(Qt::ControlModifier) ? 10 : 1;
    const double bin = view.frequencyAxis().step;
    PictureDisplay &display = view.display();
    const KeyAction spacingKeys[] = {
        {Qt::Key_Left, [&] { display.setSidebandSpacing(std::max(display.sidebandSpacing() - bin, bin)); }},
        {Qt::Key_Right, [&] { display.setSidebandSpacing(display.sidebandSpacing() + bin); }},
    };
    const KeyAction cursorKeys[] = {
        {Qt::Key_Left, [&] { moveCursor(view, -1, 0, cells); }},
        {Qt::Key_Right, [&] { moveCursor(view, 1, 0, cells); }},
        {Qt::Key_Up, [&] { moveCursor(view, 0, 1, cells); }},
        {Qt::Key_Down, [&] { moveCursor(view, 0, -1, cells); }},
    };
    const KeyAction plainKeys[] = {
        {Qt::Key_Backspace, [&] { view.viewport()->zoomBack(); }},
        {Qt::Key_0, [&] { view.viewport()->showAll(); }},
        {Qt::Key_O, [&] { view.direction().cycle(); }},
        {Qt::Key_BracketLeft, [&] { view.stepBlack(-1); }},
        {Qt::Key_BracketRight, [&] { view.stepBlack(1); }},
        {Qt::Key_BraceLeft, [&] { view.stepWhite(-1); }},
        {Qt::Key_BraceRight, [&] { view.stepWhite(1); }},
        {Qt::Key_A, [&] { view.setAutomaticRange(); }},
        {Qt::Key_C, [&] { display.cycleColourMap(); }},
        {Qt::Key_Comma, [&] { emit view.thresholdStepRequested(-1); }},
        {Qt::Key_Period, [&] { emit view.thresholdStepRequested(1); }},
        {Qt::Key_M, [&] { display.setMeasuring(!display.isMeasuring()); }},
        {Qt::Key_H, [&] { display.setHarmonics(!display.hasHarmonics()); }},
        {Qt::Key_I, [&] { view.setSidebands(display.sidebandSpacing() == 0.0); }},
        {Qt::Key_K, [&] { view.moveCursorToPeak(); }},
        {Qt::Key_Escape, [&] { clearMarks(view); }},
    };
    const bool isSpacing = view.sidebands() && event.modifiers().testFlag(Qt::AltModifier);
    const bool isPlain = !(event.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
    return (isSpacing && act(spacingKeys, event.key())) || act(cursorKeys, event.key())
           || (isPlain && act(plainKeys, event.key()));
}

namespace {

    /// Adds actions for a view.
    class Commands
    {
    public:
        explicit Commands(MarkedWaterfall &view) : m_view(&view) {}

        template <class Action>
        QAction *add(QMenu &menu, const QString &text, const QString &key, Action action) const
        {
            // The key is text only: as a shortcut it would take the key from the focused view.
            QAction *added = menu.addAction(key.isEmpty() ? text : text + QLatin1Char('\t') + key);
            QObject::connect(added, &QAction::triggered, m_view, action);
            return added;
        }

        template <class Action>
        QAction *check(QMenu &menu, const QString &text, const QString &key, bool isOn, Action action) const
        {
            QAction *added = add(menu, text, key, action);
            added->setCheckable(true);
            added->setChecked(isOn);
            return added;
        }

    private:
        MarkedWaterfall *m_view;
    };

    QString tr(const char *text)
    {
        return MarkedWaterfall::tr(text);
    }

    void addZooming(QMenu &menu, MarkedWaterfall *view)
    {
        const Commands commands(*view);
        const Viewport *viewport = view->viewport();
        commands.add(menu, tr("Show all"), QStringLiteral("0"), [view] { view->viewport()->showAll(); })
            ->setEnabled(viewport && !viewport->showsAll());
        commands.add(menu, tr("Zoom back"), tr("Backspace"), [view] { view->viewport()->zoomBack(); })
            ->setEnabled(viewport && viewport->canZoomBack());
    }

    void addScale(QMenu &menu, MarkedWaterfall *view)
    {
        if (view->frequencyAxis().unit != "Hz" || !view->viewport())
            return;
        Commands(*view)
            .check(menu, tr("Logarithmic frequency"), tr("Shift+L"), view->viewport()->isLogarithmic(),
                   [view](bool isOn) { view->viewport()->setLogarithmic(isOn); })
            ->setEnabled(view->viewport()->canBeLogarithmic());
    }

    void addOrientations(QMenu &menu, MarkedWaterfall *view)
    {
        auto *group = new QActionGroup(&menu);
        using Orientation = MarkedWaterfall::Orientation;
        const std::pair<Orientation, QString> ways[] = {{Orientation::NewestOnTop, tr("Newest on top")},
                                                        {Orientation::OldestOnTop, tr("Oldest on top")},
                                                        {Orientation::LeftToRight, tr("Left to right")}};
        for (const auto &[way, text] : ways)
            group->addAction(Commands(*view).check(menu, text, QString(), view->direction().orientation() == way,
                                                   [view, way = way] { view->direction().set(way); }));
    }

    void addColours(QMenu &menu, MarkedWaterfall *view)
    {
        auto *group = new QActionGroup(&menu);
        for (const QString &name : ColourMap::names())
            group->addAction(Commands(*view).check(menu, name, QString(), name == view->display().colourMap().name(),
                                                   [view, name] { view->display().setColourMap(name); }));
    }

    void addLayers(QMenu &menu, MarkedWaterfall *view)
    {
        const std::pair<PictureDisplay::Layer, QString> rows[] = {
            {PictureDisplay::EventLayer, tr("Events")}, {PictureDisplay::TrackLayer, tr("Tracks")},
            {PictureDisplay::TruthLayer, tr("Truth")},  {PictureDisplay::ThresholdLayer, tr("Threshold contour")},
            {PictureDisplay::GridLayer, tr("Grid")},    {PictureDisplay::CursorLayer, tr("Cursor")}};
        for (const auto &[layer, text] : rows)
            Commands(*view).check(menu, text, QString(), view->display().shows(layer),
                                  [view, layer = layer](bool isOn) { view->display().setLayer(layer, isOn); });
    }

    void addMeasures(QMenu &menu, MarkedWaterfall *view)
    {
        const Commands commands(*view);
        commands.check(menu, tr("Measure a box"), QStringLiteral("M"), view->display().isMeasuring(),
                       [view](bool isOn) { view->display().setMeasuring(isOn); });
        if (view->frequencyAxis().unit == "Hz") {
            commands.check(menu, tr("Harmonics of the cursor"), QStringLiteral("H"), view->display().hasHarmonics(),
                           [view](bool isOn) { view->display().setHarmonics(isOn); });
            commands.check(menu, tr("Sidebands of the cursor"), QStringLiteral("I"),
                           view->display().sidebandSpacing() > 0.0, [view](bool isOn) { view->setSidebands(isOn); });
        }
        commands.add(menu, tr("Cursor to the peak nearby"), QStringLiteral("K"), [view] { view->moveCursorToPeak(); })
            ->setEnabled(view->viewport() && view->viewport()->cursor());
    }

} // namespace

void addCommands(QMenu &menu, MarkedWaterfall &shown)
{
    MarkedWaterfall *const view = &shown;
    addZooming(menu, view);
    menu.addSeparator();
    addScale(menu, view);
    addOrientations(*menu.addMenu(tr("Orientation")), view);
    addColours(*menu.addMenu(tr("Colours")), view);
    Commands(shown).check(menu, tr("Automatic range"), QStringLiteral("A"), view->isRangeAutomatic(),
                          [view](bool isOn) {
                              const Span now = view->range();
                              isOn ? view->setAutomaticRange() : view->setRange(now.low, now.high); // kept
                          });
    addLayers(*menu.addMenu(tr("Show")), view);
    menu.addSeparator();
    addMeasures(menu, view);
}

} // namespace faintline
