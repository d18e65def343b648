#include "app/features/settings/PipelinePanel.h"
#include "app/openWindow.h"
#include "support/test.h"

#include <QComboBox>

using namespace faintline;
using namespace faintline::test;

/// The box that tells which windows were tried on a recording, and takes another one by a click.
class tst_WindowChoice : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QByteArray lines;
        for (int i = 0; i < 8; ++i)
            lines += QByteArray(i > 0 ? "," : "")
                     + R"({"snrDb": 22, "referenceSeconds": 0.025, "durationSeconds": 0.4, "driftHzPerSecond": 4000,
                "frequencyHz": )"
                     + QByteArray::number(600 + 100 * i) + R"(, "startSeconds": )" + QByteArray::number(0.7 + 1.1 * i)
                     + "}";
        m_sweeps = writeFile(m_folder, "sweeps.json",
                             R"({"sampleRateHz": 8000, "durationSeconds": 10, "seed": 7, "lines": [)" + lines + "]}");
    }

    void tellsWhatWasTriedAndTakesAnother()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_sweeps));
        QComboBox &box = *window->findChild<QComboBox *>("windowChoice");
        QVERIFY(box.isVisibleTo(window.get()));
        QCOMPARE(box.currentText(), QString("From the recording: 0.025 s"));
        QVERIFY(window->document().settings() == AnalysisSettings());
        QVERIFY(window->document().usedSettings().model.highestSlope == laws::glide().highestSlope);
        const int tried = box.count() - 1;
        QVERIFY(tried >= 3);

        const int automatic = box.findText("0.1 s, ", Qt::MatchStartsWith);
        QVERIFY(automatic > 0);
        box.setCurrentIndex(automatic);
        emit box.activated(automatic);
        QVERIFY(settle(*window));
        QCOMPARE(window->document().settings().spectrogram.windowSeconds, 0.1);
        QCOMPARE(box.currentIndex(), automatic);
        QCOMPARE(box.count() - 1, tried); // what was tried stays known
        QVERIFY(!window->document().analysis()->choice);

        box.setCurrentIndex(0);
        emit box.activated(0);
        QVERIFY(settle(*window));
        QVERIFY(window->document().settings() == AnalysisSettings());
        QCOMPARE(box.currentText(), QString("From the recording: 0.025 s"));
    }

    void aThresholdDoesNotChooseAnew()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_sweeps));
        const auto before = window->document().analysis();
        window->controller().edit("decide.falseAlarmsPerHour", 10.0, "order");
        QVERIFY(settle(*window));
        QVERIFY(window->document().analysis() != before && window->document().analysis()->frames == before->frames);
        QVERIFY(window->document().isCurrent());
    }

    void isHiddenWhereNothingWasTried()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_sweeps,
                              [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.05; }));
        QVERIFY(!window->findChild<QComboBox *>("windowChoice")->isVisibleTo(window.get()));
    }

private:
    QTemporaryDir m_folder;
    QString m_sweeps;
};

FAINTLINE_WINDOW_TEST(tst_WindowChoice)
#include "tst_WindowChoice.moc"
