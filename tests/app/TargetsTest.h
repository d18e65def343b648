#pragma once

#include "app/features/pictures/PingBench.h"
#include "app/features/targets/TargetsPanel.h"
#include "app/features/targets/targetCells.h"
#include "app/openWindow.h"
#include "scene/PingTruth.h"
#include "support/find.h"
#include "widgets/pings/PingMap.h"
#include "widgets/table/ColumnTable.h"

#include <QLineEdit>
#include <QPushButton>
#include <QTableView>

namespace faintline::test {

inline const char *const seaText =
    R"({"kind": "pings", "pings": 24, "rangeCells": 120, "beams": 8, "seed": 5, "targets": [
    {"snrDb": 11, "rangeMetres": 3200, "bearingDegrees": 270, "appearPing": 4,
     "legs": [{"pings": 12, "rangeCellsPerPing": 0.5}]}]})";

/// Small enough to be analysed at once: nine rates a cell.
inline void takeNineRates(AnalysisSettings &settings)
{
    settings.model.motion = Motion::Slopes;
    settings.model.lowestSlope = -1;
    settings.model.highestSlope = 1;
    settings.detector = SmdSettings{SmdSettings::Reset::Mean, 0.0};
    settings.decide.thresholdNats = 22.0;
    settings.decide.inhibitCells = {2.0, 1.0};
    settings.decide.forgetCells = {4.0, 1.0};
    settings.track.windowCells = {4.0, 1.0};
}

/// What tests of the targets panel share: a window with a sea of one target, its panel open, and hands on map and
/// table.
class TargetsTest : public WindowTest
{
protected:
    void writeScene() { m_path = writeFile(m_folder, "sea.json", seaText); }
    void openScene()
    {
        m_window = newWindow({1400, 1000});
        QVERIFY(openAndSettle(*m_window, m_path, takeNineRates));
        QTest::keyClick(m_window.get(), Qt::Key_D, Qt::ControlModifier | Qt::ShiftModifier);
        QVERIFY(panel().isVisible());
        QVERIFY(!bench().histories()->isVisible()); // the maps have the room
        bench().showPing(2);
    }

    PingBench &bench() const { return m_window->pingBench(); }
    TargetsPanel &panel() const { return m_window->panel<TargetsPanel>(); }
    ColumnTable &table() const { return childOf<ColumnTable>(panel()); }
    const PingScene &scene() const { return *m_window->document().source().pings; }
    const PingTarget &last() const { return scene().targets.back(); }
    WaterfallView &plane() const { return *bench().output()->plane(); }
    QWidget *canvas() const { return plane().canvas(); }
    QPoint at(double range, double bearing) const { return plane().positionOf({range, bearing}).toPoint(); }
    QPoint cornerOf(int target, int corner) const
    {
        const ScenePlace place = cornersOf(scene(), scene().targets[std::size_t(target)])[std::size_t(corner)].place;
        return at(place.rangeMetres, place.bearingDegrees);
    }
    /// Press, move in two steps, release.
    void drag(QWidget *on, QPoint from, QPoint to) const
    {
        QTest::mousePress(on, Qt::LeftButton, {}, from);
        QTest::mouseMove(on, (from + to) / 2);
        QTest::mouseMove(on, to);
        QTest::mouseRelease(on, Qt::LeftButton, {}, to);
    }
    void startPlacing() const { QTest::mouseClick(buttonOf(panel(), "Place on the map"), Qt::LeftButton); }
    /// Where the simulated target is in a ping.
    ScenePlace placeIn(int target, int ping) const
    {
        const TruthTarget &truth = m_window->document().pingTruth().targets[std::size_t(target)];
        const auto k = std::size_t(ping - truth.firstPing);
        return {truth.rangeMetres[k], truth.bearingDegrees[k]};
    }
    /// Types into a cell as a user does.
    void type(int row, TargetColumn column, const QString &what) const
    {
        ColumnTable &table = this->table();
        table.setFocus();
        table.setCurrentIndex(table.model()->index(row, int(column)));
        QTest::keyClick(&table, Qt::Key_Return);
        auto *edit = table.findChild<QLineEdit *>();
        QVERIFY(edit);
        edit->selectAll();
        QTest::keyClicks(edit, what);
        QTest::keyClick(edit, Qt::Key_Return);
        QCoreApplication::processEvents(); // the editor commits when it gets back to the event loop
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    }
    QString cell(int row, TargetColumn column) const
    {
        return table().model()->index(row, int(column)).data().toString();
    }

    QString m_path;
};

} // namespace faintline::test
