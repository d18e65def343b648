#include "app/features/events/DopplerPanel.h"
#include "app/features/events/chosenEvents.h"
#include "app/openWindow.h"
#include "base/Random.h"
#include "base/json.h"
#include "support/find.h"
#include "support/recordings.h"
#include "support/test.h"
#include "widgets/base/quantities.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/table/ColumnTable.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>

#include <cmath>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

/// A Doppler pass in the window: a simulated source goes by, its track is fitted, and what is shown is the fit.
class tst_DopplerPanel : public WindowTest
{
    Q_OBJECT

private slots:
    /// The phase is f0 times the time of emission, which is found by bisection.
    void initTestCase()
    {
        std::vector<float> samples(std::size_t(length * rate));
        Random(12, 0).normals(samples, 0.1f);
        const double amplitude = 0.1 * std::pow(10.0, 12.0 / 20.0) * 2.0 / std::sqrt(rate);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double t = double(i) / rate;
            double low = t - 100.0, high = t;
            for (int k = 0; k < 60; ++k) {
                const double middle = 0.5 * (low + high);
                (middle + std::hypot(range, speed * (middle - closest)) / speedOfSound < t ? low : high) = middle;
            }
            samples[i] += float(amplitude * std::cos(2.0 * std::numbers::pi * restHz * low));
        }
        const QString path = m_folder.filePath("pass.wav");
        writeAudio(path.toStdString(), SF_FORMAT_WAV | SF_FORMAT_FLOAT, 1, int(rate), samples);
        m_window = newWindow();
        QVERIFY(openAndSettle(*m_window, path,
                              [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }));
        QVERIFY(!m_window->document().shownEvents().empty());
    }

    void nothingIsFittedWhileNobodyLooks() { QVERIFY(table().rowCount() == 0 && !isBusy(panel())); }

    void theIntervalsHoldTheTruth()
    {
        QTest::keyClick(m_window.get(), Qt::Key_D);
        QVERIFY(panel().isVisible());
        QVERIFY(settle(panel()));
        QVERIFY2(sentenceOf(panel()).startsWith("Event "), qPrintable(sentenceOf(panel())));
        const DopplerFit fit = report().fit;
        QVERIFY(fit.restHz.contains(restHz) && fit.metresPerSecond.contains(speed));
        QVERIFY(fit.rangeMetres.contains(range) && fit.closestSeconds.contains(closest));
        QCOMPARE(table().rowCount(), 6);
        const std::vector<DopplerRow> rows = dopplerRows(fit);
        for (int row = 0; row < 4; ++row) {
            const DopplerRow &expected = rows[std::size_t(row)];
            QCOMPARE(cellOf(table(), row, 0), capitalised(QString::fromStdString(expected.name)));
            QCOMPARE(cellOf(table(), row, 1), QString::fromStdString(valueText(expected.value, expected.bounds)));
            QCOMPARE(cellOf(table(), row, 2), QString::fromStdString(boundsText(expected.bounds)));
        }
        const auto labels = panel().findChildren<QLabel *>();
        QVERIFY(std::any_of(labels.begin(), labels.end(), [](const QLabel *label) {
            return label->text().contains("One sensor cannot tell on which side");
        }));
    }

    void theChartsShowTrackAndResiduals()
    {
        const Chart &track = panel().frequencies().chart();
        QCOMPARE(track.curves.front().name, std::string("track"));
        QCOMPARE(track.curves.back().name, std::string("fit"));
        QVERIFY(track.curves.front().points.front().y > restHz && track.curves.front().points.back().y < restHz);
        std::size_t points = 0;
        for (const Curve &curve : panel().residuals().chart().curves)
            points += curve.kind == Curve::Kind::Paper ? curve.points.size() : 0;
        QCOMPARE(points, report().fit.residualHz.size());
        QCOMPARE(panel().frequencies().contextMenuPolicy(), Qt::CustomContextMenu); // Save chart…
    }

    void theMediumScalesSpeedAndRange()
    {
        const auto speedShown = [this] { return table().index(1, 1).data(ColumnModel::SortRole).toDouble(); };
        const double inAir = speedShown();
        auto *medium = panel().findChild<QComboBox *>();
        auto *propagation = panel().findChild<QDoubleSpinBox *>();
        medium->setFocus();
        QTest::keyClick(medium, Qt::Key_Down); // Water
        QCOMPARE(propagation->value(), 1500.0);
        QVERIFY(settle(panel()));
        QVERIFY(std::abs(speedShown() / inAir - 1500.0 / 343.0) < 0.01);
        propagation->setValue(340.0);
        QCOMPARE(medium->currentText(), QString("Other"));
        propagation->setValue(343.0);
        QCOMPARE(medium->currentText(), QString("Air"));
        QVERIFY(settle(panel()));
        QCOMPARE(speedShown(), inAir);
    }

    void aFitIsSaved_data()
    {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QByteArray>("begins");
        QTest::newRow("json") << "fit.json" << QByteArray("{");
        QTest::newRow("csv") << "fit.csv" << QByteArray("t,f,deviation,fitted,residual,left_out\n");
    }

    void aFitIsSaved()
    {
        QFETCH(QString, name);
        QFETCH(QByteArray, begins);
        const QString path = m_folder.filePath(name);
        QSignalSpy written(&panel(), &DopplerPanel::written);
        panel().saveTo(path);
        QVERIFY(!written.isEmpty() || written.wait(patience));
        QVERIFY(readBytes(path.toStdString()).startsWith(begins));
        const Json provenance =
            parseJson(readBytes(path.toStdString() + ".provenance.json").toStdString(), "provenance");
        QCOMPARE(provenance["doppler"]["propagation"].get<double>(), 343.0);
        QCOMPARE(provenance["doppler"]["events"][0].get<int>(), m_window->document().shownEvents().front().id);
    }

    void aWrongEndingIsRefused()
    {
        QSignalSpy failed(&panel(), &DopplerPanel::failed);
        panel().saveTo(m_folder.filePath("fit.txt"));
        QVERIFY(!failed.isEmpty() || failed.wait(patience));
        QVERIFY(!QFile::exists(m_folder.filePath("fit.txt")));
    }

    void withoutEventsThereIsNoFit()
    {
        m_window->document().setShownThreshold(1e6);
        QVERIFY(settle(panel()));
        QCOMPARE(table().rowCount(), 0);
        QVERIFY(panel().frequencies().chart().curves.empty());
        QVERIFY2(sentenceOf(panel()).contains("no event"), qPrintable(sentenceOf(panel())));
    }

private:
    static constexpr double speedOfSound = 343.0, rate = 1000.0, length = 120.0;
    static constexpr double restHz = 210.0, speed = 30.0, range = 200.0, closest = 58.0;

    DopplerReport report() const
    {
        return dopplerReport(*m_window->document().analysis(),
                             chosenEvents(m_window->document(), m_window->eventTable()), 0.0, speedOfSound);
    }
    DopplerPanel &panel() { return m_window->panel<DopplerPanel>(); }
    const QAbstractItemModel &table() { return *childOf<ColumnTable>(panel()).model(); }
};

FAINTLINE_WINDOW_TEST(tst_DopplerPanel)
#include "tst_DopplerPanel.moc"
